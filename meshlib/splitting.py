"""Splits of marked elements into smaller ones (sections 3.2.4 to 3.2.6)."""
import numpy as np

LONGEST = 1e-12  # squared lengths this close, relatively, count as equal
RED_PARTS = 4


class Midpoints:
    """Nodes, old and new, and which of them bisects which edge."""

    def __init__(self, n_nodes, edges=(), middles=()):
        self.n_nodes = n_nodes
        self.ends = np.empty((0, 2), dtype=np.int64)  # of the edges whose middle is new
        self._keys = np.empty(0, dtype=np.int64)
        self._numbers = np.empty(0, dtype=np.int64)
        if len(edges):
            self._file(np.sort(edges, axis=1), np.asarray(middles))

    def find(self, a, b):
        """Number of the node that bisects the edge a-b, or -1."""
        if not len(self._keys):
            return np.full(np.shape(a), -1)
        key = self._key(np.minimum(a, b), np.maximum(a, b))
        place = np.searchsorted(self._keys, key).clip(max=len(self._keys) - 1)
        return np.where(self._keys[place] == key, self._numbers[place], -1)

    def bisect(self, a, b):
        """Number of the node that bisects the edge a-b, a new one where there is none."""
        pairs = np.column_stack([np.minimum(a, b), np.maximum(a, b)]).astype(np.int64)
        missing = np.unique(pairs[self.find(a, b) < 0], axis=0)
        self._file(missing, self.n_nodes + len(self.ends) + np.arange(len(missing)))
        self.ends = np.vstack([self.ends, missing])
        return self.find(a, b)

    @staticmethod
    def _key(low, high):
        return low.astype(np.int64) << 32 | high.astype(np.int64)

    def _file(self, pairs, numbers):
        keys = np.concatenate([self._keys, self._key(pairs[:, 0], pairs[:, 1])])
        order = np.argsort(keys, kind="stable")
        self._keys, self._numbers = keys[order], np.concatenate([self._numbers, numbers])[order]


def centroid(mesh, marked):
    r"""Midpoint node insertion (section 3.2.5).

    ::

            c
           /|\
          / g \          (a, b, c) -> (a, b, g), (b, c, g), (c, a, g)
         / / \ \
        a-------b

    Returns the elements, their parents, the corners whose mean each new node is,
    and no green pairs; so do the other splits.
    """
    a, b, c = mesh.elements[marked].astype(np.int64).T
    g = mesh.n_nodes + np.arange(len(marked))
    children = np.stack([a, b, g, b, c, g, c, a, g], axis=1).reshape(-1, 3)
    kept = np.setdiff1d(np.arange(mesh.n_elements), marked)
    parents = np.concatenate([kept, np.repeat(marked, 3)])
    elements = np.vstack([mesh.elements[kept], children])
    return (*_by_parent(elements, parents), mesh.elements[marked], None)


def longest_edge(mesh, marked):
    r"""Bisection of the longest edge (section 3.2.6), with Rivara's closure.

    Where an edge of an element is bisected, so is its longest edge a-b, first::

            c                     c                c
           / \                   /|\              /|\
          /   \       --->      / | \     or     n | \      (n bisects c-a too)
         /     \               /  |  \          / \|  \
        a-------b             a---m---b        a---m---b
    """
    split = _closed_under_longest(mesh, mesh.element_edges[marked, _longest(mesh)[marked]])
    middles = Midpoints(mesh.n_nodes)
    middles.bisect(*mesh.edges[split].T.astype(np.int64))
    a, b, c = _turned(mesh.elements.astype(np.int64), _longest(mesh))
    m, parents = middles.find(a, b), np.arange(mesh.n_elements)
    whole, cut = np.flatnonzero(m < 0), np.flatnonzero(m >= 0)
    halves = np.vstack([np.column_stack([c, a, m])[cut], np.column_stack([b, c, m])[cut]])
    pieces, origin = _cut_again(halves, np.tile(parents[cut], 2), middles)
    elements = np.vstack([mesh.elements[whole], pieces])
    return (*_by_parent(elements, np.concatenate([whole, origin])), middles.ends, None)


def red_green(mesh, marked):
    r"""Bisection of all edges, hanging nodes closed (section 3.2.4, Figures 3.5 to 3.7).

    ::

              c                     c
             / \                   /|\
           ca---bc    red         / | \     green: one hanging node m
           / \ / \               /  |  \    (m, c, a), (m, b, c)
          a---ab--b             a---m---b

    Green pairs are put together again first, and refined red or not at all; an
    element with two or three hanging nodes is refined red.
    """
    leaves, parents, middles, red = _without_green(mesh, marked)
    while red.any():
        children = _red(leaves[red], middles)
        leaves = np.vstack([leaves[~red], children])
        parents = np.concatenate([parents[~red], np.repeat(parents[red], RED_PARTS)])
        red = _needs_red(leaves, middles)
    elements, parents, green = _closed_green(leaves, parents, middles)
    return elements, parents, middles.ends, green


