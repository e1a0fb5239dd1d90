"""Which element a point lies in, by compiled search from elements to points.

The points are sorted into strips, so that crowded places have narrow strips and long
elements cost no memory; the order of the elements, and with it who decides, is kept.
"""

import numpy as np

from ..kernels import compiled_for_work

FEW = 20_000  # elements and points below which buckets are as fast
POINTS_IN_A_STEP = 2  # elements and points that buckets manage in about a microsecond
CELLS = np.uint16(128)  # in a row
PER_STRIP = 2.0  # how many times as many points in a strip as there are strips


def in_strips(mesh, points):
    """The points in strips, if there are enough of them and compiled kernels are worth loading; or None."""
    size = len(points) + mesh.n_elements
    kernels = compiled_for_work(size / POINTS_IN_A_STEP) if size >= FEW else None
    return Strips(mesh, points, kernels) if kernels else None


class Strips:
    """Points of the bounding box in strips, as many in each, from bottom to top in each strip."""

    def __init__(self, mesh, points, kernels):
        self.mesh, self.points, self._kernels = mesh, points, kernels
        low, high = mesh.box
        known = np.flatnonzero(((points >= low) & (points <= high)).all(axis=1))  # NaN is not
        self.unit = float(np.abs([low, high]).max())
        self.size = max(1, int(np.sqrt(PER_STRIP * len(known))))
        self._sort(known)

    def _sort(self, known):
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

    def elements(self):
        """The element of each point, -1 outside the domain."""
        return self._in_order_of_points(self._search(), -1)

    def _search(self):
        """The element of each point, in the order of the strips."""
        kernels, writable = self._kernels, self._kernels.writable
        best = writable(np.full(len(self.order), -np.inf))
        found = writable(np.full(len(self.order), -1, dtype=np.int32))
        search = kernels.location.Search(best, found)
        kernels.location.searched(self._strips(), self._elements(), search)
        return found

    def _strips(self):
        x, y, edge = map(self._kernels.readable, (self.x, self.y, self.edge))
        return self._kernels.location.Strips(x, y, self.size, edge)

    def _elements(self):
        order, nodes, place = map(
            self._kernels.readable, (self._neighbouring(), self.mesh.elements, self.mesh.nodes)
        )
        return self._kernels.location.Elements(order, nodes, place, self.unit)

    def _neighbouring(self):
        """Numbers of the elements, those in a cell of a grid together: they share nodes and points."""
        low, high = self.mesh.box
        place = [
            ((column - a) * (CELLS / (b - a))).astype(np.uint16).clip(0, CELLS - 1)
            for column, a, b in zip(self.mesh.nodes.T, low, high, strict=True)
        ]
        cell = place[0] * CELLS + place[1]  # 16 bits, which are sorted fastest
        return np.argsort(cell[self.mesh.elements[:, 0]], kind="stable")

    def values(self, values):
        """Values at the points of the interpolant of nodal values, NaN outside the domain."""
        value = self._kernels.writable(np.full(len(self.order), np.nan))
        self._kernels.location.interpolated(
            self._strips(), self._elements(), self._search(), self._kernels.readable(values), value
        )
        return self._in_order_of_points(value, np.nan)

    def _in_order_of_points(self, of_strips, elsewhere):
        """What has been found in the order of the strips, in the order of the points."""
        of_strips = np.asarray(of_strips)
        found = np.full(len(self.points), elsewhere, dtype=of_strips.dtype)
        found[self.order] = of_strips
        return found
