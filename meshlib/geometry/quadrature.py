"""Quadrature on the reference triangle, exact to any degree."""

from functools import cache

import numpy as np

from .._typing import FloatArray


@cache
def rule(degree: int) -> tuple[FloatArray, FloatArray]:
    """Barycentric points and weights, exact for polynomials up to ``degree``.

    The square is collapsed onto the triangle (Stroud's conical product), with Gauss
    points in one direction and Gauss-Jacobi points in the other.

    Parameters
    ----------
    degree : int
        At least 0.

    Returns
    -------
    points : (q, 3) ndarray of float64
        Barycentric coordinates.
    weights : (q,) ndarray of float64
        Positive, of sum 1: multiply by the area of the element.

    See Also
    --------
    points_in : the points in given elements.

    Examples
    --------
    >>> points, weights = rule(4)
    >>> round(float(weights @ points[:, 0] ** 4), 12)  # 2 * 4! / 6! = 1 / 15
    0.066666666667
    """
    from scipy.special import roots_jacobi, roots_legendre

    n = degree // 2 + 1
    s, ws = roots_legendre(n)
    t, wt = roots_jacobi(n, 1, 0)  # the weight 1 - t is the Jacobian of the collapse
    s, t = (s + 1) / 2, (t + 1) / 2
    second = np.outer(s, 1 - t).ravel()
    third = np.tile(t, n)
    weights = np.outer(ws, wt).ravel()
    return np.column_stack([1 - second - third, second, third]), weights / weights.sum()


def points_in(corners: FloatArray, degree: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Quadrature points in elements with the given corners.

    Parameters
    ----------
    corners : (T, 3, 2) ndarray of float
    degree : int
        Polynomial degree up to which the rule is exact, at least 0.

    Returns
    -------
    x, y : (T, q) ndarray of float64
        Coordinates of the q points in each element.
    barycentric : (q, 3) ndarray of float64
    weights : (q,) ndarray of float64
        Of sum 1: multiply by the area of the element.

    See Also
    --------
    rule

    Examples
    --------
    >>> x, y, _, _ = points_in(np.array([[[0., 0.], [1., 0.], [0., 1.]]]), degree=1)
    >>> x.round(6).tolist(), y.round(6).tolist()
    ([[0.333333]], [[0.333333]])
    """
    barycentric, weights = rule(degree)
    return corners[..., 0] @ barycentric.T, corners[..., 1] @ barycentric.T, barycentric, weights
