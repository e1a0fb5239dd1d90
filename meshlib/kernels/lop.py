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
from math import sqrt

from .backend import compiled
from .costs import (
    DLP,
    SMALLEST_ANGLE,
    combined,
    edge_cost,
    element_cost,
    from_smallest,
    is_below,
    plane,
    refused,
    side_cost,
    turn,
)

UNKNOWN, REFUSED, TRIED = -1, 0, 1  # what is known of an edge: a swap was refused, or tried in vain


@compiled
def after(h):
    """The next half-edge around the same element."""
    return h + 1 if h % 3 < 2 else h - 2


@compiled
def before(h):
    """The previous half-edge around the same element."""
    return h - 1 if h % 3 else h + 2


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
def angle_costs(code, norm, x, y, a, b, c, d, cad, dbc):
    """Cost of the elements at a-b and of those at c-d instead."""
    p = element_cost(code, x, y, from_smallest(c, a, b))
    q = element_cost(code, x, y, from_smallest(d, b, a))
    r, s = element_cost(code, x, y, cad), element_cost(code, x, y, dbc)
    return combined(norm, p, q, 0.0, 0.0, 0.0), combined(norm, r, s, 0.0, 0.0, 0.0)


@compiled
def around(h, j, slot):
    """The five edges of the quadrilateral: a-b, b-c, c-a, a-d, d-b."""
    return slot[h], slot[after(h)], slot[before(h)], slot[after(j)], slot[before(j)]


@compiled
def known_cost(norm, five, cost):
    """Local cost of a-b from the costs of its five edges."""
    e, bc, ca, ad, db = five
    return combined(norm, cost[e], cost[bc], cost[ca], cost[ad], cost[db])


@compiled
def new_costs(code, x, y, a, b, c, d, beyond, g, A, k, B, gx, gy, area):
    """Costs of c-d, b-c, c-a, a-d, d-b after the swap.

    The elements (c, a, d) and (d, b, c) have the gradients g, k and the areas A/2, B/2.
    """
    bc, ca, ad, db = beyond
    length = 1.0
    if code >= DLP:
        length = sqrt((x[c] - x[d]) ** 2 + (y[c] - y[d]) ** 2)
    return (edge_cost(code, g, A, k, B, length),
            side_cost(code, x, y, k, B, bc, b, c, gx, gy, area),
            side_cost(code, x, y, g, A, ca, c, a, gx, gy, area),
            side_cost(code, x, y, g, A, ad, a, d, gx, gy, area),
            side_cost(code, x, y, k, B, db, d, b, gx, gy, area))


@compiled
def first_costs(code, x, y, element, twin, half, gx, gy, area, cost):
    """Set the cost of every edge of the start mesh."""
    for e in range(len(half)):
        h = half[e]
        t, beyond = h // 3, twin[h] // 3 if twin[h] >= 0 else -1
        a, b = element[after(h)], element[before(h)]
        cost[e] = side_cost(code, x, y, (gx[t], gy[t]), area[t], beyond, a, b, gx, gy, area)


@compiled
def unsettle(five, twin, slot, half, settled):
    """Mark the edges whose local cost the swap of the first of five may have changed."""
    settled[five[0]] = UNKNOWN
    for e in five[1:]:
        settled[e] = UNKNOWN
        for h in (half[e], twin[half[e]]):
            if h >= 0:
                settled[slot[after(h)]] = settled[slot[before(h)]] = UNKNOWN


@compiled
def record(log, costs, row, e, a, b, c, d, accepted, old, new):
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    log[6 * row], log[6 * row + 1], log[6 * row + 2] = e, a, b
    log[6 * row + 3], log[6 * row + 4], log[6 * row + 5] = c, d, accepted
    costs[2 * row], costs[2 * row + 1] = old, new


@compiled
def sweep(order, code, norm, relative, absolute, min_angle, min_area,
          x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs):
    """Inspect every edge once, in order, and swap those that are not locally optimal.

    An edge around which nothing has changed since it was last inspected is passed
    over, for it would only be kept again.  Returns the number of swaps and of swaps
    tried; with room in ``log`` and ``costs`` every tried swap is recorded there, and
    no edge is passed over.
    """
    swaps = tried = 0
    traced = len(log) > 0
    for e in order:
        if settled[e] != UNKNOWN and not traced:
            tried += settled[e]
            continue
        settled[e] = REFUSED
        h = half[e]
        j = twin[h]
        if j < 0:
            continue
        a, b, c, d = element[after(h)], element[before(h)], element[h], element[j]
        cad, dbc = from_smallest(c, a, d), from_smallest(d, b, c)
        A, B = turn(x, y, cad), turn(x, y, dbc)
        if refused(x, y, cad, A, min_angle, min_area) or refused(x, y, dbc, B, min_angle, min_area):
            continue
        settled[e] = TRIED
        g, k, five = plane(x, y, u, cad, A), plane(x, y, u, dbc, B), around(h, j, slot)
        if code >= SMALLEST_ANGLE:
            fresh = (0.0, 0.0, 0.0, 0.0, 0.0)
            old, new = angle_costs(code, norm, x, y, a, b, c, d, cad, dbc)
        else:
            fresh = new_costs(code, x, y, a, b, c, d, outer_elements(h, j, twin), g, A, k, B, gx, gy, area)
            old = known_cost(norm, five, cost)
            new = combined(norm, fresh[0], fresh[2], fresh[3], fresh[4], fresh[1])
        accepted = is_below(norm, new, old, relative, absolute)
        if traced:
            record(log, costs, tried, e, a, b, c, d, accepted, old, new)
        tried += 1
        if accepted:
            flip(h, j, c, d, element, twin, slot, half)
            t, s = h // 3, j // 3
            gx[t], gy[t], area[t] = g[0], g[1], A
            gx[s], gy[s], area[s] = k[0], k[1], B
            cost[five[0]], cost[five[1]], cost[five[2]], cost[five[3]], cost[five[4]] = fresh
            unsettle(five, twin, slot, half, settled)
            swaps += 1
    return swaps, tried


@compiled
def optimised(order, code, norm, relative, absolute, min_angle, min_area,
              x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs):
    """Sweep until nothing is swapped; the numbers of swaps, of sweeps and of swaps tried."""
    swaps = sweeps = tried = 0
    changed = True
    while changed:
        found = sweep(order, code, norm, relative, absolute, min_angle, min_area,
                      x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs)
        swaps, sweeps, tried, changed = swaps + found[0], sweeps + 1, tried + found[1], found[0] > 0
    return swaps, sweeps, tried
