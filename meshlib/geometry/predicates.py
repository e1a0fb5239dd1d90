"""Exact signs of the two geometric predicates, for arrays of points.

A determinant in floating point comes with a bound on its rounding error
[shewchuk1997]_.  Where the value exceeds the bound, its sign is right.  The few points
where it does not are scaled to integers, which Python multiplies exactly, and the formula
is evaluated once more.
"""

from collections.abc import Callable, Iterable
from itertools import combinations
from typing import Any, TypeAlias

import numpy as np

from .._typing import ArrayLike, BoolArray, FloatArray, NDArray

MANTISSA_BITS = 53  # digits of a float64
ROUNDOFF = 2.0**-MANTISSA_BITS  # largest relative error of one operation
ORIENTATION_BOUND = (3 + 16 * ROUNDOFF) * ROUNDOFF  # error relative to the sum of the two products
INCIRCLE_BOUND = (10 + 96 * ROUNDOFF) * ROUNDOFF  # error relative to the sum of the products' sizes
FLAT = 1e-12  # area that counts as 0, relative to the products whose difference it is
ULPS = 16  # roundings of a coordinate; times the longest edge, they are the error of an area

Signs: TypeAlias = NDArray[np.int8]
Formula: TypeAlias = Callable[..., tuple[Any, Any]]  # points to a determinant and the size of its products


def orientation(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Signs:
    """Exact sign of the turn a -> b -> c.

    Parameters
    ----------
    a, b, c : (..., 2) array_like of float
        Points in the plane, broadcast against each other.

    Returns
    -------
    (...) ndarray of int8
        +1 counter-clockwise, -1 clockwise, 0 collinear, without any rounding.

    See Also
    --------
    incircle, nearly_flat

    References
    ----------
    .. [shewchuk1997] J. R. Shewchuk, Adaptive precision floating-point arithmetic
       and fast robust geometric predicates, Discrete Comput. Geom. 18 (1997).

    Examples
    --------
    >>> int(orientation([0, 0], [1, 0], [0, 1]))
    1
    >>> int(orientation([0.1, 0.1], [0.2, 0.2], [0.3, 0.3]))  # 0.3 is not 3 * 0.1 in binary
    0
    """
    return _sign(_turn, ORIENTATION_BOUND, a, b, c)


def incircle(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Signs:
    """Exact side of d with respect to the circle through a, b, c.

    Parameters
    ----------
    a, b, c, d : (..., 2) array_like of float
        Points in the plane; a, b, c counter-clockwise.

    Returns
    -------
    (...) ndarray of int8
        +1 inside, -1 outside, 0 on the circle, without any rounding.

    See Also
    --------
    orientation

    Examples
    --------
    >>> int(incircle([0, 0], [1, 0], [1, 1], [0, 1]))
    0
    >>> int(incircle([0, 0], [1, 0], [1, 1], [0.5, 0.5]))
    1
    """
    return _sign(_circle, INCIRCLE_BOUND, a, b, c, d)


def nearly_flat(corners: FloatArray) -> BoolArray:
    """Whether rounding of its coordinates may have laid a triangle flat or turned it over.

    Parameters
    ----------
    corners : (T, 3, 2) ndarray of float

    Returns
    -------
    (T,) ndarray of bool
        Also true for triangles that are clockwise.

    Examples
    --------
    >>> sliver = [[0.0, 0.0], [0.1, 0.3], [0.2, 0.6]], [[0.0, 0.0], [1.0, 0.0], [1.0, 1e-9]]
    >>> nearly_flat(np.array(sliver)).tolist()
    [True, False]
    """
    unit = np.abs(corners).max(initial=0) or 1  # products of tiny coordinates underflow
    (ax, bx, cx), (ay, by, cy) = np.moveaxis(corners, (2, 1), (0, 1)) / unit
    ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
    left, right = ux * vy, uy * vx
    room = FLAT * (np.abs(left) + np.abs(right))
    longest = np.maximum(np.maximum(np.abs(ux), np.abs(uy)), np.maximum(np.abs(vx), np.abs(vy)))
    found = left - right <= room + ULPS * ROUNDOFF * longest  # for coordinates of up to 1
    some = np.flatnonzero(found)
    moved = ULPS * ROUNDOFF * np.abs(corners[some] / unit).max(axis=(1, 2)) * longest[some]
    found[some] = (left - right)[some] <= room[some] + moved
    return found


def _sign(formula: Formula, bound: float, *arrays: ArrayLike) -> Signs:
    points = np.broadcast_arrays(*(np.asarray(p, dtype=float) for p in arrays))
    with np.errstate(over="ignore", invalid="ignore", under="ignore"):
        value, size = formula(*points)
        decided = np.abs(value) > bound * size + np.finfo(float).tiny
    signs = np.asarray(np.where(decided, np.sign(value), 0), dtype=np.int8)
    undecided = np.array(~decided)
    undecided[undecided] = _distinct(p[undecided] for p in points)
    if undecided.any():
        exact, _ = formula(*_as_integers([p[undecided] for p in points]))
        signs[undecided] = (exact > 0).astype(np.int8) - (exact < 0).astype(np.int8)
    return signs


def _distinct(points: Iterable[FloatArray]) -> BoolArray:
    """Whether no two points coincide; where two do, both predicates are 0."""
    return ~np.any([(p == q).all(axis=-1) for p, q in combinations(points, 2)], axis=0)


def _turn(a: NDArray[Any], b: NDArray[Any], c: NDArray[Any]) -> tuple[Any, Any]:
    left = (a[..., 0] - c[..., 0]) * (b[..., 1] - c[..., 1])
    right = (a[..., 1] - c[..., 1]) * (b[..., 0] - c[..., 0])
    return left - right, abs(left) + abs(right)


def _circle(a: NDArray[Any], b: NDArray[Any], c: NDArray[Any], d: NDArray[Any]) -> tuple[Any, Any]:
    seen = [(p[..., 0] - d[..., 0], p[..., 1] - d[..., 1]) for p in (a, b, c)]
    value: Any = 0
    size: Any = 0
    for k in range(3):
        (px, py), (qx, qy), (rx, ry) = seen[k:] + seen[:k]
        lift, left, right = px * px + py * py, qx * ry, qy * rx
        value = value + lift * (left - right)
        size = size + lift * (abs(left) + abs(right))
    return value, size


def _as_integers(points: list[FloatArray]) -> list[NDArray[Any]]:
    """Points scaled by one common power of 2 to exact Python integers."""
    mantissas, exponents = np.frexp(np.stack(points))
    integers = np.ldexp(mantissas, MANTISSA_BITS).astype(np.int64).astype(object)
    smallest = exponents[mantissas != 0].min(initial=exponents.max())
    shifts = np.where(mantissas != 0, exponents - smallest, 0).astype(object)
    return list(integers * 2**shifts)
