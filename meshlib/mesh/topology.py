r"""Edges and neighbours, derived from the element array alone.

Half-edge 3 t + k is the side of element t opposite its node k; it runs from
node k + 1 to node k + 2 (counted modulo 3), so the element lies to its left::

            k
           / \
          / t \
       k+1 --> k+2
"""

import numpy as np

from .._typing import AnyMesh, IntArray
from ..errors import InvalidMeshError
from ..kernels import compiled_for_work
from ..kernels.backend import Plain

TAILS, HEADS = [1, 2, 0], [2, 0, 1]  # columns of the nodes k + 1 and k + 2, where half-edge k begins and ends
MANY = 10_000  # number of elements from which on counting is faster than sorting; the arrays are equal
HALF_EDGES_IN_A_STEP = 5  # number of half-edges that NumPy sorts in about a microsecond


def edge_table(elements: IntArray, n_nodes: int) -> tuple[IntArray, IntArray]:
    """Edges in lexicographic order, and the edge opposite each node of each element."""
    if len(elements) >= MANY and (kernels := compiled_for_work(elements.size / HALF_EDGES_IN_A_STEP)):
        return _edge_table_by_counting(elements, n_nodes, kernels)
    ends = np.stack([elements[:, TAILS], elements[:, HEADS]]).astype(np.int64)
    keys = ends.min(axis=0) * n_nodes + ends.max(axis=0)
    unique, numbers = np.unique(keys, return_inverse=True)
    edges = np.stack(np.divmod(unique, n_nodes), axis=1).astype(np.int32)
    return edges, numbers.reshape(elements.shape).astype(np.int32)


def _edge_table_by_counting(elements: IntArray, n_nodes: int, kernels: Plain) -> tuple[IntArray, IntArray]:
    """Edges, and the edge opposite each node, by a compiled kernel that counts."""
    size, number = elements.size, np.int32
    readable, writable = kernels.readable, kernels.writable
    slot, edges = writable(np.empty(size, dtype=number)), writable(np.empty(2 * size, dtype=number))
    rooms = (writable(np.zeros(n, dtype=number)) for n in (n_nodes + 1, size, size))
    count = kernels.half_edges.edge_table(readable(elements), *rooms, slot, edges)
    return (
        np.asarray(edges[: 2 * count], dtype=number).reshape(-1, 2),
        np.asarray(slot, dtype=number).reshape(-1, 3),
    )


def sides(elements: IntArray, element_edges: IntArray, n_edges: int) -> IntArray:
    """The two elements of each edge, left of (smaller -> larger node) first.

    A boundary edge has its only element first and -1 second.
    """
    rightward = (elements[:, TAILS] > elements[:, HEADS]).astype(np.int64)
    place = 2 * element_edges.astype(np.int64) + rightward
    table = np.full(2 * n_edges, -1, dtype=np.int32)
    table[place] = np.arange(len(elements), dtype=np.int32)[:, None]
    if np.count_nonzero(table >= 0) < place.size:
        _refuse_shared_half_edges(elements, place)
    pairs = table.reshape(-1, 2)
    only_second = pairs[:, 0] < 0
    pairs[only_second] = pairs[only_second, ::-1]
    return pairs


def neighbours(element_edges: IntArray, edge_elements: IntArray) -> IntArray:
    """The element across the edge opposite node k of element t, or -1."""
    pairs = edge_elements[element_edges]
    own = np.arange(len(element_edges), dtype=np.int32)[:, None]
    return np.where(pairs[..., 0] == own, pairs[..., 1], pairs[..., 0])


def half_edges(element_edges: IntArray, n_edges: int, kernels: Plain) -> tuple[IntArray, IntArray, IntArray]:
    """Twin and edge of each half-edge, and one half-edge of each edge.

    The twin of a half-edge is the half-edge of the neighbour on this side, or -1.  All three
    arrays are flat and writable, as ``kernels``, compiled or plain, need them.
    """
    slot, nowhere = kernels.flat(element_edges), kernels.half_edges.NOWHERE
    twin, half = (
        kernels.writable(np.full(n, nowhere, dtype=np.int32)) for n in (element_edges.size, n_edges)
    )
    kernels.half_edges.twins(slot, twin, half)
    return twin, slot, half


