"""Costs of single edges and elements, and what makes an element inadmissible.

Everything here is computed from the nodes of an element in an order that does not
depend on the swaps before, so that it is the same number whenever the element occurs.

Node n is the point x, y, u at 3 n of a flat array, and the face of element t, its
gradient and doubled area, stands at 3 t of another: what is needed together lies together.
"""

from math import atan2, inf, sqrt

from .codes import ABN, DFP, DLP, JND, SMALLEST_ANGLE, SQUARES, SUM
from .element_shapes import gradient
from .groups import Corners, Face, Five, Floats, Point, Quad, Rules, State, UserCost, Vector
from .marks import inlined, kernel

FLAT = 1e-12  # relative area below which a quadrilateral is not strictly convex
EQUILATERAL = 1.0471975511965976  # pi / 3


@kernel
def from_smallest(a: int, b: int, c: int) -> Corners:
    """The element turned so that its smallest node number comes first.

    What is computed from it then depends on the element alone, to the last bit, and
    not on the swaps that led to it; the proof of termination rests on that.
    """
    if b < a and b < c:
        return b, c, a
    if c < a and c < b:
        return c, a, b
    return a, b, c


@kernel
def node(point: Floats, n: int) -> Point:
    """Coordinates and value of a node."""
    return point[3 * n], point[3 * n + 1], point[3 * n + 2]


@kernel
def sides(point: Floats, corners: Corners) -> tuple[Vector, Vector]:
    """The vectors from the first corner of an element to the second and to the third."""
    a, b, c = 3 * corners[0], 3 * corners[1], 3 * corners[2]
    x, y = point[a], point[a + 1]
    return (point[b] - x, point[b + 1] - y), (point[c] - x, point[c + 1] - y)


@kernel
def turn(point: Floats, corners: Corners) -> float:
    """Twice the signed area of an element, or 0 if it is within rounding of flat."""
    u, v = sides(point, corners)
    left, right = u[0] * v[1], v[0] * u[1]
    area = left - right
    return area if abs(area) > FLAT * (abs(left) + abs(right)) else 0.0


@kernel
def is_convex(point: Floats, quad: Quad) -> bool:
    """Whether c-d crosses a-b strictly inside, but for rounding: if not, an element would be flat."""
    a, b, c, d = quad
    u, v = sides(point, (c, a, d))
    w, _ = sides(point, (c, b, d))
    return u[0] * v[1] - u[1] * v[0] > 0 and w[0] * v[1] - w[1] * v[0] < 0


@kernel
def face_of(point: Floats, corners: Corners, area: float) -> Face:
    """Gradient of the plane over an element, by differences from its first node, and its doubled area."""
    u, v = sides(point, corners)
    value = point[3 * corners[0] + 2]
    g = gradient(u, v, point[3 * corners[1] + 2] - value, point[3 * corners[2] + 2] - value, area)
    return g[0], g[1], area


@kernel
def edge_cost(code: int, p: Face, q: Face, length: float) -> float:
    """Cost of an edge between two faces.

    The jump of the gradient is parallel to the edge's normal, so its size is the JND; it
    is also the rate at which one plane misses the other's opposite node, at the distance
    area over length.
    """
    dx, dy = p[0] - q[0], p[1] - q[1]
    jump = sqrt(dx * dx + dy * dy)
    if code == JND:
        return jump
    if code == ABN:
        skew = p[0] * q[1] - p[1] * q[0]
        return atan2(sqrt(dx * dx + dy * dy + skew * skew), 1 + p[0] * q[0] + p[1] * q[1])
    over, under = jump * q[2] / length, jump * p[2] / length
    if code == DFP:
        over /= sqrt(1 + p[0] * p[0] + p[1] * p[1])
        under /= sqrt(1 + q[0] * q[0] + q[1] * q[1])
    return sqrt(over * over + under * under)


