r"""What the procedure needs of a mesh before its first swap, in passes over flat arrays.

Half-edge h = 3 t + k is the side of element t opposite its node k, as in `lop`.
"""

from .costs import face_of, from_smallest, sides
from .groups import Floats, Ints
from .lop import after, before, set_face
from .marks import kernel

NOWHERE = -1


@kernel
def edge_table(element: Ints, starts: Ints, half: Ints, other: Ints, slot: Ints, edges: Ints) -> int:
    """Number the edges in lexicographic order, by counting half-edges at their smaller node.

    ``starts`` has N + 1 zeros; ``half`` and ``other`` are room for one number for each
    half-edge; ``slot`` receives the edge of each half-edge and ``edges`` the nodes of
    each edge.  Returns the number of edges.
    """
    by_smaller_node(element, starts, half, other)
    count = begin = 0
    for n in range(len(starts) - 1):
        sort_by_key(half, other, begin, starts[n])
        last = -1
        for i in range(begin, starts[n]):
            if other[i] != last:
                last = other[i]
                edges[2 * count], edges[2 * count + 1] = n, last
                count += 1
            slot[half[i]] = count - 1
        begin = starts[n]
    return count


@kernel
def by_smaller_node(element: Ints, starts: Ints, half: Ints, other: Ints) -> None:
    """List half-edges by smaller node, with the larger one; ``starts`` receives the end of each list."""
    for h in range(len(element)):
        starts[min(element[after(h)], element[before(h)]) + 1] += 1
    for n in range(1, len(starts)):
        starts[n] += starts[n - 1]
    for h in range(len(element)):
        a, b = element[after(h)], element[before(h)]
        low = min(a, b)
        half[starts[low]], other[starts[low]] = h, a + b - low
        starts[low] += 1


@kernel
def sort_by_key(values: Ints, keys: Ints, begin: int, end: int) -> None:
    """Sort a few values by their keys; values with equal keys keep their order."""
    for i in range(begin + 1, end):
        value, key, j = values[i], keys[i], i - 1
        while j >= begin and keys[j] > key:
            values[j + 1], keys[j + 1] = values[j], keys[j]
            j -= 1
        values[j + 1], keys[j + 1] = value, key


@kernel
def twins(slot: Ints, twin: Ints, half: Ints) -> None:
    """Set the other side of each half-edge, and the last half-edge of each edge; both are -1 before."""
    for h in range(len(slot)):
        e = slot[h]
        if half[e] >= 0:
            twin[h] = half[e]
            twin[half[e]] = h
        half[e] = h


@kernel
def faces(element: Ints, point: Floats, face: Floats) -> None:
    """Set gradient and doubled area of each element; the gradient is NaN where the area is 0."""
    for t in range(len(element) // 3):
        corners = from_smallest(element[3 * t], element[3 * t + 1], element[3 * t + 2])
        u, v = sides(point, corners)
        area = u[0] * v[1] - v[0] * u[1]
        g = face_of(point, corners, area if area != 0 else float("nan"))
        set_face(face, t, (g[0], g[1], area))


@kernel
def gathered(element: Ints, row: Ints, number: Ints, found: Ints) -> None:
    """Set element t to the one in row[t], with node n renamed to number[n]."""
    for t in range(len(row)):
        at = 3 * row[t]
        for k in range(3):
            found[3 * t + k] = number[element[at + k]]


@kernel
def scattered(element: Ints, row: Ints, number: Ints, found: Ints) -> None:
    """Set the element in row[t] to element t, with node n renamed to number[n]."""
    for t in range(len(row)):
        at = 3 * row[t]
        for k in range(3):
            found[at + k] = number[element[3 * t + k]]
