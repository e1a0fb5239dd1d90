r"""The local optimisation procedure (Algorithm 3.1.4) on flat arrays.

Half-edge h = 3 t + k is the side of element t opposite its node k.  ``twin[h]`` is
the same side seen from the neighbour, or -1; ``slot[h]`` is the number of its edge,
``half[e]`` one half-edge of edge e.  Around the edge a-b::

            c                    c
           / \                  /|\
        n2/ t \n1            n2/ | \n1       t = (c, a, b) -> (c, a, d)
         a-----b     --->     a t|s b        s = (d, b, a) -> (d, b, c)
        n3\ s /n4            n3\ | /n4
           \ /                  \|/          n1 .. n4: the elements beyond
            d                    d
"""
from math import atan2, sqrt

from .backend import compiled

JND, ABN, DLP, DFP, SMALLEST_ANGLE, LARGEST_ANGLE = range(6)
SUM, SQUARES, MAXIMUM = 1, 2, 0
FLAT = 1e-12  # relative area below which a quadrilateral is not strictly convex
EQUILATERAL = 1.0471975511965976  # pi / 3


@compiled
def after(h):
    """The next half-edge around the same element."""
    return h + 1 if h % 3 < 2 else h - 2


@compiled
def before(h):
    """The previous half-edge around the same element."""
    return h - 1 if h % 3 else h + 2


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
def turn(x, y, corners):
    """Twice the signed area of an element, or 0 if it is within rounding of flat."""
    a, b, c = corners
    left = (x[b] - x[a]) * (y[c] - y[a])
    right = (x[c] - x[a]) * (y[b] - y[a])
    area = left - right
    return area if abs(area) > FLAT * (abs(left) + abs(right)) else 0.0


@compiled
def plane(x, y, u, corners, area):
    """Gradient of the plane over an element, by differences from its first node."""
    a, b, c = corners
    bx, by, bu = x[b] - x[a], y[b] - y[a], u[b] - u[a]
    cx, cy, cu = x[c] - x[a], y[c] - y[a], u[c] - u[a]
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
def side_cost(code, x, y, g, A, beyond, a, b, gx, gy, area):
    """Cost of the outer edge a-b of the quadrilateral; 0 on the boundary."""
    if beyond < 0:
        return 0.0
    length = 1.0
    if code >= DLP:
        length = sqrt((x[a] - x[b]) ** 2 + (y[a] - y[b]) ** 2)
    return edge_cost(code, g, A, (gx[beyond], gy[beyond]), area[beyond], length)


@compiled
def corner(x, y, a, b, c):
    """The angle at a between b and c."""
    ux, uy, vx, vy = x[b] - x[a], y[b] - y[a], x[c] - x[a], y[c] - y[a]
    return atan2(abs(ux * vy - uy * vx), ux * vx + uy * vy)


@compiled
def element_cost(code, x, y, corners):
    """How far the smallest or largest angle of an element is from 60 degrees."""
    a, b, c = corners
    p, q, r = corner(x, y, a, b, c), corner(x, y, b, c, a), corner(x, y, c, a, b)
    excess = EQUILATERAL - min(p, q, r) if code == SMALLEST_ANGLE else max(p, q, r) - EQUILATERAL
    return max(excess, 0.0)  # not below 0 by rounding


@compiled
def combined(norm, p, q, r, s, t):
    """What the norm compares: the sum, the sum of squares, or the maximum."""
    if norm == SUM:
        return p + q + r + s + t
    if norm == SQUARES:
        return p * p + q * q + r * r + s * s + t * t
    return max(p, q, r, s, t)


@compiled
def five_edges(code, norm, x, y, p, q, r, s, g, A, h, B, beyond, gx, gy, area):
    """Local cost of the diagonal p-q: itself and the sides of its quadrilateral.

    The element to the left of p-q has the opposite node r, gradient g and area A/2;
    the one to the right s, h and B/2; beyond q-r, r-p, p-s, s-q lie ``beyond``.
    """
    length = 1.0
    if code >= DLP:
        length = sqrt((x[p] - x[q]) ** 2 + (y[p] - y[q]) ** 2)
    return combined(norm, edge_cost(code, g, A, h, B, length),
                    side_cost(code, x, y, g, A, beyond[0], q, r, gx, gy, area),
                    side_cost(code, x, y, g, A, beyond[1], r, p, gx, gy, area),
                    side_cost(code, x, y, h, B, beyond[2], p, s, gx, gy, area),
                    side_cost(code, x, y, h, B, beyond[3], s, q, gx, gy, area))


@compiled
def too_sharp(x, y, corners, min_angle):
    """Whether an element has an angle below the limit (section 6.1)."""
    a, b, c = corners
    return min(corner(x, y, a, b, c), corner(x, y, b, c, a), corner(x, y, c, a, b)) < min_angle


