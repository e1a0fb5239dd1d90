"""In which order the local optimisation procedure inspects edges: in sweeps, or from a queue.

Both go on from where the last call stopped, after at most ``limit`` edges, so that long
runs can be watched and stopped with a whole mesh.  What has been done stands in a
tally: the place in the order, how many edges wait in the queue, swaps, sweeps, swaps
tried, swaps before the sweep, and the edge of a cost that is not one, or -1.
"""

from .codes import BEFORE, FAULT, INVALID, PLACE, REFUSED, SWAPPED, SWAPS, SWEEPS, TRIES, UNKNOWN, WAITING
from .groups import Floats, Ints, Log, Rules, State, UserCost
from .lop import after, before, inspect
from .marks import kernel


@kernel
def unsettle(h: int, state: State, queue: Ints, last: int, n: int) -> int:
    """Mark the edges whose local cost the swap to the edge of half-edge h may have changed.

    These are, for the edge c-d with c < d, the sides d-b, b-c, c-a, a-d and the two
    other edges of the element beyond each.  Those that were settled are appended to the
    queue, a ring of n places of which ``last`` is the next free one, if it has any;
    returns how many were.
    """
    element, twin, slot, settled = state.element, state.twin, state.slot, state.settled
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


@kernel
def wake(e: int, settled: Ints, queue: Ints, place: int, n: int) -> int:
    """Mark one edge, and queue it if it is not waiting there."""
    if settled[e] == UNKNOWN:
        return 0
    settled[e] = UNKNOWN
    if n > 0:
        queue[place % n] = e
    return 1


@kernel
def sweep(
    order: Ints, tally: Ints, limit: int, given: UserCost | None, rules: Rules, state: State, log: Log
) -> None:
    """Inspect the next edges of a sweep, and swap those that are not locally optimal.

    An edge around which nothing has changed since it was last inspected is passed
    over, for it would only be kept again.  If what is tried is recorded, no edge is
    passed over, and rows are counted from the first of this call.
    """
    first, tried, swaps, settled = tally[PLACE], 0, 0, state.settled
    last = min(first + limit, len(order))
    for place in range(first, last):
        e = order[place]
        if settled[e] != UNKNOWN and len(log.costs) == 0:
            tried += settled[e]
            continue
        found = inspect(e, given, rules, state, log, tried)
        tried += found != REFUSED
        if found == SWAPPED:
            unsettle(state.half[e], state, order, 0, 0)
            settled[e] = UNKNOWN
            swaps += 1
        elif found == INVALID:
            tally[FAULT] = e
    tally[PLACE] = last % len(order)
    tally[SWAPS] += swaps
    tally[TRIES] += tried


@kernel
def is_last(tally: Ints) -> bool:
    """Count a sweep, if it is at its end, and say whether nothing is left to do."""
    if tally[FAULT] >= 0:
        return True
    if tally[PLACE] > 0:
        return False
    tally[SWEEPS] += 1
    ended = tally[SWAPS] == tally[BEFORE]
    tally[BEFORE] = tally[SWAPS]
    return ended


@kernel
def swept(
    order: Ints, tally: Ints, limit: int, given: UserCost | None, rules: Rules, state: State, log: Log
) -> bool:
    """Sweep until nothing is swapped, or the limit is reached; whether all is done."""
    begin = tally[SWEEPS] * len(order) + tally[PLACE]
    while tally[SWEEPS] * len(order) + tally[PLACE] - begin < limit:
        left = begin + limit - tally[SWEEPS] * len(order) - tally[PLACE]
        sweep(order, tally, left, given, rules, state, log)
        if is_last(tally):
            return True
    return False


@kernel
def drained(
    queue: Ints, tally: Ints, limit: int, given: UserCost | None, rules: Rules, state: State, log: Log
) -> bool:
    """Inspect the first of a queue of edges until it is empty; a swap queues what it may have changed.

    The queue holds all edges at first and is overwritten.  Returns whether all is done.
    """
    n, first, waiting = len(queue), tally[PLACE], tally[WAITING]
    tried, swaps = tally[TRIES], tally[SWAPS]
    while waiting > 0 and limit > 0 and tally[FAULT] < 0:
        e = queue[first]
        first, waiting, limit = first + 1, waiting - 1, limit - 1
        if first == n:
            first = 0
        found = inspect(e, given, rules, state, log, tried)
        tried += found != REFUSED
        if found == SWAPPED:
            waiting += unsettle(state.half[e], state, queue, first + waiting, n)
            swaps += 1
        elif found == INVALID:
            tally[FAULT] = e
    tally[PLACE], tally[WAITING], tally[TRIES], tally[SWAPS] = first, waiting, tried, swaps
    return waiting == 0 or tally[FAULT] >= 0


@kernel
def walked(
    edges: Ints, rises: Floats, tally: Ints, given: UserCost | None, rules: Rules, state: State, log: Log
) -> None:
    """Inspect edges one after the other; a swap may raise the sum of costs by less than its rise.

    The tolerances are not used.  Rows of what is recorded are numbered like the edges.
    """
    for i in range(len(edges)):
        e = edges[i]
        allowing = Rules(rules.code, rules.norm, 0.0, -rises[i], rules.min_angle, rules.min_area)
        found = inspect(e, given, allowing, state, log, i)
        if found == SWAPPED:
            tally[SWAPS] += 1
        elif found == INVALID:
            tally[FAULT] = e
