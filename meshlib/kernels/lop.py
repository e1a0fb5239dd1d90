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

from .backend import compiled, inlined
from .costs import (
    DLP,
    SMALLEST_ANGLE,
    combined,
    edge_cost,
    element_cost,
    from_smallest,
    is_below,
    is_convex,
    plane,
    refused,
    side_cost,
    turn,
)

UNKNOWN, REFUSED, TRIED, SWAPPED = -1, 0, 1, 2  # of an edge: a swap was refused, tried in vain, or made


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


@inlined
def known_cost(norm, five, cost):
    """Local cost of a-b from the costs of its five edges."""
    e, bc, ca, ad, db = five
    return combined(norm, cost[e], cost[bc], cost[ca], cost[ad], cost[db])


@compiled
def diagonal_cost(code, x, y, c, d, g, A, k, B):
    """Cost of c-d between (c, a, d) and (d, b, c), of gradients g, k and areas A/2, B/2."""
    length = 1.0
    if code >= DLP:
        length = sqrt((x[c] - x[d]) ** 2 + (y[c] - y[d]) ** 2)
    return edge_cost(code, g, A, k, B, length)


@inlined
def new_costs(code, x, y, a, b, c, d, beyond, own, g, A, k, B, gx, gy, area):
    """Costs of c-d, which is ``own``, and of b-c, c-a, a-d, d-b after the swap."""
    bc, ca, ad, db = beyond
    return (own,
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
def unsettle(h, element, twin, slot, settled, queue, last, n):
    """Mark the edges whose local cost the swap to the edge of half-edge h may have changed.

    These are, for the edge c-d with c < d, the sides d-b, b-c, c-a, a-d and the two
    other edges of the element beyond each.  Those that were settled are appended to the
    queue, a ring of n places of which ``last`` is the next free one, if it has any;
    returns how many were.
    """
    j, count = twin[h], 0
    if element[after(h)] > element[before(h)]:  # h is to run from c to d
        h, j = j, h
    for g in (after(h), before(h), after(j), before(j)):
        count += wake(slot[g], settled, queue, last + count, n)
        beyond = twin[g]
        if beyond >= 0:
            count += wake(slot[after(beyond)], settled, queue, last + count, n)
            count += wake(slot[before(beyond)], settled, queue, last + count, n)
    return count


@compiled
def wake(e, settled, queue, place, n):
    """Mark one edge, and queue it if it is not waiting there."""
    if settled[e] == UNKNOWN:
        return 0
    settled[e] = UNKNOWN
    if n > 0:
        queue[place % n] = e
    return 1


@compiled
def record(log, costs, row, e, a, b, c, d, accepted, old, new):
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    log[6 * row], log[6 * row + 1], log[6 * row + 2] = e, a, b
    log[6 * row + 3], log[6 * row + 4], log[6 * row + 5] = c, d, accepted
    costs[2 * row], costs[2 * row + 1] = old, new


@inlined
def inspect(e, code, norm, relative, absolute, min_angle, min_area,
            x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs, row):
    """Swap an edge if it is not locally optimal: REFUSED, TRIED or SWAPPED.

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
        old, new = angle_costs(code, norm, x, y, a, b, c, d, cad, dbc)
    else:
        old, own = known_cost(norm, five, cost), diagonal_cost(code, x, y, c, d, g, A, k, B)
        least = combined(norm, own, 0.0, 0.0, 0.0, 0.0)  # whatever the sides cost
        if not traced and not is_below(norm, least, old, relative, absolute):
            return TRIED
        fresh = new_costs(code, x, y, a, b, c, d, outer_elements(h, j, twin), own, g, A, k, B, gx, gy, area)
        new = combined(norm, fresh[0], fresh[2], fresh[3], fresh[4], fresh[1])
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


@compiled
def sweep(order, code, norm, relative, absolute, min_angle, min_area,
          x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs):
    """Inspect every edge once, in order, and swap those that are not locally optimal.

    An edge around which nothing has changed since it was last inspected is passed
    over, for it would only be kept again.  Returns the number of swaps and of swaps
    tried; if they are recorded, no edge is passed over.
    """
    swaps = tried = 0
    for e in order:
        if settled[e] != UNKNOWN and len(log) == 0:
            tried += settled[e]
            continue
        found = inspect(e, code, norm, relative, absolute, min_angle, min_area,
                        x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs, tried)
        tried += found != REFUSED
        if found == SWAPPED:
            unsettle(half[e], element, twin, slot, settled, order, 0, 0)
            settled[e] = UNKNOWN
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


@compiled
def drained(queue, code, norm, relative, absolute, min_angle, min_area,
            x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs):
    """Inspect the first of a queue of edges until it is empty; a swap queues what it may have changed.

    The queue holds all edges at first and is overwritten.  Returns as `optimised` does,
    with no sweeps.
    """
    swaps = tried = first = 0
    n = len(queue)
    waiting = n
    while waiting > 0:
        e = queue[first]
        first, waiting = (first + 1) % n, waiting - 1
        found = inspect(e, code, norm, relative, absolute, min_angle, min_area,
                        x, y, u, element, twin, slot, half, gx, gy, area, cost, settled, log, costs, tried)
        tried += found != REFUSED
        if found == SWAPPED:
            waiting += unsettle(half[e], element, twin, slot, settled, queue, first + waiting, n)
            swaps += 1
    return swaps, 0, tried