@compiled
def outer_elements(h, j, twin):
    """The elements beyond b-c, c-a, a-d, d-b, or -1."""
    n1, n2, n3, n4 = twin[after(h)], twin[before(h)], twin[after(j)], twin[before(j)]
    return (n1 // 3 if n1 >= 0 else -1, n2 // 3 if n2 >= 0 else -1,
            n3 // 3 if n3 >= 0 else -1, n4 // 3 if n4 >= 0 else -1)


@compiled
def link(h, j, twin, slot, half, edge):
    """Make h and j (or the boundary, -1) the two sides of an edge."""
    twin[h] = j
    slot[h] = edge
    half[edge] = h
    if j >= 0:
        twin[j] = h


@compiled
def flip(h, j, c, d, element, twin, slot, half):
    """Replace the diagonal a-b by c-d (see the drawing above); the edge keeps its slot."""
    t1, s1 = after(h), after(j)
    beyond_bc, slot_bc = twin[t1], slot[t1]
    beyond_ad, slot_ad = twin[s1], slot[s1]
    diagonal = slot[h]
    element[before(h)] = d
    element[before(j)] = c
    link(h, beyond_ad, twin, slot, half, slot_ad)
    link(j, beyond_bc, twin, slot, half, slot_bc)
    link(t1, s1, twin, slot, half, diagonal)
    slot[s1] = diagonal


@compiled
def refused(x, y, corners, area, min_angle, min_area):
    """Whether an element would be flat or break a limit of section 6.1."""
    if area <= 0 or area < min_area:
        return True
    return min_angle > 0 and too_sharp(x, y, corners, min_angle)


@compiled
def angle_costs(code, norm, x, y, a, b, c, d, cad, dbc):
    """Cost of the elements at a-b and of those at c-d instead."""
    p = element_cost(code, x, y, from_smallest(c, a, b))
    q = element_cost(code, x, y, from_smallest(d, b, a))
    r, s = element_cost(code, x, y, cad), element_cost(code, x, y, dbc)
    return combined(norm, p, q, 0.0, 0.0, 0.0), combined(norm, r, s, 0.0, 0.0, 0.0)


@compiled
def jump_costs(code, norm, x, y, a, b, c, d, h, j, g, A, k, B, twin, gx, gy, area):
    """Cost of the five edges around a-b, and of those around c-d instead.

    The new elements have the gradients g, k and the areas A/2, B/2.
    """
    t, s = h // 3, j // 3
    n1, n2, n3, n4 = outer_elements(h, j, twin)
    old = five_edges(code, norm, x, y, a, b, c, d, (gx[t], gy[t]), area[t],
                     (gx[s], gy[s]), area[s], (n1, n2, n3, n4), gx, gy, area)
    new = five_edges(code, norm, x, y, d, c, a, b, g, A, k, B, (n2, n3, n4, n1), gx, gy, area)
    return old, new


@compiled
def record(log, costs, row, e, a, b, c, d, accepted, old, new):
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    log[6 * row], log[6 * row + 1], log[6 * row + 2] = e, a, b
    log[6 * row + 3], log[6 * row + 4], log[6 * row + 5] = c, d, accepted
    costs[2 * row], costs[2 * row + 1] = old, new


@compiled
def sweep(order, code, norm, relative, absolute, min_angle, min_area,
          x, y, u, element, twin, slot, half, gx, gy, area, log, costs):
    """Inspect every edge once, in order, and swap those that are not locally optimal.

    Returns the number of swaps and of swaps tried; with room in ``log`` and
    ``costs`` every tried swap is recorded there.
    """
    swaps = tried = 0
    for e in order:
        h = half[e]
        j = twin[h]
        if j < 0:
            continue
        a, b, c, d = element[after(h)], element[before(h)], element[h], element[j]
        cad, dbc = from_smallest(c, a, d), from_smallest(d, b, c)
        A, B = turn(x, y, cad), turn(x, y, dbc)
        if refused(x, y, cad, A, min_angle, min_area) or refused(x, y, dbc, B, min_angle, min_area):
            continue
        g, k = plane(x, y, u, cad, A), plane(x, y, u, dbc, B)
        if code >= SMALLEST_ANGLE:
            old, new = angle_costs(code, norm, x, y, a, b, c, d, cad, dbc)
        else:
            old, new = jump_costs(code, norm, x, y, a, b, c, d, h, j, g, A, k, B, twin, gx, gy, area)
        accepted = new < old * (1 - relative) - absolute
        if len(log) > 0:
            record(log, costs, tried, e, a, b, c, d, accepted, old, new)
        tried += 1
        if accepted:
            flip(h, j, c, d, element, twin, slot, half)
            t, s = h // 3, j // 3
            gx[t], gy[t], area[t] = g[0], g[1], A
            gx[s], gy[s], area[s] = k[0], k[1], B
            swaps += 1
    return swaps, tried
