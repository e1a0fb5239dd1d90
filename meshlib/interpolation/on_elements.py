"""Linear functions on single elements: their gradients, and the squares of their errors."""

from typing import Any

import numpy as np

from .._typing import FloatArray, Function
from ..geometry import quadrature
from ..kernels.element_shapes import gradient

POINTS_AT_ONCE = 100_000  # number of quadrature points that fit a processor's memory


def gradients(corners: FloatArray, values: FloatArray) -> FloatArray:
    """Gradients of planes through three points in space.

    Parameters
    ----------
    corners : (T, 3, 2) ndarray of float
    values : (T, 3) ndarray of float

    Returns
    -------
    (T, 2) ndarray of float64

    Examples
    --------
    >>> gradients(np.array([[[0., 0.], [1., 0.], [0., 1.]]]), np.array([[0., 2., 3.]])).tolist()
    [[2.0, 3.0]]
    """
    e, f = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    du, dv = values[:, 1] - values[:, 0], values[:, 2] - values[:, 0]
    twice_area = e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]
    formula: Any = gradient  # the kernel takes one element, its formula holds for arrays too
    return np.column_stack(formula(e.T, f.T, du, dv, twice_area))


def squared_errors(corners: FloatArray, values: FloatArray, function: Function, degree: int) -> FloatArray:
    """Integral of (u - u_h)^2 over each element with corners, (T, 3, 2), and nodal values, (T, 3)."""
    found, step = np.empty(len(corners)), max(1, POINTS_AT_ONCE // len(quadrature.rule(degree)[1]))
    for start in range(0, len(corners), step):
        batch = slice(start, start + step)
        found[batch] = _squared_errors(corners[batch], values[batch], function, degree)
    return found


def _squared_errors(corners: FloatArray, values: FloatArray, function: Function, degree: int) -> FloatArray:
    x, y, barycentric, weights = quadrature.points_in(corners, degree)
    error = function(x, y) - values @ barycentric.T
    e, f = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]) / 2
    return np.asarray(areas * (error**2 @ weights))