SPLITS = {"red-green": red_green, "centroid": centroid, "longest-edge": longest_edge}


def _by_parent(elements, parents):
    order = np.argsort(parents, kind="stable")
    return elements[order], parents[order]


def _turned(elements, k):
    """Nodes a, b, c of each element, counter-clockwise, c its node k."""
    return tuple(np.take_along_axis(elements, (k[:, None] + shift) % 3, axis=1)[:, 0] for shift in (1, 2, 0))


# -- longest edge ---------------------------------------------------------------------


def _longest(mesh):
    """Which node is opposite the longest edge; among equal ones the smallest edge number."""
    along = mesh.nodes[mesh.edges[:, 1]] - mesh.nodes[mesh.edges[:, 0]]
    squared = (along ** 2).sum(axis=1)[mesh.element_edges]
    long = squared >= squared.max(axis=1, keepdims=True) * (1 - LONGEST)
    return np.where(long, mesh.element_edges, mesh.n_edges).argmin(axis=1)


def _closed_under_longest(mesh, edges):
    """Mask of edges to bisect: with any edge of an element also its longest."""
    longest = mesh.element_edges[np.arange(mesh.n_elements), _longest(mesh)]
    split = np.zeros(mesh.n_edges, dtype=bool)
    split[edges] = True
    while True:
        missing = longest[split[mesh.element_edges].any(axis=1) & ~split[longest]]
        if not missing.size:
            return split
        split[missing] = True


def _cut_again(halves, parents, middles):
    """Elements (p, q, m) cut from m to the middle of p-q where that is bisected."""
    p, q, m = halves.T
    n = middles.find(p, q)
    cut = n >= 0
    pieces = [halves[~cut], np.column_stack([n, q, m])[cut], np.column_stack([p, n, m])[cut]]
    return np.vstack(pieces), np.concatenate([parents[~cut], parents[cut], parents[cut]])


# -- red and green ----------------------------------------------------------------------


def _without_green(mesh, marked):
    """Elements with green pairs put together, their parents, middles, and the marked ones."""
    first, second = mesh.green.astype(np.int64).T
    elements, red = mesh.elements.astype(np.int64), np.zeros(mesh.n_elements, dtype=bool)
    red[marked] = True
    red[first] |= red[second]
    middles = Midpoints(mesh.n_nodes, np.column_stack([elements[first, 2], elements[second, 1]]),
                        elements[first, 0])
    whole = np.column_stack([elements[first, 1], elements[first, 2], elements[second, 1]])
    elements[first] = whole
    kept = np.setdiff1d(np.arange(mesh.n_elements), second)
    return elements[kept], kept, middles, red[kept]


def _sides(leaves, middles):
    """Ends of the edge opposite each node, and the node that bisects it or -1; (n, 3) each."""
    a, b = np.roll(leaves, -1, axis=1), np.roll(leaves, -2, axis=1)
    return a, b, middles.find(a, b)


def _needs_red(leaves, middles):
    """Elements with two hanging nodes, or two on one edge."""
    a, b, m = _sides(leaves, middles)
    deep = (m >= 0) & ((middles.find(a, m) >= 0) | (middles.find(m, b) >= 0))
    return ((m >= 0).sum(axis=1) > 1) | deep.any(axis=1)


def _red(leaves, middles):
    """Four children for each element."""
    a, b, c = leaves.T
    ends = np.concatenate([a, b, c]), np.concatenate([b, c, a])
    ab, bc, ca = middles.bisect(*ends).reshape(3, -1)
    return np.stack([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca], axis=1).reshape(-1, 3)


def _closed_green(leaves, parents, middles):
    """Elements with one hanging node bisected; elements, parents and green pairs."""
    _, _, m = _sides(leaves, middles)
    open_ = (m >= 0).any(axis=1)
    k = (m >= 0).argmax(axis=1)[open_]
    a, b, c = _turned(leaves[open_], k)
    m = m[open_, k]
    pairs = np.stack([m, c, a, m, b, c], axis=1).reshape(-1, 3)
    rows = np.vstack([leaves[~open_], pairs])
    origin = np.concatenate([parents[~open_], np.repeat(parents[open_], 2)])
    order = np.argsort(origin, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return rows[order], origin[order], place[(~open_).sum():].reshape(-1, 2)
