"""Which element a point lies in, by compiled search from elements to points.

The points are sorted into strips, so that crowded places have narrow strips and long
elements cost no memory; the order of the elements, and with it who decides, is kept.
"""

import numpy as np

FEW = 20_000  # elements and points, which take less time than the import of the compiler
CELLS = np.uint16(128)  # in a row
PER_STRIP = 2.0  # how many times as many points in a strip as there are strips


def pay(mesh, points):
    """Whether the search pays: it needs numba, whose import takes longer than a few points."""
    if len(points) + mesh.n_elements < FEW:
        return False
    from ..kernels import backend

    return backend.NAME == "numba"


class Strips:
    """Points of the bounding box in strips, as many in each, from bottom to top in each strip."""

    def __init__(self, mesh, points):
        self.mesh, self.points = mesh, points
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
        """The same in the order of the strips."""
        from ..kernels import location
        from ..kernels.backend import readable, writable

        best = writable(np.full(len(self.order), -np.inf))
        found = writable(np.full(len(self.order), -1, dtype=np.int32))
        location.searched(
            *map(readable, (self.x, self.y)),
            self.size,
            *map(readable, (self.edge, self._neighbouring(), self.mesh.elements, self.mesh.nodes)),
            self.unit,
            best,
            found,
        )
        return found

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
        from ..kernels import location
        from ..kernels.backend import readable, writable

        value = writable(np.full(len(self.order), np.nan))
        location.interpolated(
            *map(readable, (self.x, self.y)),
            self._search(),
            readable(self.mesh.elements),
            readable(self.mesh.nodes),
            readable(values),
            value,
        )
        return self._in_order_of_points(value, np.nan)

    def _in_order_of_points(self, of_strips, elsewhere):
        """What has been found in the order of the strips, in the order of the points."""
        of_strips = np.asarray(of_strips)
        found = np.full(len(self.points), elsewhere, dtype=of_strips.dtype)
        found[self.order] = of_strips
        return found
