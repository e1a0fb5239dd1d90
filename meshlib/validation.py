"""The clauses of Definitions 2.0.1 and 2.0.2, one small function each.

A clause takes a mesh and returns nothing if it holds, else the message and the
numbers of the offending items.  All decisions are exact.
"""
import numpy as np

from .errors import MeshError
from .predicates import orientation
from .topology import HEADS, TAILS

PAIRS_AT_ONCE = 1_000_000
MIDDLE = 1e-9  # how far, relatively, the node of a green pair may lie off the middle of an edge


def require(clause, mesh):
    """Raise a MeshError named after the clause if it does not hold."""
    found = clause(mesh)
    if found:
        raise MeshError(clause.__name__.replace("_", " "), *found)


def index_range(mesh):
    """Every node number is between 0 and N - 1."""
    bad = np.argwhere((mesh.elements < 0) | (mesh.elements >= len(mesh.nodes)))
    if bad.size:
        t, k = bad[0]
        return (f"element {t} names node {mesh.elements[t, k]}; "
                f"nodes are numbered 0 to {len(mesh.nodes) - 1}", (t,))


def duplicate(mesh):
    """Nodes are distinct, and so are elements."""
    from .checks import distinct_nodes
    distinct_nodes(mesh.nodes)
    rows = np.sort(mesh.elements, axis=1)
    order = np.lexsort((np.arange(len(rows)), *rows.T[::-1]))
    same = np.flatnonzero((np.diff(rows[order], axis=0) == 0).all(axis=1))
    if same.size:
        i, j = order[same[0]], order[same[0] + 1]
        return f"elements {i} and {j} have the same nodes {_tuple(rows[i])}; remove one", (i, j)


def degenerate(mesh):
    """Every element has three nodes that are not collinear."""
    flat = np.flatnonzero(_turns(mesh) == 0)
    if flat.size:
        t = flat[0]
        return (f"element {t} with nodes {_tuple(mesh.elements[t])} has no area; "
                "remove it or move a node", (t,))


def orientation_(mesh):
    """Every element is numbered counter-clockwise."""
    clockwise = np.flatnonzero(_turns(mesh) < 0)
    if clockwise.size:
        t = clockwise[0]
        return (f"element {t} with nodes {_tuple(mesh.elements[t])} is clockwise; "
                "reverse its nodes", (t,))


orientation_.__name__ = "orientation"


def unused_node(mesh):
    """Every node belongs to an element."""
    unused = np.setdiff1d(np.arange(mesh.n_nodes), mesh.elements)
    if unused.size:
        return f"node {unused[0]} belongs to no element; remove it or mesh it", unused


def overlap(mesh):
    """No two elements have area in common."""
    _ = mesh.edge_elements  # two elements on the same side of an edge are found here
    for i, j in _pairs_of_touching_boxes(mesh):
        found = np.flatnonzero(~_separated(mesh, i, j))
        if found.size:
            i, j = sorted((int(i[found[0]]), int(j[found[0]])))
            area = common_area(mesh.corners[i], mesh.corners[j])
            return (f"elements {i} and {j} overlap by an area of {area:.6g}; "
                    "remove one or untangle their nodes", (i, j))


def hanging_node(mesh):
    """No node lies inside an edge of an element (Figure 2.1)."""
    edges = mesh.edges[mesh.boundary]
    nodes = np.flatnonzero(mesh.boundary_nodes)
    for e, n in _nodes_near(mesh, edges, nodes):
        inside = _strictly_between(mesh.nodes, edges[e], n)
        if inside.any():
            first = inside.argmax()
            t = mesh.edge_elements[mesh.boundary][e[first], 0]
            return (f"node {n[first]} hangs on edge {_tuple(edges[e[first]])} of element {t}; "
                    "split the element there", (n[first], t))


def green_pair(mesh):
    """Every green pair halves a larger element, and no two pairs share an element."""
    n = mesh.n_elements
    for t in mesh.green[(mesh.green < 0) | (mesh.green >= n)]:
        return f"a pair names element {t}; elements are numbered 0 to {n - 1}", (t,)
    numbers, uses = np.unique(mesh.green, return_counts=True)
    for t in numbers[uses > 1]:
        return f"element {t} is in two places; leave one of its pairs out", (t,)
    for i, j in mesh.green[~halved(mesh.nodes, mesh.elements, mesh.green)]:
        return f"elements {i} and {j} do not halve a larger one; leave the pair out", (i, j)