@kernel
def distance(point: Floats, a: int, b: int) -> float:
    """Length of the edge a-b."""
    return sqrt((point[3 * a] - point[3 * b]) ** 2 + (point[3 * a + 1] - point[3 * b + 1]) ** 2)


@kernel
def user_cost(given: UserCost, point: Floats, quad: Quad) -> float:
    """What a user-defined function returns for four points."""
    a, b, c, d = quad
    return given(node(point, a), node(point, b), node(point, c), node(point, d))


@kernel
def user_edge_cost(given: UserCost, point: Floats, quad: Quad) -> float:
    """User-defined cost of the edge p-q between the nodes left and right, as seen from its smaller node."""
    p, q, left, right = quad
    return user_cost(given, point, (q, p, right, left) if p > q else quad)


@inlined
def side_cost(given: UserCost | None, code: int, state: State, corners: Corners, own: Face, j: int) -> float:
    """Cost of the edge a-b of the element (a, b, c) with this face, and the half-edge j beyond.

    It is 0 on the boundary, where j is negative.
    """
    if j < 0:
        return 0.0
    a, b, c = corners
    if given is not None:
        return user_edge_cost(given, state.point, (a, b, c, state.element[j]))
    length = distance(state.point, a, b) if code >= DLP else 1.0
    return edge_cost(code, own, node(state.face, j // 3), length)


@kernel
def corner(point: Floats, a: int, b: int, c: int) -> float:
    """The angle at a between b and c."""
    u, v = sides(point, (a, b, c))
    return atan2(abs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1])


@kernel
def element_cost(given: UserCost | None, code: int, point: Floats, corners: Corners) -> float:
    """User-defined cost of an element, or how far its smallest or largest angle is from 60 degrees."""
    a, b, c = corners
    if given is not None:
        return user_cost(given, point, (a, b, c, a))
    p, q, r = corner(point, a, b, c), corner(point, b, c, a), corner(point, c, a, b)
    excess = EQUILATERAL - min(p, q, r) if code == SMALLEST_ANGLE else max(p, q, r) - EQUILATERAL
    return max(excess, 0.0)  # not below 0 by rounding


@kernel
def are_costs(costs: Five) -> bool:
    """Whether all are finite and not negative."""
    p, q, r, s, t = costs
    return 0 <= p < inf and 0 <= q < inf and 0 <= r < inf and 0 <= s < inf and 0 <= t < inf


@kernel
def combined(norm: int, costs: Five) -> float:
    """What the norm compares: the sum, the sum of squares, or the maximum."""
    p, q, r, s, t = costs
    if norm == SUM:
        return p + q + r + s + t
    if norm == SQUARES:
        return p * p + q * q + r * r + s * s + t * t
    return max(p, q, r, s, t)


@kernel
def is_below(new: float, old: float, rules: Rules) -> bool:
    """Whether a local cost is below another by more than the tolerance, see `norms.is_below`.

    With a negative absolute part it may also rise, by less than that, in what is summed.
    """
    if new >= old:
        return new - old < -rules.absolute  # mostly false, and without a root
    if rules.norm == SQUARES:
        new, old = sqrt(new), sqrt(old)
    return new < old * (1 - rules.relative) - rules.absolute


@kernel
def too_sharp(point: Floats, corners: Corners, min_angle: float) -> bool:
    """Whether an element has an angle below the limit (section 6.1)."""
    a, b, c = corners
    return min(corner(point, a, b, c), corner(point, b, c, a), corner(point, c, a, b)) < min_angle


@kernel
def refused(point: Floats, corners: Corners, area: float, rules: Rules) -> bool:
    """Whether an element would be flat or break a limit of section 6.1."""
    if area <= 0 or area < rules.min_area:
        return True
    return rules.min_angle > 0 and too_sharp(point, corners, rules.min_angle)


@kernel
def evaluated(given: UserCost, point: Floats, costs: Floats) -> None:
    """Set the user-defined cost of each four points."""
    for n in range(len(costs)):
        costs[n] = user_cost(given, point, (4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3))
