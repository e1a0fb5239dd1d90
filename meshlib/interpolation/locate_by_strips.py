"""Search for the element in which a point lies, compiled: each element looks for its points.

The points are sorted into vertical strips with equal numbers of points, so that strips are
narrow where points are dense, and an element needs no memory however long it is.  Which of
several elements a point is given to does not depend on the strips.
"""

from typing import Any

import numpy as np

from .._typing import FloatArray, IntArray, NDArray
from ..kernels import compiled_for_work
from ..kernels.backend import Plain
from ..mesh.mesh import Mesh

FEW = 20_000  # number of elements and points below which buckets are as fast
POINTS_IN_A_STEP = 2  # number of elements and points that buckets manage in about a microsecond


def in_strips(mesh: Mesh, points: FloatArray) -> "Strips | None":
    """The points in strips; None if they are too few to load compiled kernels, or there are no such."""
    size = len(points) + mesh.n_elements
    kernels = compiled_for_work(size / POINTS_IN_A_STEP) if size >= FEW else None
    return Strips(mesh, points, kernels) if kernels else None


class Strips:
    """Points of the bounding box in vertical strips with equal numbers of points, sorted upwards in each."""

    cells = np.uint16(128)  # number of cells in a row of the grid that sorts the elements
    slenderness = 2.0  # number of points in a strip, divided by the number of strips

    def __init__(self, mesh: Mesh, points: FloatArray, kernels: Plain) -> None:
        self.mesh, self.points, self._kernels = mesh, points, kernels
        low, high = mesh.box
        known = np.flatnonzero(((points >= low) & (points <= high)).all(axis=1))  # NaN is not
        self.unit = float(np.abs([low, high]).max())
        self.size = max(1, int(np.sqrt(self.slenderness * len(known))))
        self._sort(known)

    def _sort(self, known: IntArray) -> None:
        """Sort from left to right, then each strip from bottom to top."""
        x, y = self.points[known].T
        order = np.argsort(x, kind="stable")
        rows = -(-len(known) // self.size)
        heights = np.full(rows * self.size, np.inf)
        heights[: len(known)] = y[order]
        place = np.argsort(heights.reshape(rows, self.size), axis=1, kind="stable")
        place = (place + self.size * np.arange(rows)[:, None]).ravel()[: len(known)]
        self.edge = np.append(x[order[:: self.size]], np.inf)
        self.order = known[order[place]]
        self.x, self.y = x[order[place]], y[order[place]]

    def elements(self) -> IntArray:
        """The element of each point, -1 outside the domain."""
        return self._in_order_of_points(self._search(), -1)

    def _search(self) -> IntArray:
        """The element of each point, in the order of the strips."""
        kernels, writable = self._kernels, self._kernels.writable
        best = writable(np.full(len(self.order), -np.inf))
        found = writable(np.full(len(self.order), -1, dtype=np.int32))
        search = kernels.location.Search(best, found)
        kernels.location.searched(self._strips(), self._elements(), search)
        return found

    def _strips(self) -> Any:
        """The strips as the kernels take them."""
        x, y, edge = map(self._kernels.readable, (self.x, self.y, self.edge))
        return self._kernels.location.Strips(x, y, self.size, edge)

    def _elements(self) -> Any:
        """The elements as the kernels take them."""
        order, nodes, place = map(
            self._kernels.readable, (self._neighbouring(), self.mesh.elements, self.mesh.nodes)
        )
        return self._kernels.location.Elements(order, nodes, place, self.unit)

    def _neighbouring(self) -> IntArray:
        """Numbers of the elements, cell by cell of a grid, so that nodes and points are near in memory."""
        low, high = self.mesh.box
        place = [
            ((column - a) * (self.cells / (b - a))).astype(np.uint16).clip(0, self.cells - 1)
            for column, a, b in zip(self.mesh.nodes.T, low, high, strict=True)
        ]
        cell = place[0] * self.cells + place[1]  # a number of 16 bits, which is sorted fastest
        return np.argsort(cell[self.mesh.elements[:, 0]], kind="stable")

    def values(self, values: FloatArray) -> FloatArray:
        """Values at the points of the interpolant of nodal values, NaN outside the domain."""
        value = self._kernels.writable(np.full(len(self.order), np.nan))
        self._kernels.location.interpolated(
            self._strips(), self._elements(), self._search(), self._kernels.readable(values), value
        )
        return self._in_order_of_points(value, np.nan)

    def _in_order_of_points(self, of_strips: NDArray[Any], elsewhere: float) -> NDArray[Any]:
        """Results in the order of the points, from results in the order of the strips."""
        of_strips = np.asarray(of_strips)
        found = np.full(len(self.points), elsewhere, dtype=of_strips.dtype)
        found[self.order] = of_strips
        return found