CLAUSES = (index_range, duplicate, degenerate, orientation_, unused_node, overlap, hanging_node, green_pair)


def halved(nodes, elements, pairs):
    """Whether each pair of elements is (m, c, a), (m, b, c) with m in the middle of a-b."""
    (m, c, a), (n, b, d) = (elements[side].T for side in pairs.T)
    off = np.abs(2 * nodes[m] - nodes[a] - nodes[b]).max(axis=1)
    return (m == n) & (c == d) & (off <= MIDDLE * np.abs(nodes[a] - nodes[b]).max(axis=1))


def common_area(first, second):
    """Area that two counter-clockwise triangles have in common.

    The second is cut by the three half-planes of the first, one after the other.
    """
    polygon = list(np.asarray(second, dtype=float))
    for a, b in zip(first, np.roll(first, -1, axis=0), strict=True):
        polygon = _cut(polygon, a, b)
    if len(polygon) < 3:
        return 0.0
    x, y = np.transpose(polygon)
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def _cut(polygon, a, b):
    """The part of a polygon to the left of the line a -> b."""
    def height(p):
        return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        hp, hq = height(p), height(q)
        if hp >= 0:
            kept.append(p)
        if hp * hq < 0:
            kept.append(p + (q - p) * hp / (hp - hq))
    return kept


def _tuple(numbers):
    return tuple(int(n) for n in numbers)


def _turns(mesh):
    return orientation(*np.moveaxis(mesh.corners, 1, 0))


def _separated(mesh, i, j):
    """Whether a side of one of the elements i, j has the other to its right."""
    apart = np.zeros(len(i), dtype=bool)
    for s, t in ((i, j), (j, i)):
        tail, head = mesh.corners[s][:, TAILS], mesh.corners[s][:, HEADS]
        turns = orientation(tail[:, :, None], head[:, :, None], mesh.corners[t][:, None, :])
        apart |= (turns <= 0).all(axis=2).any(axis=1)
    return apart


def _pairs_of_touching_boxes(mesh):
    """Pairs of elements whose bounding boxes overlap, in batches."""
    low, high = mesh.corners.min(axis=1), mesh.corners.max(axis=1)
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0], side="left")
    for first, second in _ranges(np.arange(1, len(order) + 1), ends):
        i, j = order[first], order[second]
        touching = (low[i, 1] < high[j, 1]) & (low[j, 1] < high[i, 1])
        yield i[touching], j[touching]


def _nodes_near(mesh, edges, nodes):
    """Pairs (edge, node) with the node in the edge's range of x, in batches."""
    x = mesh.nodes[edges, 0]
    nodes = nodes[np.argsort(mesh.nodes[nodes, 0], kind="stable")]
    starts = np.searchsorted(mesh.nodes[nodes, 0], x.min(axis=1), side="left")
    ends = np.searchsorted(mesh.nodes[nodes, 0], x.max(axis=1), side="right")
    for e, n in _ranges(starts, ends):
        y = mesh.nodes[edges[e], 1]
        level = mesh.nodes[nodes[n], 1]
        near = (y.min(axis=1) <= level) & (level <= y.max(axis=1))
        yield e[near], nodes[n[near]]


def _ranges(starts, ends):
    """All pairs (row, column) with starts[row] <= column < ends[row], in batches."""
    lengths = (ends - starts).clip(min=0)
    totals = np.concatenate([[0], np.cumsum(lengths)])
    row = 0
    while row < len(lengths):
        last = max(row + 1, np.searchsorted(totals, totals[row] + PAIRS_AT_ONCE, side="right") - 1)
        rows = np.repeat(np.arange(row, last), lengths[row:last])
        columns = np.arange(len(rows)) - (totals[rows] - totals[row]) + starts[rows]
        yield rows, columns
        row = last


def _strictly_between(nodes, edges, n):
    """Whether node n lies on the edge, but is not one of its ends."""
    a, b, p = nodes[edges[:, 0]], nodes[edges[:, 1]], nodes[n]
    inside_box = ((np.minimum(a, b) <= p) & (p <= np.maximum(a, b))).all(axis=1)
    candidate = np.flatnonzero(inside_box & (edges != n[:, None]).all(axis=1))
    on = np.zeros(len(n), dtype=bool)
    on[candidate] = orientation(a[candidate], b[candidate], p[candidate]) == 0
    return on