def from_smallest(elements: IntArray) -> IntArray:
    """Elements turned so that the smallest node number comes first."""
    first = elements.argmin(axis=1)[:, None]
    return np.take_along_axis(elements, (first + np.arange(3)) % 3, axis=1)


def grouped(numbers: IntArray, n: int) -> tuple[IntArray, IntArray]:
    """Rows that hold 0, then rows that hold 1, up to n - 1, and the place where those of each start."""
    if len(numbers) < MANY:
        starts = np.concatenate([[0], np.cumsum(np.bincount(numbers, minlength=n))])
        return np.argsort(numbers, kind="stable").astype(np.int32), starts.astype(np.int32)
    from scipy.sparse import csr_array  # transposes by counting

    row = np.arange(len(numbers), dtype=np.int32), numbers, [0, len(numbers)]
    column = csr_array(row, shape=(1, n)).tocsc()
    return column.data, column.indptr


def around_nodes(edges: IntArray, n_nodes: int) -> tuple[IntArray, IntArray, IntArray]:
    """Nodes joined to node 0, then to node 1 and so on, their edges, and where those of each start.

    An edge e is row e for its first node and row E + e for its second.
    """
    rows, starts = grouped(edges.T.ravel(), n_nodes)
    return edges.T[::-1].ravel().take(rows), rows, starts


def unique(numbers: IntArray) -> IntArray:
    """The different numbers in ascending order, by sorting, which is faster than `numpy.unique`."""
    ascending = np.sort(numbers, axis=None)
    new = np.ones(len(ascending), dtype=bool)
    np.not_equal(ascending[1:], ascending[:-1], out=new[1:])
    return ascending[new]


def edge_numbers(edges: IntArray, n_nodes: int, pairs: IntArray) -> IntArray:
    """Row in ``edges`` of each pair of nodes (smaller first), or a MeshError."""
    ascending, keys = (rows.astype(np.int64) @ [n_nodes, 1] for rows in (edges, pairs))
    place = np.searchsorted(ascending, keys).clip(max=len(edges) - 1)
    missing = np.flatnonzero((edges[place] != pairs).any(axis=1))
    if missing.size:
        i, j = pairs[missing[0]]
        raise InvalidMeshError(
            "edge", f"nodes {i} and {j} are not joined by an edge", pairs[missing].ravel(), missing.size
        )
    return place


def canonical(elements: IntArray) -> IntArray:
    """Elements with their smallest node first, in lexicographic order."""
    turned = from_smallest(elements)
    return turned[_lexicographic(turned)]


def _lexicographic(elements: IntArray) -> IntArray:
    """Numbers of the elements in the lexicographic order of their nodes."""
    if len(elements) >= MANY:  # where one sort of the first two nodes is faster than three
        keys = (elements[:, 0].astype(np.int64) << 32) + elements[:, 1]
        order = np.argsort(keys)
        if np.diff(keys[order]).all():  # as in every valid mesh
            return order
    return np.lexsort(elements.T[::-1])


def quadrilaterals(mesh: AnyMesh, edges: IntArray) -> tuple[IntArray, IntArray]:
    """Nodes (a, b, c, d) around each interior edge b-c, and its elements (a, b, c), (d, c, b)."""
    pairs = mesh.edge_elements[edges]
    t, s = pairs.T
    k = (mesh.element_edges[t] == edges[:, None]).argmax(axis=1)
    m = (mesh.element_edges[s] == edges[:, None]).argmax(axis=1)
    a, d = mesh.elements[t, k], mesh.elements[s, m]
    b, c = mesh.elements[t, np.take(TAILS, k)], mesh.elements[t, np.take(HEADS, k)]
    return np.column_stack([a, b, c, d]), pairs


def _refuse_shared_half_edges(elements: IntArray, place: IntArray) -> None:
    """Raise a MeshError that names two elements with the same half-edge."""
    order = np.argsort(place, axis=None, kind="stable")
    again = np.flatnonzero(np.diff(place.ravel()[order]) == 0)
    if again.size:
        first, second = order[again[0]] // 3, order[again[0] + 1] // 3
        k = order[again[0]] % 3
        a, b = sorted(int(n) for n in (elements[first, TAILS[k]], elements[first, HEADS[k]]))
        raise InvalidMeshError(
            "overlap",
            f"elements {first} and {second} lie on the same side of edge "
            f"({a}, {b}); remove one or reverse its nodes",
            (first, second),
        )
