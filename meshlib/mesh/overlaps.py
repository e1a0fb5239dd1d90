"""Elements that have area in common, found in nearly linear time.

If some elements have area in common, then one that has an edge on the boundary has, next
to that edge.  For take a path from a point inside two elements or more to a point
outside the domain, which passes no node and no crossing of edges, and on it the last
place before which there are two elements or more, and behind which one or none::

        in t, s, ...     |     in one of s, ... or in none
     ---------->---------o--------->---------- path
                         |
                         edge of t on the boundary

At an interior edge one element ends where another begins, since both are
counter-clockwise.  So one of the edges at this place is on the boundary, and its element
t ends here.  Another element s before the place has area in common with t, and has the
place inside it or on a side, so that its box touches that of the edge.  This holds for
every set of elements no two of which lie on the same side of an edge; its boundary is the
sides without a neighbour in the set.
"""

import numpy as np

from ..geometry.predicates import orientation
from .box_tree import BoxTree, bounds, least
from .topology import HEADS, TAILS


def first_overlap(mesh):
    """Two elements that overlap, the first in a sweep from left to right, or None."""
    edges = np.flatnonzero(mesh.boundary)
    owners = mesh.edge_elements[edges, 0]
    sides = (mesh.element_edges[owners] == edges[:, None]).argmax(axis=1)
    if _Elements(mesh.corners).overlap(np.arange(mesh.n_elements), owners, sides):
        return _Sweep(mesh).first()


class _Elements:
    """Counter-clockwise elements by their corners."""

    def __init__(self, corners):
        self.corners = corners
        self.low, self.high = bounds(*np.moveaxis(corners, 1, 0))
        self.size = _size(self.low, self.high)

    def overlap(self, some, owners, sides):
        """Whether some elements overlap the owners of sides on the boundary, next to these sides."""
        ends = (self.corners[owners, np.take(end, sides)] for end in (TAILS, HEADS))
        near = self.near(some, BoxTree(*bounds(*ends)))
        return any(self.overlapping(s, owners[e])[0].size for s, e in near)

    def near(self, some, tree):
        """Pairs of an element and a box of the tree that may have a point in common, in batches."""

        def misses(rows, low, high):
            return self._misses(some[rows], low, high)

        for rows, boxes in tree.touching(self.low[some], self.high[some], misses):
            yield some[rows], boxes

    def _misses(self, t, low, high):
        r"""Whether a side of an element has a box to its right; only smaller boxes are looked at.

        ::

            o
            | \   x---+
            |   \ |   |     x: the corner of the box furthest to the left of the side
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

    def overlapping(self, i, j):
        """The pairs of two elements of which no side of one has the other to its right."""
        for _ in range(2):
            tail, head = self.corners[i][:, TAILS], self.corners[i][:, HEADS]
            turns = orientation(tail[:, :, None], head[:, :, None], self.corners[j][:, None, :])
            common = (i != j) & (turns > 0).any(axis=2).all(axis=1)
            i, j = j[common], i[common]  # next time the other way round
        return i, j


class _Sweep(_Elements):
    """The elements of a mesh by their left ends, of which some overlap."""

    def __init__(self, mesh):
        left = mesh.corners[..., 0].min(axis=1)
        self.order = np.argsort(left, kind="stable")
        super().__init__(mesh.corners[self.order])
        place = np.empty(mesh.n_elements + 1, dtype=np.int64)  # the last, -1, for no neighbour
        place[self.order], place[-1] = np.arange(mesh.n_elements), mesh.n_elements
        self.neighbours = place[mesh.neighbours[self.order]]

    def first(self):
        """The first element that overlaps a later one, and the first such one."""
        last = self._first_to_overlap_an_earlier()
        reaching = np.flatnonzero(self.high[:last, 0] > self.low[last, 0])
        later = BoxTree(self.low[last:], self.high[last:])
        for i, j in self.near(reaching, later):
            i, j = self.overlapping(i, last + j)
            if i.size:
                return self.order[list(least(i, j))].tolist()

    def _first_to_overlap_an_earlier(self):
        """By bisection: the elements before ``free`` do not overlap, those before ``found`` do."""
        free, found = 0, len(self.order)
        while found - free > 1:
            middle = (free + found) // 2
            if self._overlap_before(middle, self.low[free, 0]):
                found = middle
            else:
                free = middle
        return free

    def _overlap_before(self, end, x):
        """Whether elements before one in order overlap; if they do, it is to the right of x."""
        some = np.flatnonzero(self.high[:end, 0] >= x)
        owners, sides = np.nonzero(self.neighbours[some] >= end)
        return self.overlap(some, some[owners], sides)


def _size(low, high):
    """Half the longer side of boxes, since whole ones may overflow."""
    return np.maximum(*(high / 2 - low / 2).T)


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
