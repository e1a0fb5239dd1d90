"""All empty triangles of a set of nodes on the domain of a mesh, and the equations that join them.

Shapes: N nodes, K empty triangles, M edges of these triangles, P pairs of triangles that can
share an inner edge.
"""

from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from .._typing import BoolArray, FloatArray, IntArray
from ..geometry.predicates import FLAT
from ..mesh.mesh import Mesh


class Candidates:
    """The triangles that a mesh with these nodes and this domain can have as elements.

    Parameters
    ----------
    mesh : Mesh
        Any mesh with these nodes and this domain.
    """

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh

    def __len__(self) -> int:
        return len(self.triangles)

    @cached_property
    def turns(self) -> IntArray:
        """(N, N, N) int8: the sign of the turn a -> b -> c, positive to the left, 0 if flat to rounding."""
        x, y = self.mesh.nodes.T
        dx, dy = x - x[:, None], y - y[:, None]  # [a, b]: from a to b
        left, right = dx[:, :, None] * dy[:, None, :], dx[:, None, :] * dy[:, :, None]
        flat = np.abs(left - right) <= FLAT * (np.abs(left) + np.abs(right))
        return np.where(flat, 0, np.sign(left - right)).astype(np.int8)

    @cached_property
    def triangles(self) -> IntArray:
        """(K, 3) int64: counter-clockwise, smallest node first, with no node and no boundary inside."""
        turns, n = self.turns, self.mesh.n_nodes
        t = np.array(list(combinations(range(n), 3)))
        sign = turns[tuple(t.T)]
        t[sign < 0] = t[sign < 0][:, [0, 2, 1]]
        a, b, c = t[sign != 0].T
        others = (turns[a, b] >= 0).astype(np.int8) + (turns[b, c] >= 0) + (turns[c, a] >= 0) == 3
        allowed = self._allowed_sides
        kept = (others.sum(axis=1) == 3) & allowed[a, b] & allowed[b, c] & allowed[c, a]
        return np.column_stack([a, b, c])[kept]

    @cached_property
    def _boundary(self) -> tuple[IntArray, IntArray]:
        """Nodes (p, q) of the boundary edges, with the domain to their left."""
        mesh = self.mesh
        edges = np.flatnonzero(mesh.boundary)
        element = mesh.edge_elements[edges, 0]
        k = (mesh.element_edges[element] == edges[:, None]).argmax(axis=1)
        return mesh.elements[element, (k + 1) % 3], mesh.elements[element, (k + 2) % 3]

    @cached_property
    def _allowed_sides(self) -> BoolArray:
        """(N, N) bool: whether an element can have the side a -> b, with the element to its left."""
        p, q = self._boundary
        turns = self.turns
        along = turns[p, q]  # [boundary edge, node]
        across = turns[:, :, p] * turns[:, :, q] < 0  # [a, b, boundary edge]
        crossing = across & (along.T[:, None] * along.T[None] < 0)
        allowed: BoolArray = np.logical_not(crossing.any(axis=2))
        allowed[q, p] = False  # the element would be outside
        return allowed

    @cached_property
    def _sides(self) -> tuple[IntArray, IntArray, IntArray]:
        """Start, end and triangle of every side of every triangle, (3 K,) each."""
        t = self.triangles
        number = np.tile(np.arange(len(t)), 3)
        return t.T.ravel(), np.roll(t, -1, axis=1).T.ravel(), number

    @cached_property
    def edges(self) -> IntArray:
        """(M, 2) int64: all edges of triangles, smaller node first, in lexicographic order."""
        start, end, _ = self._sides
        return np.unique(np.sort(np.column_stack([start, end]), axis=1), axis=0)

    @cached_property
    def _at_edges(self) -> tuple[IntArray, IntArray, IntArray]:
        """Edge, triangle and sign of each triangle at an edge, (3 K,) each; +1 left of the edge, -1 right."""
        start, end, triangle = self._sides
        n = self.mesh.n_nodes
        edge = np.searchsorted(self.edges @ [n, 1], np.minimum(start, end) * n + np.maximum(start, end))
        return edge, triangle, np.where(start < end, 1, -1)

    @cached_property
    def _inner(self) -> BoolArray:
        """(M,) bool: whether an edge is inside the domain, not on its boundary."""
        p, q = self._boundary
        keys = np.minimum(p, q) * self.mesh.n_nodes + np.maximum(p, q)
        return ~np.isin(self.edges @ [self.mesh.n_nodes, 1], keys)

    @cached_property
    def pairs(self) -> tuple[IntArray, ...]:
        """Edge, left and right triangle of each pair that can share an inner edge, (P,) each."""
        edge, triangle, side = self._at_edges
        found = []
        for e in np.flatnonzero(self._inner):
            left, right = (triangle[(edge == e) & (side == s)] for s in (1, -1))
            number = np.full(len(left) * len(right), e)
            found.append((number, np.repeat(left, len(right)), np.tile(right, len(left))))
        return tuple(np.concatenate(column) for column in zip(*found, strict=True))

    def apex(self, edge: IntArray, triangle: IntArray) -> IntArray:
        """The node of each triangle that is opposite to its edge; all arrays are (n,)."""
        return self.triangles[triangle].sum(axis=1) - self.edges[edge].sum(axis=1)

    def balance(self, n_pairs: int) -> tuple[Any, FloatArray]:
        """Sparse matrix and right-hand side of the equations for triangles, then for the pairs if any."""
        from scipy.sparse import csr_array, hstack, vstack

        edge, triangle, side = self._at_edges
        inner = self._inner
        shape = (len(self.edges), len(self))
        elements = csr_array((np.where(inner[edge], side, 1).astype(float), (edge, triangle)), shape=shape)
        right = np.where(inner, 0.0, 1.0)
        if not n_pairs:
            return _with_short_indices(elements), right
        rows, at = self._pair_rows()
        width = (shape[0], n_pairs)
        matrix = vstack([hstack([elements, csr_array(width)]), hstack([-at, rows])]).tocsr()
        return _with_short_indices(matrix), np.concatenate([right, np.zeros(rows.shape[0])])

    def _pair_rows(self) -> tuple[Any, Any]:
        """Sparse matrices with a row for each triangle at an inner edge: its pairs there; the triangle."""
        from scipy.sparse import csr_array

        edge, left, right = self.pairs
        keys = np.concatenate([edge * len(self) + left, edge * len(self) + right])
        inner_edge, triangle, _ = (v[self._inner[self._at_edges[0]]] for v in self._at_edges)
        known = np.sort(inner_edge * len(self) + triangle)
        row, column = np.searchsorted(known, keys), np.tile(np.arange(len(edge)), 2)
        pairs = csr_array((np.ones(len(keys)), (row, column)), shape=(len(known), len(edge)))
        place = np.arange(len(known)), known % len(self)
        return pairs, csr_array((np.ones(len(known)), place), shape=(len(known), len(self)))


def _with_short_indices(matrix: Any) -> Any:
    """The sparse matrix with indices of 32 bits, which integer programs need in SciPy before 1.15."""
    matrix.indices, matrix.indptr = (v.astype(np.intc) for v in (matrix.indices, matrix.indptr))
    return matrix
