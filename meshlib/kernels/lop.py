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

from math import nan

from .backend import compiled, inlined
from .codes import DLP, INVALID, REFUSED, SMALLEST_ANGLE, SWAPPED, TRIED
from .costs import (
    are_costs,
    combined,
    distance,
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
def element_costs(code, given, norm, point, a, b, c, d, cad, dbc):
    """Cost of the elements at a-b and of those at c-d instead; NaN if one is not a cost."""
    p = element_cost(code, given, point, from_smallest(c, a, b))
    q = element_cost(code, given, point, from_smallest(d, b, a))
    r, s = element_cost(code, given, point, cad), element_cost(code, given, point, dbc)
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
def diagonal_cost(code, given, point, a, b, c, d, g, A, k, B):
    """Cost of c-d between (c, a, d) and (d, b, c), of gradients g, k and areas A/2, B/2."""
    if given is not None:
        return own_edge_cost(given, point, c, d, b, a)
    return edge_cost(code, g, A, k, B, distance(point, c, d) if code >= DLP else 1.0)


@inlined
def new_costs(code, given, point, a, b, c, d, beyond, across, g, A, k, B, element, face):
    """Costs of c-d, which is ``across``, and of b-c, c-a, a-d, d-b after the swap."""
    bc, ca, ad, db = beyond
    return (
        across,
        side_cost(code, given, point, d, k, B, bc, b, c, element, face),
        side_cost(code, given, point, d, g, A, ca, c, a, element, face),
        side_cost(code, given, point, c, g, A, ad, a, d, element, face),
        side_cost(code, given, point, c, k, B, db, d, b, element, face),
    )


@compiled
def first_costs(code, given, point, element, twin, half, face, cost):
    """Set the cost of every edge of the start mesh."""
    for e in range(len(half)):
        h = half[e]
        t, a, b = 3 * (h // 3), element[after(h)], element[before(h)]
        cost[e] = side_cost(
            code, given, point, element[h], (face[t], face[t + 1]), face[t + 2], twin[h], a, b, element, face
        )


@compiled
def set_face(face, t, g, A):
    """Gradient and doubled area of an element."""
    face[3 * t], face[3 * t + 1], face[3 * t + 2] = g[0], g[1], A


@compiled
def record(log, costs, row, e, a, b, c, d, accepted, old, new):
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    log[6 * row], log[6 * row + 1], log[6 * row + 2] = e, a, b
    log[6 * row + 3], log[6 * row + 4], log[6 * row + 5] = c, d, accepted
    costs[2 * row], costs[2 * row + 1] = old, new


@inlined
def inspect(
    e,
    code,
    given,
    norm,
    relative,
    absolute,
    min_angle,
    min_area,
    point,
    element,
    twin,
    slot,
    half,
    face,
    cost,
    settled,
    log,
    costs,
    row,
):
    """Swap an edge if it is not locally optimal: REFUSED, TRIED or SWAPPED; or INVALID.

    With room in ``log`` and ``costs`` a tried swap is recorded there in the given row.
    """
    settled[e] = REFUSED
    h = half[e]
    j = twin[h]
    if j < 0:
        return REFUSED
    a, b, c, d = element[after(h)], element[before(h)], element[h], element[j]
    if not is_convex(point, a, b, c, d):
        return REFUSED
    cad, dbc = from_smallest(c, a, d), from_smallest(d, b, c)
    A, B = turn(point, cad), turn(point, dbc)
    if refused(point, cad, A, min_angle, min_area) or refused(point, dbc, B, min_angle, min_area):
        return REFUSED
    settled[e] = TRIED
    traced = len(log) > 0
    g, k, five = plane(point, cad, A), plane(point, dbc, B), around(h, j, slot)
    if code >= SMALLEST_ANGLE:
        fresh = (0.0, 0.0, 0.0, 0.0, 0.0)
        old, new = element_costs(code, given, norm, point, a, b, c, d, cad, dbc)
    else:
        old = known_cost(norm, five, cost)
        across = diagonal_cost(code, given, point, a, b, c, d, g, A, k, B)
        least = combined(norm, across, 0.0, 0.0, 0.0, 0.0)  # whatever the sides cost
        if given is None and not traced and not is_below(norm, least, old, relative, absolute):
            return TRIED
        fresh = new_costs(
            code, given, point, a, b, c, d, outer(h, j, twin), across, g, A, k, B, element, face
        )
        new = combined(norm, fresh[0], fresh[2], fresh[3], fresh[4], fresh[1])
    if given is not None and not (old >= 0 and are_costs(*fresh)):
        return INVALID
    accepted = is_below(norm, new, old, relative, absolute)
    if traced:
        record(log, costs, row, e, a, b, c, d, accepted, old, new)
    if not accepted:
        return TRIED
    flip(h, j, c, d, element, twin, slot, half)
    set_face(face, h // 3, g, A)
    set_face(face, j // 3, k, B)
    cost[five[0]], cost[five[1]], cost[five[2]], cost[five[3]], cost[five[4]] = fresh
    return SWAPPED
