"""Criteria made from a function: the cost of one edge or element, or u itself."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import Function
from ..errors import InvalidInputError
from ..geometry import quadrature
from ..kernels import codes, user_costs
from .cost_functions import element_errors
from .criterion import PLACES, Criterion

ERROR_DEGREE = 6


@dataclass(frozen=True)
class _Given:
    """Gives a cost as it is."""

    cost: Callable

    def __call__(self):
        return self.cost


@dataclass(frozen=True)
class _ErrorOnElement:
    """Gives the error on one element as a function of numbers."""

    function: Callable
    degree: int

    def __call__(self):
        points, weights = quadrature.rule(self.degree)
        plain = getattr(self.function, "function", self.function)  # a TestFunction wraps its formula
        return user_costs.error_of(plain, tuple(map(tuple, points.tolist())), tuple(weights.tolist()))


def min_error(function: Function, *, degree: int = ERROR_DEGREE) -> Criterion:
    """The min-error criterion (section 2.4.1) for a known function u.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    degree : int
        Polynomial degree of (u - u_h)^2 that the quadrature integrates exactly.

    Returns
    -------
    Criterion
        On elements; compiled if numba can compile the function for single points.  With norm 2
        the norm of its cost vector is the L2 error.

    Examples
    --------
    >>> from meshlib import Interpolant, delaunay
    >>> mesh, u = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), lambda x, y: x ** 2
    >>> cost = min_error(u).costs(mesh, u)
    >>> bool(np.isclose(np.hypot(*cost), Interpolant(mesh, u).l2_error(u)))
    True
    """

    def cost(a, b, c):
        return element_errors(a, b, c, function, degree)

    return Criterion(
        "min-error",
        "element",
        cost,
        "L2 error",
        lambda extent, height: height * extent,
        codes.USER_ELEMENT,
        pointwise=_ErrorOnElement(function, degree),
    )


def pointwise(
    name: str,
    on: str,
    cost: Callable[..., float],
    *,
    title: str = "",
    unit: Callable[[float, float], float] | None = None,
) -> Criterion:
    """A user-defined criterion, given by the cost of a single edge or element.

    The procedure then runs as it does for built-in criteria: compiled by numba where
    that is installed.  If numba cannot compile the function, a warning says so, and it
    runs in Python.

    Parameters
    ----------
    name, title, unit
        As for `Criterion`.
    on : {"edge", "element"}
    cost : callable
        A function of numbers, in the Python that numba compiles.  On an edge twelve:
        x, y, u of its ends p and q and of the opposite nodes to its left and right.  On
        an element nine: x, y, u of its three nodes.  Returns a number of at least 0.

    Returns
    -------
    Criterion

    Raises
    ------
    MeshError
        If ``on`` is another place, or the cost not a function.

    Examples
    --------
    >>> from math import sqrt
    >>> from meshlib import problems, swapped
    >>> def length(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
    ...     return sqrt((px - qx) ** 2 + (py - qy) ** 2 + (pu - qu) ** 2)  # of the edge in space
    >>> short = pointwise("length", "edge", length)
    >>> swapped(problems.mesh("33"), problems.SR2, short, norm="L1").swaps
    11
    """
    checks.choice(on, PLACES[:2], "place")
    if not callable(cost):
        raise InvalidInputError("type", f"the cost of {name!r} is {cost!r}; give a function")

    def vectorised(*points):
        return _one_by_one(cost, on, points)

    code = codes.USER_EDGE if on == "edge" else codes.USER_ELEMENT
    unit = unit or (lambda extent, height: 0.0)
    found = Criterion(name, on, vectorised, title, unit, code, pointwise=_Given(cost))
    if found.pointer is None:
        warnings.warn(
            f"numba cannot compile the cost of {name!r}; the procedure will run in Python",
            RuntimeWarning,
            stacklevel=2,
        )
    return found


def _one_by_one(cost, on, points):
    """The cost of each edge or element, from (n, 3) arrays of its four or three points."""
    given = user_costs.pointer(_Given(cost), on)
    if given is None:
        return np.array([cost(*numbers) for numbers in np.concatenate(points, axis=1).tolist()])
    return user_costs.evaluated(given, np.concatenate([*points, points[0]][:4], axis=1))
