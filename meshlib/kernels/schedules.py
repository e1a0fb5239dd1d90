"""In which order the local optimisation procedure inspects edges: in sweeps, or from a queue.

Both go on from where the last call stopped, after at most ``limit`` edges, so that long
runs can be watched and stopped with a whole mesh.  What has been done stands in a
tally: the place in the order, how many edges wait in the queue, swaps, sweeps, swaps
tried, swaps before the sweep, and the edge of a cost that is not one, or -1.
"""

from .backend import compiled
from .codes import BEFORE, FAULT, INVALID, PLACE, REFUSED, SWAPPED, SWAPS, SWEEPS, TRIES, UNKNOWN, WAITING
from .lop import after, before, inspect


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
def sweep(
    order,
    tally,
    limit,
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
):
    """Inspect the next edges of a sweep, and swap those that are not locally optimal.

    An edge around which nothing has changed since it was last inspected is passed
    over, for it would only be kept again.  If what is tried is recorded, no edge is
    passed over, and rows are counted from the first of this call.
    """
    first, tried, swaps = tally[PLACE], 0, 0
    last = min(first + limit, len(order))
    for place in range(first, last):
        e = order[place]
        if settled[e] != UNKNOWN and len(log) == 0:
            tried += settled[e]
            continue
        found = inspect(
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
            tried,
        )
        tried += found != REFUSED
        if found == SWAPPED:
            unsettle(half[e], element, twin, slot, settled, order, 0, 0)
            settled[e] = UNKNOWN
            swaps += 1
        elif found == INVALID:
            tally[FAULT] = e
    tally[PLACE] = last % len(order)
    tally[SWAPS] += swaps
    tally[TRIES] += tried


@compiled
def is_last(tally):
    """Count a sweep, if it is at its end, and say whether nothing is left to do."""
    if tally[FAULT] >= 0:
        return True
    if tally[PLACE] > 0:
        return False
    tally[SWEEPS] += 1
    ended = tally[SWAPS] == tally[BEFORE]
    tally[BEFORE] = tally[SWAPS]
    return ended


@compiled
def swept(
    order,
    tally,
    limit,
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
):
    """Sweep until nothing is swapped, or the limit is reached; whether all is done."""
    begin = tally[SWEEPS] * len(order) + tally[PLACE]
    while tally[SWEEPS] * len(order) + tally[PLACE] - begin < limit:
        left = begin + limit - tally[SWEEPS] * len(order) - tally[PLACE]
        sweep(
            order,
            tally,
            left,
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
        )
        if is_last(tally):
            return True
    return False


@compiled
def drained(
    queue,
    tally,
    limit,
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
):
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
        found = inspect(
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
            tried,
        )
        tried += found != REFUSED
        if found == SWAPPED:
            waiting += unsettle(half[e], element, twin, slot, settled, queue, first + waiting, n)
            swaps += 1
        elif found == INVALID:
            tally[FAULT] = e
    tally[PLACE], tally[WAITING], tally[TRIES], tally[SWAPS] = first, waiting, tried, swaps
    return waiting == 0 or tally[FAULT] >= 0


@compiled
def walked(
    edges,
    rises,
    tally,
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
):
    """Inspect edges one after the other; a swap may raise the sum of costs by less than its rise.

    The tolerances are not used.  Rows of what is recorded are numbered like the edges.
    """
    for i in range(len(edges)):
        e = edges[i]
        found = inspect(
            e,
            code,
            given,
            norm,
            0.0,
            -rises[i],
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
            i,
        )
        if found == SWAPPED:
            tally[SWAPS] += 1
        elif found == INVALID:
            tally[FAULT] = e
