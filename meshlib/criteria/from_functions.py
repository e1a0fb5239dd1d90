"""Criteria made from a function: the cost of one edge or element, or u itself."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import FloatArray, Function
from ..errors import InvalidInputError
from ..geometry import quadrature
from ..kernels import codes, user_costs
from .cost_functions import element_errors
from .criterion import PLACES, Criterion


@dataclass(frozen=True)
class _Given:
    """Returns the cost of one edge or element that a user has given."""

    cost: Callable[..., float]

    def __call__(self) -> Callable[..., float]:
        return self.cost


@dataclass(frozen=True)
class _ErrorOnElement:
    """Returns the error on one element as a function of nine numbers, x, y, u of its nodes."""

    function: Function
    degree: int

    def __call__(self) -> Callable[..., float]:
        points, weights = quadrature.rule(self.degree)
        plain = getattr(self.function, "function", self.function)  # a TestFunction wraps its formula
        return user_costs.error_of(plain, tuple(map(tuple, points.tolist())), tuple(weights.tolist()))


def min_error(function: Function, *, degree: int = 6) -> Criterion:
    """The min-error criterion (section 2.4.1) for a known function u.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    degree : int
        Degree up to which the quadrature integrates a polynomial (u - u_h)^2 exactly.

    Returns
    -------
    Criterion
        On elements, with the L2 norm of u - u_h as the cost; compiled if numba can compile
        the function for single points.  The 2-norm of its cost vector is the L2 error.

    See Also
    --------
    meshlib.Interpolant.l2_error

    Examples
    --------
    >>> from meshlib import Interpolant, delaunay
    >>> mesh, u = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), lambda x, y: x ** 2
    >>> cost = min_error(u).costs(mesh, u)
    >>> bool(np.isclose(np.hypot(*cost), Interpolant(mesh, u).l2_error(u)))
    True
    """

    def cost(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
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
        Part of the mesh that has a cost.
    cost : callable
        A function of numbers that returns a number of at least 0, in the Python that numba
        compiles.  A cost on edges takes twelve: x, y, u of the ends p and q and of the nodes
        opposite to the left and to the right.  A cost on elements takes nine: x, y, u of
        the three nodes.

    Returns
    -------
    Criterion
        Not yet registered.

    Raises
    ------
    MeshError
        If ``on`` is another place, or the cost is not a function.

    Warns
    -----
    RuntimeWarning
        If numba is installed and cannot compile the cost.

    See Also
    --------
    Criterion : From a vectorised cost.
    register : Make a criterion available by its name.

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

    def vectorised(*points: FloatArray) -> FloatArray:
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


def _one_by_one(cost: Callable[..., float], on: str, points: tuple[FloatArray, ...]) -> FloatArray:
    """The cost of each edge or element, from (n, 3) arrays of its four or three points."""
    given = user_costs.pointer(_Given(cost), on)
    if given is None:
        return np.array([cost(*numbers) for numbers in np.concatenate(points, axis=1).tolist()])
    return user_costs.evaluated(given, np.concatenate([*points, points[0]][:4], axis=1))
