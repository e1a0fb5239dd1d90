"""The clauses of Definitions 2.0.1 and 2.0.2, one small function each.

A clause takes a mesh and returns None if it holds, else the message about the first
breach, the numbers of all offending items, and the number of breaches.  All decisions are
exact.
"""

from collections.abc import Callable, Iterable
from typing import TypeAlias

import numpy as np

from .._typing import AnyMesh, BoolArray, FloatArray, IntArray
from ..checks import distinct_nodes, unnamed
from ..errors import InvalidMeshError
from ..geometry.predicates import orientation
from .box_tree import BoxTree, bounds, least
from .overlaps import common_area, first_overlap

Breach: TypeAlias = tuple[
    str, Iterable[int], int
]  # message, numbers of all offending items, number of breaches
Clause: TypeAlias = Callable[[AnyMesh], Breach | None]


def require(clause: Clause, mesh: AnyMesh) -> None:
    """Raise a MeshError named after the clause if it does not hold."""
    found = clause(mesh)
    if found:
        raise InvalidMeshError(clause.__name__.replace("_", " "), *found)


def index_range(mesh: AnyMesh) -> Breach | None:
    """Every node number is between 0 and N - 1."""
    bad = np.argwhere((mesh.elements < 0) | (mesh.elements >= len(mesh.nodes)))
    if bad.size:
        t, k = bad[0]
        from_one = mesh.elements.min() == 1 and mesh.elements.max() == len(mesh.nodes)
        hint = "; they seem to be numbered from 1: subtract 1" if from_one else ""
        known = f"nodes are numbered 0 to {len(mesh.nodes) - 1}"
        message = f"element {t} names node {mesh.elements[t, k]}; {known}{hint}"
        return message, np.unique(bad[:, 0]), len(bad)
    return None


def duplicate(mesh: AnyMesh) -> Breach | None:
    """Nodes are distinct, and so are elements."""
    distinct_nodes(mesh.nodes)
    if _surely_distinct(mesh):
        return None
    rows = np.sort(mesh.elements, axis=1)
    order = np.lexsort((np.arange(len(rows)), *rows.T[::-1]))
    same = np.flatnonzero((np.diff(rows[order], axis=0) == 0).all(axis=1))
    if same.size:
        pairs = np.column_stack([order[same], order[same + 1]])
        i, j = pairs[0]
        message = f"elements {i} and {j} have the same nodes {_tuple(rows[i])}; remove one"
        return message, pairs.ravel(), len(pairs)
    return None


def degenerate(mesh: AnyMesh) -> Breach | None:
    """Every element has three nodes that are not collinear."""
    flat = np.flatnonzero(_turns(mesh) == 0)
    if flat.size:
        t = flat[0]
        return (
            f"element {t} with nodes {_tuple(mesh.elements[t])} has no area; remove it or move a node",
            flat,
            flat.size,
        )
    return None


def orientation_(mesh: AnyMesh) -> Breach | None:
    """Every element is numbered counter-clockwise."""
    clockwise = np.flatnonzero(_turns(mesh) < 0)
    if clockwise.size:
        t = clockwise[0]
        message = f"element {t} with nodes {_tuple(mesh.elements[t])} is clockwise; reverse its nodes"
        return message, clockwise, clockwise.size
    return None


orientation_.__name__ = "orientation"


def unused_node(mesh: AnyMesh) -> Breach | None:
    """Every node belongs to an element."""
    unused = unnamed(mesh.elements, mesh.n_nodes)
    if unused.size:
        return f"node {unused[0]} belongs to no element; remove it or mesh it", unused, unused.size
    return None


def overlap(mesh: AnyMesh) -> Breach | None:
    """No two elements have area in common."""
    _ = mesh.edge_elements  # two elements on the same side of an edge are found here
    pair = first_overlap(mesh)
    if pair:
        i, j = sorted(pair)
        area = common_area(mesh.corners[i], mesh.corners[j])
        return (
            f"elements {i} and {j} overlap by an area of {area:.6g}; remove one or untangle their nodes",
            (i, j),
            1,
        )
    return None


