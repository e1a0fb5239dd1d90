"""Search for the element in which a point lies, by a grid of buckets over the bounding box."""

import numpy as np

from .._typing import FloatArray, IntArray
from ..geometry.predicates import nearly_flat
from ..kernels.element_shapes import INSIDE
from ..mesh.mesh import Mesh
from .locate_by_strips import in_strips


def located(mesh: Mesh, points: FloatArray) -> IntArray:
    """The element that contains each point.

    Parameters
    ----------
    mesh : Mesh
    points : (m, 2) ndarray of float

    Returns
    -------
    (m,) ndarray of int32
        Element numbers, -1 outside the domain.  Of several elements at a point on an edge
        or a node, the one in which the point lies deepest is taken: its depth is the
        smallest of its barycentric coordinates.  Of equal depths, the first element wins.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> mesh = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> located(mesh, np.array([[0.9, 0.1], [0.1, 0.9], [2.0, 0.0]])).tolist()
    [0, 1, -1]
    """
    strips = in_strips(mesh, points)
    return by_buckets(mesh, points) if strips is None else strips.elements()


def by_buckets(mesh: Mesh, points: FloatArray) -> IntArray:
    """The element that contains each point, by NumPy alone; see `located`."""
    buckets = _Buckets(mesh)
    found = np.empty(len(points), dtype=np.int32)
    step = max(1, int(buckets.pairs_at_once / buckets.mean_load))
    for start in range(0, len(points), step):
        found[start : start + step] = buckets.search(points[start : start + step])
    return found


class _Buckets:
    """Elements by the cells of a square grid that their bounding boxes touch."""

    pairs_at_once = 2_000_000  # largest number of points and elements compared at once, to limit the memory
    cells_per_element = 64  # mean number beyond which the cells are made larger

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self.low, self.high = mesh.box
        self.n = int(np.sqrt(mesh.n_elements))
        self.flat = nearly_flat(mesh.corners)  # these have a point only if no other element has it
        self._fill()

    def _cell(self, points: FloatArray) -> IntArray:
        """Column and row of the cell of each point; there are n of each, whatever the shape of the domain."""
        share = (points - self.low) / (self.high - self.low)
        return np.floor(share * self.n).astype(np.intp).clip(0, self.n - 1)

    def _boxes(self) -> tuple[IntArray, IntArray, IntArray]:
        """First cell, width and height in cells of each bounding box."""
        first = self._cell(self.mesh.corners.min(axis=1))
        last = self._cell(self.mesh.corners.max(axis=1))
        width, height = (last - first + 1).T
        return first, width, height

    def _fill(self) -> None:
        """Sort the elements by the cells that their bounding boxes touch."""
        first, width, height = self._boxes()
        while (width * height).sum() > self.cells_per_element * len(
            first
        ) and self.n > 1:  # many long slivers
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

    def search(self, points: FloatArray) -> IntArray:
        """The element in which each point lies deepest, of those that touch its cell, or -1."""
        known = np.all((points >= self.low) & (points <= self.high), axis=1)  # NaN is not
        cell = self._cell(np.where(known[:, None], points, self.low))
        flat = cell[:, 1] * self.n + cell[:, 0]
        load = np.where(known, self.starts[flat + 1] - self.starts[flat], 0)
        point = np.repeat(np.arange(len(points)), load)
        candidate = self.elements[self.starts[flat][point] + _count_up(load)]
        depth = barycentric(self.mesh.corners[candidate], points[point]).min(axis=1)
        depth[self.flat[candidate] & (depth > -INSIDE)] = -INSIDE
        return _deepest(point, candidate, depth, len(points))


def barycentric(corners: FloatArray, points: FloatArray) -> FloatArray:
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


def _count_up(lengths: IntArray) -> IntArray:
    """0 to n - 1 for each n in lengths, one sequence after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - lengths, lengths)


def _deepest(point: IntArray, candidate: IntArray, depth: FloatArray, n_points: int) -> IntArray:
    """The candidate in which each point lies deepest, the first of equal ones; -1 if it is outside all.

    ``point`` ascends, and the candidates of each point do.
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
