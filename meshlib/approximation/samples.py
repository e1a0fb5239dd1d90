"""Samples on a regular grid as a function: bilinear between them."""

import numpy as np

from ..errors import InvalidInputError


class Samples:
    """Bilinear interpolant of samples on a regular grid, as terrain or an image gives them.

    Parameters
    ----------
    samples : (rows, columns) array_like of float
        Rows from the lower to the upper side of the rectangle, columns from left to right.
    low, high : (2,) array_like of float
        Corners of the rectangle that they fill.

    Raises
    ------
    MeshError
        If they are not two rows and columns of finite numbers at least.

    Examples
    --------
    >>> ramp = Samples([[0, 1, 2], [1, 2, 3]], (0, 0), (1, 1))
    >>> float(ramp(np.array(0.25), np.array(0.5)))
    1.0
    """

    def __init__(self, samples, low, high):
        self.samples = np.asarray(samples)
        if self.samples.ndim != 2 or min(self.samples.shape) < 2 or self.samples.dtype.kind not in "fiu":
            raise InvalidInputError(
                "samples",
                f"samples have shape {self.samples.shape} and dtype "
                f"{self.samples.dtype}; give real numbers in at least 2 rows and 2 columns",
            )
        self.samples = self.samples.astype(float)
        bad = np.argwhere(~np.isfinite(self.samples))
        if len(bad):
            raise InvalidInputError(
                "finite",
                f"sample {tuple(bad[0].tolist())} is {self.samples[tuple(bad[0])]}; fill it in or cut it off",
            )
        self.low, self.size = np.asarray(low, dtype=float), np.subtract(high, low)

    def __call__(self, x, y):
        """Values at points; beyond the rectangle those of its border."""
        i, s = self._cell(y, 1, 0)
        j, t = self._cell(x, 0, 1)
        f = self.samples
        below, above = ((1 - t) * f[row, j] + t * f[row, j + 1] for row in (i, i + 1))
        return (1 - s) * below + s * above

    def _cell(self, x, axis, of):
        """Number of the cell of each point, and how far it is into it."""
        cells = self.samples.shape[of] - 1
        at = ((x - self.low[axis]) / self.size[axis] * cells).clip(0, cells)
        number = np.minimum(at.astype(np.int64), cells - 1)
        return number, at - number
