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

from math import inf, nan

from .codes import DLP, INVALID, REFUSED, SMALLEST_ANGLE, SWAPPED, TRIED
from .costs import (
    are_costs,
    combined,
    distance,
    edge_cost,
    element_cost,
    face_of,
    from_smallest,
    is_below,
    is_convex,
    node,
    refused,
    side_cost,
    turn,
    user_edge_cost,
)
from .groups import Corners, Face, Five, Floats, Ints, Log, Quad, Rules, State, UserCost
from .marks import inlined, kernel

NO_COSTS = (0.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def after(h: int) -> int:
    """The next half-edge around the same element."""
    return h + 1 if h % 3 < 2 else h - 2


@kernel
def before(h: int) -> int:
    """The previous half-edge around the same element."""
    return h - 1 if h % 3 else h + 2


@kernel
def around(h: int, j: int, of_half_edge: Ints) -> tuple[int, int, int, int]:
    """What an array has for the half-edges b-c, c-a of t and a-d, d-b of s."""
    return of_half_edge[after(h)], of_half_edge[before(h)], of_half_edge[after(j)], of_half_edge[before(j)]


@kernel
def link(h: int, j: int, state: State, edge: int) -> None:
    """Make h and j (or the boundary, -1) the two sides of an edge."""
    state.twin[h] = j
    state.slot[h] = edge
    state.half[edge] = h
    if j >= 0:
        state.twin[j] = h


@kernel
def flip(h: int, j: int, state: State) -> None:
    """Replace the diagonal a-b by c-d (see the drawing above); the edge keeps its slot."""
    element, twin, slot = state.element, state.twin, state.slot
    t1, s1 = after(h), after(j)
    beyond_bc, slot_bc = twin[t1], slot[t1]
    beyond_ad, slot_ad = twin[s1], slot[s1]
    diagonal = slot[h]
    element[before(h)], element[before(j)] = element[j], element[h]
    link(h, beyond_ad, state, slot_ad)
    link(j, beyond_bc, state, slot_bc)
    link(t1, s1, state, diagonal)
    slot[s1] = diagonal


@kernel
def set_face(face: Floats, t: int, found: Face) -> None:
    """Gradient and doubled area of an element."""
    face[3 * t], face[3 * t + 1], face[3 * t + 2] = found


@kernel
def first_costs(given: UserCost | None, code: int, state: State) -> None:
    """Set the cost of every edge of the start mesh."""
    element, half = state.element, state.half
    for e in range(len(half)):
        h = half[e]
        corners = element[after(h)], element[before(h)], element[h]
        state.cost[e] = side_cost(given, code, state, corners, node(state.face, h // 3), state.twin[h])


@inlined
def inspect(e: int, given: UserCost | None, rules: Rules, state: State, log: Log, row: int) -> int:
    """Swap an edge if it is not locally optimal: REFUSED, TRIED or SWAPPED; or INVALID.

    With room in the log a tried swap is recorded there in the given row.
    """
    state.settled[e] = REFUSED
    h = state.half[e]
    j = state.twin[h]
    if j < 0:
        return REFUSED
    quad = state.element[after(h)], state.element[before(h)], state.element[h], state.element[j]
    if not is_convex(state.point, quad):
        return REFUSED
    a, b, c, d = quad
    first, second = from_smallest(c, a, d), from_smallest(d, b, c)
    A, B = turn(state.point, first), turn(state.point, second)
    if refused(state.point, first, A, rules) or refused(state.point, second, B, rules):
        return REFUSED
    state.settled[e] = TRIED
    faces = face_of(state.point, first, A), face_of(state.point, second, B)
    return tried(e, quad, (first, second), faces, given, rules, state, log, row)


@inlined
def tried(e, quad, elements, faces, given, rules, state, log, row):
    """Swap the edge of an admissible quadrilateral if it is not optimal; TRIED, SWAPPED or INVALID."""
    if rules.code >= SMALLEST_ANGLE:
        old, new, fresh = costs_of_elements(given, rules, state.point, quad, elements)
    else:
        old, new, fresh = costs_of_edges(e, quad, faces, given, rules, state, log)
    if given is not None and not (old >= 0 and are_costs(fresh)):
        return INVALID
    accepted = is_below(new, old, rules)
    if len(log.costs) > 0:
        record(log, row, e, quad, accepted, (old, new))
    if not accepted:
        return TRIED
    swap(e, faces, fresh, state)
    return SWAPPED


@kernel
def costs_of_elements(
    given: UserCost | None, rules: Rules, point: Floats, quad: Quad, new: tuple[Corners, Corners]
) -> tuple[float, float, Five]:
    """Cost of the elements at a-b and of those at c-d instead; NaN if one is not a cost."""
    a, b, c, d = quad
    p = element_cost(given, rules.code, point, from_smallest(c, a, b))
    q = element_cost(given, rules.code, point, from_smallest(d, b, a))
    r, s = element_cost(given, rules.code, point, new[0]), element_cost(given, rules.code, point, new[1])
    if given is not None and not are_costs((p, q, r, s, 0.0)):
        return nan, nan, NO_COSTS
    return combined(rules.norm, (p, q, 0.0, 0.0, 0.0)), combined(rules.norm, (r, s, 0.0, 0.0, 0.0)), NO_COSTS


@inlined
def costs_of_edges(e, quad, faces, given, rules, state, log):
    """Cost of the five edges around a-b, of those around c-d instead, and each of these.

    The new cost is infinite where c-d alone already costs too much.
    """
    h = state.half[e]
    j = state.twin[h]
    cost, (bc, ca, ad, db) = state.cost, around(h, j, state.slot)
    old = combined(rules.norm, (cost[e], cost[bc], cost[ca], cost[ad], cost[db]))
    across = diagonal_cost(given, rules.code, state.point, quad, faces)
    if given is None and len(log.costs) == 0:
        least = combined(rules.norm, (across, 0.0, 0.0, 0.0, 0.0))  # whatever the sides cost
        if not is_below(least, old, rules):
            return old, inf, NO_COSTS
    fresh = new_costs(given, rules.code, state, quad, faces, across, around(h, j, state.twin))
    return old, combined(rules.norm, (across, fresh[2], fresh[3], fresh[4], fresh[1])), fresh


@kernel
def diagonal_cost(
    given: UserCost | None, code: int, point: Floats, quad: Quad, faces: tuple[Face, Face]
) -> float:
    """Cost of c-d between the new elements (c, a, d) and (d, b, c)."""
    a, b, c, d = quad
    if given is not None:
        return user_edge_cost(given, point, (c, d, b, a))
    return edge_cost(code, faces[0], faces[1], distance(point, c, d) if code >= DLP else 1.0)


@inlined
def new_costs(given, code, state, quad, faces, across, beyond):
    """Costs after the swap of c-d, which is ``across``, and of b-c, c-a, a-d, d-b, with half-edges beyond."""
    a, b, c, d = quad
    bc, ca, ad, db = beyond
    return (
        across,
        side_cost(given, code, state, (b, c, d), faces[1], bc),
        side_cost(given, code, state, (c, a, d), faces[0], ca),
        side_cost(given, code, state, (a, d, c), faces[0], ad),
        side_cost(given, code, state, (d, b, c), faces[1], db),
    )


@inlined
def swap(e, faces, fresh, state):
    """Replace the edge by the other diagonal, with the faces beside it and the costs around it."""
    h = state.half[e]
    j = state.twin[h]
    bc, ca, ad, db = around(h, j, state.slot)
    flip(h, j, state)
    set_face(state.face, h // 3, faces[0])
    set_face(state.face, j // 3, faces[1])
    cost = state.cost
    cost[e], cost[bc], cost[ca], cost[ad], cost[db] = fresh


@kernel
def record(log: Log, row: int, e: int, quad: Quad, accepted: bool, costs: tuple[float, float]) -> None:
    """Write a tried swap to the trace: edge, nodes, whether accepted; both costs."""
    tried = log.tried
    tried[6 * row], tried[6 * row + 5] = e, accepted
    tried[6 * row + 1], tried[6 * row + 2], tried[6 * row + 3], tried[6 * row + 4] = quad
    log.costs[2 * row], log.costs[2 * row + 1] = costs
