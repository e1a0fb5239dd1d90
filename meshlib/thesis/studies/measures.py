"""The four measures of the tables, for one mesh or for many."""

from collections.abc import Callable, Iterable
from typing import TypeAlias

import numpy as np

from ... import Interpolant, Mesh, quality
from ...mesh.quality import MEASURES

Function: TypeAlias = Callable[..., np.ndarray]  # u(x, y), vectorised
Measures: TypeAlias = dict[tuple[str, str], float]  # (measure, statistic) -> value

GRID_POINTS = 101  # points a side; the tables match this grid, not the 200 x 200 of section 4.5.1
L2 = "l2_error", ""  # measure and statistic
PRINTED = ("maximum_angle", "skewness", "aspect_ratio")  # measures of shape in the tables


def measured(mesh: Mesh, function: Function | None = None) -> Measures:
    """Every number that the tables print for a mesh: (measure, statistic) -> value.

    Parameters
    ----------
    mesh : Mesh
    function : callable, optional
        The test function u; without it there is no L2 error.

    Returns
    -------
    dict

    Examples
    --------
    >>> from meshlib import problems
    >>> found = measured(problems.mesh("81"), problems.SR1)
    >>> round(found["maximum_angle", "max"], 6), round(found["l2_error", ""], 6)
    (90.0, 0.004325)
    """
    shape, found = quality(mesh), {}
    mean, largest = shape.mean, shape.max
    for name in PRINTED:
        found[name, "mean"], found[name, "max"] = mean[name], largest[name]
    if function:
        found[L2] = l2_error(mesh, function)
    return found


def shapes(mesh: Mesh) -> str:
    """Mean and maximum of the three measures of shape that the thesis prints, as a text.

    Examples
    --------
    >>> from meshlib import problems
    >>> print(shapes(problems.mesh("81")))
    Measure             mean       max
    Maximum angle    90.0000   90.0000
    Skewness          0.3491    0.3491
    Aspect ratio      0.8660    0.8660
    """
    found = measured(mesh)
    lines = [f"{'Measure':<14} {'mean':>9} {'max':>9}"]
    lines += [
        f"{MEASURES[name]:<14} {found[name, 'mean']:9.4f} {found[name, 'max']:9.4f}" for name in PRINTED
    ]
    return "\n".join(lines)


def l2_error(mesh: Mesh, function: Function) -> float:
    """The L2 error by the trapezium rule that the tables match."""
    return Interpolant(mesh, function).l2_error(function, points=GRID_POINTS, rule="trapezium")


def measured_all(meshes: Iterable[Mesh], function: Function | None) -> dict[tuple[str, str], np.ndarray]:
    """Every number that the tables print, for many meshes: (measure, statistic) -> array of values."""
    remembered = Remembered(function) if function else None
    rows = [measured(mesh, remembered) for mesh in meshes]
    return {key: np.array([row[key] for row in rows]) for key in rows[0]}


class Remembered:
    """A function of x and y that remembers its values at all arrays of points it was given."""

    def __init__(self, function: Function) -> None:
        self.function = function
        self._known: dict[tuple, np.ndarray] = {}

    def __call__(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Values at points."""
        key = x.tobytes(), y.tobytes(), x.shape
        if key not in self._known:
            self._known[key] = self.function(x, y)
        return self._known[key]
