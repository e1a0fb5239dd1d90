"""Costs of single edges and elements, and what makes an element inadmissible.

Everything here is computed from the nodes of an element in an order that does not
depend on the swaps before, so that it is the same number whenever the element occurs.

Node n is the point x, y, u at 3 n of a flat array, and the face of element t, its
gradient and doubled area, stands at 3 t of another: what is needed together lies together.
"""

from math import atan2, inf, sqrt

from .backend import compiled, inlined
from .codes import ABN, DFP, DLP, JND, SMALLEST_ANGLE, SQUARES, SUM

FLAT = 1e-12  # relative area below which a quadrilateral is not strictly convex
EQUILATERAL = 1.0471975511965976  # pi / 3


@compiled
def from_smallest(a, b, c):
    """The element turned so that its smallest node number comes first.

    What is computed from it then depends on the element alone, to the last bit, and
    not on the swaps that led to it; the proof of termination rests on that.
    """
    if b < a and b < c:
        return b, c, a
    if c < a and c < b:
        return c, a, b
    return a, b, c


@compiled
def sides(point, corners):
    """What leads along x and y from the first corner of an element to the second and to the third."""
    a, b, c = 3 * corners[0], 3 * corners[1], 3 * corners[2]
    return point[b] - point[a], point[b + 1] - point[a + 1], point[c] - point[a], point[c + 1] - point[a + 1]


@compiled
def turn(point, corners):
    """Twice the signed area of an element, or 0 if it is within rounding of flat."""
    bx, by, cx, cy = sides(point, corners)
    left, right = bx * cy, cx * by
    area = left - right
    return area if abs(area) > FLAT * (abs(left) + abs(right)) else 0.0


@compiled
def is_convex(point, a, b, c, d):
    """Whether c-d crosses a-b strictly inside, but for rounding: if not, an element would be flat."""
    ax, ay, dx, dy = sides(point, (c, a, d))
    bx, by, dx, dy = sides(point, (c, b, d))
    return ax * dy - ay * dx > 0 and bx * dy - by * dx < 0


@compiled
def plane(point, corners, area):
    """Gradient of the plane over an element, by differences from its first node."""
    bx, by, cx, cy = sides(point, corners)
    a, b, c = corners
    bu, cu = point[3 * b + 2] - point[3 * a + 2], point[3 * c + 2] - point[3 * a + 2]
    return (bu * cy - cu * by) / area, (bx * cu - cx * bu) / area


@compiled
def edge_cost(code, g, A, h, B, length):
    """Cost of an edge between planes of gradient g and h over areas A/2 and B/2.

    The jump is parallel to the edge's normal, so |g - h| is the JND; it is also the
    rate at which one plane misses the other's opposite node, at the distance area
    over length.
    """
    dx, dy = g[0] - h[0], g[1] - h[1]
    jump = sqrt(dx * dx + dy * dy)
    if code == JND:
        return jump
    if code == ABN:
        skew = g[0] * h[1] - g[1] * h[0]
        return atan2(sqrt(dx * dx + dy * dy + skew * skew), 1 + g[0] * h[0] + g[1] * h[1])
    over, under = jump * B / length, jump * A / length
    if code == DFP:
        over /= sqrt(1 + g[0] * g[0] + g[1] * g[1])
        under /= sqrt(1 + h[0] * h[0] + h[1] * h[1])
    return sqrt(over * over + under * under)


@compiled
def distance(point, a, b):
    """Length of the edge a-b."""
    return sqrt((point[3 * a] - point[3 * b]) ** 2 + (point[3 * a + 1] - point[3 * b + 1]) ** 2)


@compiled
def own_cost(given, point, a, b, c, d):
    """What a function of one's own returns for four points."""
    a, b, c, d = 3 * a, 3 * b, 3 * c, 3 * d
    return given(
        point[a],
        point[a + 1],
        point[a + 2],
        point[b],
        point[b + 1],
        point[b + 2],
        point[c],
        point[c + 1],
        point[c + 2],
        point[d],
        point[d + 1],
        point[d + 2],
    )


@compiled
def own_edge_cost(given, point, p, q, left, right):
    """Cost of the edge p-q by a function of one's own, which sees it from its smaller node."""
    if p > q:
        p, q, left, right = q, p, right, left
    return own_cost(given, point, p, q, left, right)


@inlined
def side_cost(code, given, point, inner, g, A, j, a, b, element, face):
    """Cost of the edge a-b, from the element on its left and the half-edge j beyond; 0 on the boundary.

    The element is (a, b, inner), of gradient g and area A/2.
    """
    if j < 0:
        return 0.0
    if given is not None:
        return own_edge_cost(given, point, a, b, inner, element[j])
    beyond, length = 3 * (j // 3), distance(point, a, b) if code >= DLP else 1.0
    return edge_cost(code, g, A, (face[beyond], face[beyond + 1]), face[beyond + 2], length)


@compiled
def corner(point, a, b, c):
    """The angle at a between b and c."""
    ux, uy, vx, vy = sides(point, (a, b, c))
    return atan2(abs(ux * vy - uy * vx), ux * vx + uy * vy)


@compiled
def element_cost(code, given, point, corners):
    """How far the smallest or largest angle of an element is from 60 degrees, or a cost of one's own."""
    a, b, c = corners
    if given is not None:
        return own_cost(given, point, a, b, c, a)
    p, q, r = corner(point, a, b, c), corner(point, b, c, a), corner(point, c, a, b)
    excess = EQUILATERAL - min(p, q, r) if code == SMALLEST_ANGLE else max(p, q, r) - EQUILATERAL
    return max(excess, 0.0)  # not below 0 by rounding


@compiled
def are_costs(p, q, r, s, t):
    """Whether all are finite and not negative."""
    return 0 <= p < inf and 0 <= q < inf and 0 <= r < inf and 0 <= s < inf and 0 <= t < inf


@compiled
def combined(norm, p, q, r, s, t):
    """What the norm compares: the sum, the sum of squares, or the maximum."""
    if norm == SUM:
        return p + q + r + s + t
    if norm == SQUARES:
        return p * p + q * q + r * r + s * s + t * t
    return max(p, q, r, s, t)


@compiled
def is_below(norm, new, old, relative, absolute):
    """Whether a local cost is below another by more than the tolerance, see `norms.is_below`.

    With a negative absolute part it may also rise, by less than that, in what is summed.
    """
    if new >= old:
        return new - old < -absolute  # mostly false, and without a root
    if norm == SQUARES:
        new, old = sqrt(new), sqrt(old)
    return new < old * (1 - relative) - absolute


@compiled
def too_sharp(point, corners, min_angle):
    """Whether an element has an angle below the limit (section 6.1)."""
    a, b, c = corners
    return min(corner(point, a, b, c), corner(point, b, c, a), corner(point, c, a, b)) < min_angle


@compiled
def refused(point, corners, area, min_angle, min_area):
    """Whether an element would be flat or break a limit of section 6.1."""
    if area <= 0 or area < min_area:
        return True
    return min_angle > 0 and too_sharp(point, corners, min_angle)
