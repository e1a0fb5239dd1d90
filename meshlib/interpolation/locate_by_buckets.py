"""Which element a point lies in, by a grid of buckets over the bounding box."""

import numpy as np

from ..geometry.predicates import nearly_flat
from ..kernels.element_shapes import INSIDE
from .locate_by_strips import in_strips

PAIRS_AT_ONCE = 2_000_000
CELLS_OF_AN_ELEMENT = 64  # on average, beyond which the cells are made larger


def located(mesh, points):
    """The element that contains each point.

    Parameters
    ----------
    mesh : Mesh
    points : (m, 2) ndarray of float

    Returns
    -------
    (m,) ndarray of int32
        Element numbers, -1 outside the domain.  On an edge or a node the element
        with the largest smallest barycentric coordinate is taken, then the first.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> mesh = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> located(mesh, np.array([[0.9, 0.1], [0.1, 0.9], [2.0, 0.0]])).tolist()
    [0, 1, -1]
    """
    strips = in_strips(mesh, points)
    return by_buckets(mesh, points) if strips is None else strips.elements()


def by_buckets(mesh, points):
    """`located` by operations on arrays, which plain Python runs faster than a loop."""
    buckets = _Buckets(mesh)
    found = np.empty(len(points), dtype=np.int32)
    step = max(1, int(PAIRS_AT_ONCE / buckets.mean_load))
    for start in range(0, len(points), step):
        found[start : start + step] = buckets.search(points[start : start + step])
    return found


class _Buckets:
    """Elements by the cells of a square grid that their bounding boxes touch."""

    def __init__(self, mesh):
        self.mesh = mesh
        self.low, self.high = mesh.box
        self.n = int(np.sqrt(mesh.n_elements))
        self.flat = nearly_flat(mesh.corners)  # asked only where there is no other element
        self._fill()

    def _cell(self, points):
        """Column and row of points in the bounding box, n of each however flat the domain."""
        share = (points - self.low) / (self.high - self.low)
        return np.floor(share * self.n).astype(np.intp).clip(0, self.n - 1)

    def _boxes(self):
        """First cell, width and height in cells of each bounding box."""
        first = self._cell(self.mesh.corners.min(axis=1))
        last = self._cell(self.mesh.corners.max(axis=1))
        return first, *(last - first + 1).T

    def _fill(self):
        first, width, height = self._boxes()
        while (width * height).sum() > CELLS_OF_AN_ELEMENT * len(first) and self.n > 1:  # many long slivers
            self.n //= 2
            first, width, height = self._boxes()
        element = np.repeat(np.arange(len(first)), width * height)
        place = _count_up(width * height)
        row, column = np.divmod(place, width[element])
        cell = (first[element, 1] + row) * self.n + first[element, 0] + column
        self.elements = element[np.argsort(cell, kind="stable")]
        load = np.bincount(cell, minlength=self.n**2)
        self.starts = np.concatenate([[0], np.cumsum(load)])
        self.mean_load = max(1.0, float((load**2).sum() / max(load.sum(), 1)))

    def search(self, points):
        """The best element of each point's cell, or -1."""
        known = ((points >= self.low) & (points <= self.high)).all(axis=1)  # NaN is not
        cell = self._cell(np.where(known[:, None], points, self.low))
        flat = cell[:, 1] * self.n + cell[:, 0]
        load = np.where(known, self.starts[flat + 1] - self.starts[flat], 0)
        point = np.repeat(np.arange(len(points)), load)
        candidate = self.elements[self.starts[flat][point] + _count_up(load)]
        depth = barycentric(self.mesh.corners[candidate], points[point]).min(axis=1)
        depth[self.flat[candidate] & (depth > -INSIDE)] = -INSIDE
        return _deepest(point, candidate, depth, len(points))


def barycentric(corners, points):
    """Barycentric coordinates of one point in each element.

    Parameters
    ----------
    corners : (m, 3, 2) ndarray of float
    points : (m, 2) ndarray of float

    Returns
    -------
    (m, 3) ndarray of float64

    Examples
    --------
    >>> barycentric(np.array([[[0., 0.], [1., 0.], [0., 1.]]]), np.array([[0.25, 0.5]])).tolist()
    [[0.25, 0.25, 0.5]]
    """
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    p = points - a
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    second = (p[:, 0] * v[:, 1] - p[:, 1] * v[:, 0]) / area
    third = (u[:, 0] * p[:, 1] - u[:, 1] * p[:, 0]) / area
    return np.column_stack([1 - second - third, second, third])


def _count_up(lengths):
    """0 .. n-1 for every n in lengths, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - lengths, lengths)


def _deepest(point, candidate, depth, n_points):
    """The candidate of greatest depth of each point, of several the first; -1 if all are outside.

    The candidates of a point stand together, in ascending order.
    """
    found = np.full(n_points, -1, dtype=np.int32)
    new = np.diff(point, prepend=-1) != 0
    if not new.any():
        return found
    most = np.fmax.reduceat(depth, np.flatnonzero(new))  # a flat element may give NaN
    best = np.flatnonzero(depth == most[np.cumsum(new) - 1])
    best = best[np.diff(point[best], prepend=-1) != 0]
    inside = best[depth[best] >= -INSIDE]
    found[point[inside]] = candidate[inside]
    return found
