"""Elements that have area in common, found in nearly linear time.

It is enough to look next to the boundary: if any elements overlap, then some element with an
edge on the boundary overlaps another one next to that edge.

Proof.  Take a point that lies inside at least two elements, and a path from there to a point
outside the domain; the path avoids all nodes and all crossings of edges.  Follow it as long
as it is inside at least two elements.  It leaves the last such stretch through an edge::

        inside t, s, ...     |     inside one element or none
     ------------->----------o---------->---------- path
                             |
                             edge of t

If this edge were interior, a neighbour of t would begin where t ends, since both are
counter-clockwise, and the number of elements around the path would not change.  Several edges
may lie on top of each other here; at least one of them has no neighbour, so it is on the
boundary.  Let t be its element, and s another element inside which the path was before.
Then s and t overlap next to the edge.  The path crosses the edge inside s or on a side of s,
so the bounding box of s touches that of the edge.

The proof holds for every set of elements no two of which lie on the same side of an edge.
The boundary of a set consists of the edges without a neighbour in the set.
"""

from collections.abc import Iterator

import numpy as np

from .._typing import AnyMesh, ArrayLike, BoolArray, FloatArray, IntArray
from ..geometry.predicates import orientation
from .box_tree import BoxTree, bounds, least
from .topology import HEADS, TAILS


def first_overlap(mesh: AnyMesh) -> tuple[int, int] | None:
    """Numbers of two elements that overlap, the first in a sweep from left to right, or None."""
    edges = np.flatnonzero(mesh.boundary)
    owners = mesh.edge_elements[edges, 0]
    sides = (mesh.element_edges[owners] == edges[:, None]).argmax(axis=1)
    if _Elements(mesh.corners).overlap(np.arange(mesh.n_elements), owners, sides):
        return _Sweep(mesh).first()
    return None


class _Elements:
    """Counter-clockwise elements by their corners."""

    def __init__(self, corners: FloatArray) -> None:
        self.corners = corners
        self.low, self.high = bounds(*np.moveaxis(corners, 1, 0))
        self.size = _size(self.low, self.high)

    def overlap(self, some: IntArray, owners: IntArray, sides: IntArray) -> bool:
        """Whether an element of ``some`` overlaps one of the ``owners`` next to its side on the boundary.

        ``sides`` are the numbers, 0 to 2, of these sides.
        """
        ends = (self.corners[owners, np.take(end, sides)] for end in (TAILS, HEADS))
        near = self.near(some, BoxTree(*bounds(*ends)))
        return any(self.overlapping(s, owners[e])[0].size for s, e in near)

    def near(self, some: IntArray, tree: BoxTree) -> Iterator[tuple[IntArray, IntArray]]:
        """Pairs of an element and a box of the tree that may have a point in common, in batches."""

        def misses(rows: IntArray, low: FloatArray, high: FloatArray) -> BoolArray:
            return self._misses(some[rows], low, high)

        for rows, boxes in tree.touching(self.low[some], self.high[some], misses):
            yield some[rows], boxes

    def _misses(self, t: IntArray, low: FloatArray, high: FloatArray) -> BoolArray:
        r"""Whether a box lies to the right of a side of its element t; only for boxes smaller than t.

        ::

            o
            | \   x---+
            |   \ |   |     x: the corner of the box that is furthest to the left as seen along the side
            o-----o---+
        """
        small = np.flatnonzero(_size(low, high) < self.size[t])
        tail, head = (self.corners[t[small]][:, ends] for ends in (TAILS, HEADS))
        right, up = np.moveaxis(head > tail, 2, 0)
        (left, bottom), (far, top) = (corner[small].T[:, :, None] for corner in (low, high))
        furthest = np.stack([np.where(up, left, far), np.where(right, top, bottom)], axis=2)
        found = np.zeros(len(t), dtype=bool)
        found[small] = (orientation(tail, head, furthest) < 0).any(axis=1)
        return found

    def overlapping(self, i: IntArray, j: IntArray) -> tuple[IntArray, IntArray]:
        """The pairs of two elements that overlap: neither lies to the right of a side of the other."""
        for _ in range(2):
            tail, head = self.corners[i][:, TAILS], self.corners[i][:, HEADS]
            turns = orientation(tail[:, :, None], head[:, :, None], self.corners[j][:, None, :])
            common = (i != j) & np.all((turns > 0).any(axis=2), axis=1)
            i, j = j[common], i[common]  # exchanged, so that the second pass looks along the sides of j
        return i, j


class _Sweep(_Elements):
    """The elements of a mesh in the order of their left ends; some overlap."""

    def __init__(self, mesh: AnyMesh) -> None:
        left = mesh.corners[..., 0].min(axis=1)
        self.order = np.argsort(left, kind="stable")
        super().__init__(mesh.corners[self.order])
        place = np.empty(mesh.n_elements + 1, dtype=np.int64)  # place[-1] stands for no neighbour
        place[self.order], place[-1] = np.arange(mesh.n_elements), mesh.n_elements
        self.neighbours = place[mesh.neighbours[self.order]]

    def first(self) -> tuple[int, int]:
        """The first element that overlaps a later one, and the first of those that it overlaps."""
        last = self._first_to_overlap_an_earlier()
        reaching = np.flatnonzero(self.high[:last, 0] > self.low[last, 0])
        later = BoxTree(self.low[last:], self.high[last:])
        pairs = (self.overlapping(i, last + j) for i, j in self.near(reaching, later))
        first, second = next(least(i, j) for i, j in pairs if i.size)
        return int(self.order[first]), int(self.order[second])

    def _first_to_overlap_an_earlier(self) -> int:
        """Place of the first element that overlaps an earlier one, by bisection.

        No two of the first ``free`` elements overlap; of the first ``found``, some do.
        """
        free, found = 0, len(self.order)
        while found - free > 1:
            middle = (free + found) // 2
            if self._overlap_before(middle, self.low[free, 0]):
                found = middle
            else:
                free = middle
        return free

    def _overlap_before(self, end: int, x: float) -> bool:
        """Whether some of the first ``end`` elements overlap, if none do to the left of x."""
        some = np.flatnonzero(self.high[:end, 0] >= x)
        owners, sides = np.nonzero(self.neighbours[some] >= end)
        return self.overlap(some, some[owners], sides)


def _size(low: FloatArray, high: FloatArray) -> FloatArray:
    """Half the longer side of each box, since the whole side may overflow."""
    width, height = (high / 2 - low / 2).T
    return np.maximum(width, height)


def common_area(first: ArrayLike, second: ArrayLike) -> float:
    """Area that two counter-clockwise triangles have in common.

    The second is cut by the three half-planes of the first, one after the other.
    """
    polygon = list(np.asarray(second, dtype=float))
    for a, b in zip(np.asarray(first), np.roll(first, -1, axis=0), strict=True):
        polygon = _cut(polygon, a, b)
    if len(polygon) < 3:
        return 0.0
    x, y = np.transpose(polygon)
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def _cut(polygon: list[FloatArray], a: FloatArray, b: FloatArray) -> list[FloatArray]:
    """The part of a polygon to the left of the line a -> b."""

    def height(p: FloatArray) -> float:
        return float((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]))

    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        hp, hq = height(p), height(q)
        if hp >= 0:
            kept.append(p)
        if hp * hq < 0:
            kept.append(p + (q - p) * hp / (hp - hq))
    return kept