def hanging_node(mesh: AnyMesh) -> Breach | None:
    """No node lies inside an edge of an element (Figure 2.1)."""
    edges = mesh.edges[mesh.boundary]
    nodes = np.flatnonzero(mesh.boundary_nodes)
    nodes = nodes[np.argsort(mesh.nodes[nodes, 0], kind="stable")]
    tree = BoxTree(mesh.nodes[nodes], mesh.nodes[nodes])
    for e, n in tree.touching(*bounds(*mesh.nodes[edges.T])):
        inside = _strictly_between(mesh.nodes, edges[e], nodes[n])
        if inside.any():
            row, item = least(e[inside], n[inside])
            node, t = int(nodes[item]), int(mesh.edge_elements[mesh.boundary][row, 0])
            edge = _tuple(edges[row])
            return f"node {node} hangs on edge {edge} of element {t}; split the element there", (node, t), 1
    return None


def green_pair(mesh: AnyMesh) -> Breach | None:
    """Every green pair halves a larger element, and no two pairs share an element."""
    n = mesh.n_elements
    unknown = mesh.green[(mesh.green < 0) | (mesh.green >= n)]
    if unknown.size:
        message = f"a pair names element {unknown[0]}; elements are numbered 0 to {n - 1}"
        return message, unknown, unknown.size
    numbers, uses = np.unique(mesh.green, return_counts=True)
    again = numbers[uses > 1]
    if again.size:
        return f"element {again[0]} is in two places; leave one of its pairs out", again, again.size
    whole = mesh.green[~halved(mesh.nodes, mesh.elements, mesh.green)]
    if whole.size:
        i, j = whole[0]
        message = f"elements {i} and {j} do not halve a larger one; leave the pair out"
        return message, whole.ravel(), len(whole)
    return None


CLAUSES: tuple[Clause, ...] = (  # in the order in which they are checked
    index_range,
    duplicate,
    degenerate,
    orientation_,
    unused_node,
    overlap,
    hanging_node,
    green_pair,
)


def halved(nodes: FloatArray, elements: IntArray, pairs: IntArray, tolerance: float = 1e-9) -> BoolArray:
    """Whether each pair of elements is (m, c, a), (m, b, c) with m in the middle of a-b.

    ``tolerance`` is twice the distance of m from the middle that is allowed, as a fraction of
    the length of a-b, both in the maximum norm.
    """
    (m, c, a), (n, b, d) = (elements[side].T for side in pairs.T)
    off = np.abs(2 * nodes[m] - nodes[a] - nodes[b]).max(axis=1)
    return (m == n) & (c == d) & (off <= tolerance * np.abs(nodes[a] - nodes[b]).max(axis=1))


def _surely_distinct(mesh: AnyMesh) -> bool:
    """Whether no two elements have the same key, a number made of their nodes that is quickly sorted."""
    a, b, c = mesh.elements.astype(np.uint64).T
    (low, high), n = bounds(a, b, c), np.uint64(mesh.n_nodes)
    keys = np.sort((low * n + high) * n + (a + b + c))  # modulo 2^64
    return bool((keys[1:] != keys[:-1]).all())


def _tuple(numbers: Iterable[int]) -> tuple[int, ...]:
    return tuple(int(n) for n in numbers)


def _turns(mesh: AnyMesh) -> IntArray:
    """+1 for each counter-clockwise element, -1 for each clockwise one, 0 for each flat one."""
    return orientation(*np.moveaxis(mesh.corners, 1, 0))


def _strictly_between(nodes: FloatArray, edges: IntArray, n: IntArray) -> BoolArray:
    """Whether each node n lies on its edge and is not one of the ends."""
    a, b, p = nodes[edges[:, 0]], nodes[edges[:, 1]], nodes[n]
    inside_box = ((np.minimum(a, b) <= p) & (p <= np.maximum(a, b))).all(axis=1)
    candidate = np.flatnonzero(inside_box & (edges != n[:, None]).all(axis=1))
    on = np.zeros(len(n), dtype=bool)
    on[candidate] = orientation(a[candidate], b[candidate], p[candidate]) == 0
    return on
