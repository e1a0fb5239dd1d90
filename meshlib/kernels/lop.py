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
from math import nan, sqrt

from .backend import compiled, inlined
from .codes import DLP, INVALID, REFUSED, SMALLEST_ANGLE, SWAPPED, TRIED
from .costs import (
    are_costs,
    combined,
    edge_cost,
    element_cost,
    from_smallest,
    is_below,
    is_convex,
    own_edge_cost,
    plane,
    refused,
    side_cost,
    turn,
)


@compiled
def after(h):
    """The next half-edge around the same element."""
    return h + 1 if h % 3 < 2 else h - 2


@compiled
def before(h):
    """The previous half-edge around the same element."""
    return h - 1 if h % 3 else h + 2


@compiled
def outer(h, j, twin):
    """The half-edges beyond b-c, c-a, a-d, d-b, or -1."""
    return twin[after(h)], twin[before(h)], twin[after(j)], twin[before(j)]


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
def element_costs(code, given, norm, x, y, u, a, b, c, d, cad, dbc):
    """Cost of the elements at a-b and of those at c-d instead; NaN if one is not a cost."""
    p = element_cost(code, given, x, y, u, from_smallest(c, a, b))
    q = element_cost(code, given, x, y, u, from_smallest(d, b, a))
    r, s = element_cost(code, given, x, y, u, cad), element_cost(code, given, x, y, u, dbc)
    if given is not None and not are_costs(p, q, r, s, 0.0):
        return nan, nan
    return combined(norm, p, q, 0.0, 0.0, 0.0), combined(norm, r, s, 0.0, 0.0, 0.0)


@compiled
def around(h, j, slot):
    """The five edges of the quadrilateral: a-b, b-c, c-a, a-d, d-b."""
    return slot[h], slot[after(h)], slot[before(h)], slot[after(j)], slot[before(j)]


@inlined
def known_cost(norm, five, cost):
    """Local cost of a-b from the costs of its five edges."""
    e, bc, ca, ad, db = five
    return combined(norm, cost[e], cost[bc], cost[ca], cost[ad], cost[db])


@compiled
def diagonal_cost(code, given, x, y, u, a, b, c, d, g, A, k, B):
    """Cost of c-d between (c, a, d) and (d, b, c), of gradients g, k and areas A/2, B/2."""
    if given is not None:
        return own_edge_cost(given, x, y, u, c, d, b, a)
    length = 1.0
    if code >= DLP:
        length = sqrt((x[c] - x[d]) ** 2 + (y[c] - y[d]) ** 2)
    return edge_cost(code, g, A, k, B, length)


@inlined
def new_costs(code, given, x, y, u, a, b, c, d, beyond, across, g, A, k, B, element, gx, gy, area):
    """Costs of c-d, which is ``across``, and of b-c, c-a, a-d, d-b after the swap."""
    bc, ca, ad, db = beyond
    return (across,
            side_cost(code, given, x, y, u, d, k, B, bc, b, c, element, gx, gy, area),
            side_cost(code, given, x, y, u, d, g, A, ca, c, a, element, gx, gy, area),
            side_cost(code, given, x, y, u, c, g, A, ad, a, d, element, gx, gy, area),
            side_cost(code, given, x, y, u, c, k, B, db, d, b, element, gx, gy, area))


@compiled
def first_costs(code, given, x, y, u, element, twin, half, gx, gy, area, cost):
    """Set the cost of every edge of the start mesh."""
    for e in range(len(half)):
        h = half[e]
        t, a, b = h // 3, element[after(h)], element[before(h)]
        cost[e] = side_cost(code, given, x, y, u, element[h], (gx[t], gy[t]), area[t], twin[h], a, b,
                            element, gx, gy, area)


@compiled
def record(log, costs, row, e, a, b, c, d, accepted, old, new):
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    log[6 * row], log[6 * row + 1], log[6 * row + 2] = e, a, b
    log[6 * row + 3], log[6 * row + 4], log[6 * row + 5] = c, d, accepted
    costs[2 * row], costs[2 * row + 1] = old, new


@inlined
def inspect(e, code, given, norm, relative, absolute, min_angle, min_area,
            x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs, row):
    """Swap an edge if it is not locally optimal: REFUSED, TRIED or SWAPPED; or INVALID.

    With room in ``log`` and ``costs`` a tried swap is recorded there in the given row.
    """
    settled[e] = REFUSED
    h = half[e]
    j = twin[h]
    if j < 0:
        return REFUSED
    a, b, c, d = element[after(h)], element[before(h)], element[h], element[j]
    if not is_convex(x, y, a, b, c, d):
        return REFUSED
    cad, dbc = from_smallest(c, a, d), from_smallest(d, b, c)
    A, B = turn(x, y, cad), turn(x, y, dbc)
    if refused(x, y, cad, A, min_angle, min_area) or refused(x, y, dbc, B, min_angle, min_area):
        return REFUSED
    settled[e] = TRIED
    traced = len(log) > 0
    g, k, five = plane(x, y, u, cad, A), plane(x, y, u, dbc, B), around(h, j, slot)
    if code >= SMALLEST_ANGLE:
        fresh = (0.0, 0.0, 0.0, 0.0, 0.0)
        old, new = element_costs(code, given, norm, x, y, u, a, b, c, d, cad, dbc)
    else:
        old = known_cost(norm, five, cost)
        across = diagonal_cost(code, given, x, y, u, a, b, c, d, g, A, k, B)
        least = combined(norm, across, 0.0, 0.0, 0.0, 0.0)  # whatever the sides cost
        if given is None and not traced and not is_below(norm, least, old, relative, absolute):
            return TRIED
        fresh = new_costs(code, given, x, y, u, a, b, c, d, outer(h, j, twin), across, g, A, k, B,
                          element, gx, gy, area)
        new = combined(norm, fresh[0], fresh[2], fresh[3], fresh[4], fresh[1])
    if given is not None and not (old >= 0 and are_costs(*fresh)):
        return INVALID
    accepted = is_below(norm, new, old, relative, absolute)
    if traced:
        record(log, costs, row, e, a, b, c, d, accepted, old, new)
    if not accepted:
        return TRIED
    flip(h, j, c, d, element, twin, slot, half)
    t, s = h // 3, j // 3
    gx[t], gy[t], area[t] = g[0], g[1], A
    gx[s], gy[s], area[s] = k[0], k[1], B
    cost[five[0]], cost[five[1]], cost[five[2]], cost[five[3]], cost[five[4]] = fresh
    return SWAPPED
