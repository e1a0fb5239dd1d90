r"""Nodes along a smooth closed boundary, and start meshes of the domain inside (section 7.2).

A curve is a function of a parameter t from 0 to 1 that returns the arrays x and y; it is closed,
so that t = 0 and t = 1 give the same point.  Chords between nodes on it leave slivers::

          . - ~ ~ ~ - .
        .               .       an arc of length h and curvature k
       s_i ----------- s_i+1    above its chord: a sliver of area k h^3 / 12

Their total area is least if the integral of k^(1/3) between any two neighbours is the same: a
mesh problem in one dimension, cut open at t = 0.  `boundary_parameters` solves it; the
parameters it returns are handed, with the curve, to `deviation` and `domain_mesh`.
"""

from collections.abc import Callable, Iterable
from typing import TypeAlias

import numpy as np

from . import checks
from ._typing import ArrayLike, FloatArray, Function
from .errors import InvalidInputError, InvalidMeshError
from .geometry.curve_sampling import (
    DENSITIES,
    arc_parameters,
    data_density,
    derivative,
    refuse_open,
    refuse_unordered,
    sliver_areas,
)
from .geometry.polygons import inside, lattice_inside
from .mesh.delaunay import delaunay
from .mesh.mesh import Mesh

__all__ = ["boundary_parameters", "deviation", "domain_mesh", "equidistributed"]

Curve: TypeAlias = Callable[[FloatArray], Iterable[ArrayLike]]  # vectorised: t to the arrays x and y

SMALLEST_RING = 3  # number of nodes of the smallest polygon


def equidistributed(density: ArrayLike, n: int) -> FloatArray:
    """Parameters that cut a periodic density into parts of equal integral.

    Parameters
    ----------
    density : (m,) array_like of float
        Values of at least 0 at the parameters 0, 1/m, 2/m, ...; linear between them.
    n : int
        Number of parameters, at least 1.

    Returns
    -------
    (n,) ndarray of float64
        Ascending from 0, where the period is cut open, and below 1.

    Raises
    ------
    MeshError
        If a value is negative or not finite, all are 0, or ``n`` is out of range.

    See Also
    --------
    boundary_parameters : for a density that belongs to a curve.

    Examples
    --------
    >>> equidistributed([1, 1, 1, 1, 3, 3, 3, 3], 4).round(3).tolist()
    [0.0, 0.438, 0.625, 0.792]
    """
    density = checks.numeric(density, "density")
    bad = np.flatnonzero(~(np.isfinite(density) & (density >= 0)))
    if bad.size:
        raise InvalidInputError(
            "range",
            f"the density of sample {bad[0]} is {density[bad[0]]}; give finite numbers of at least 0",
            bad,
            bad.size,
        )
    if not density.any():
        raise InvalidInputError(
            "range",
            'the density is 0 everywhere, so that no place is better than another; use density="length"',
        )
    n = checks.whole(n, 1, "n")
    around = np.append(density, density[0])
    total = np.concatenate([[0], np.cumsum((around[1:] + around[:-1]) / 2)])
    return np.interp(total[-1] * np.arange(n) / n, total, np.linspace(0, 1, len(total)))


def boundary_parameters(
    curve: Curve, n: int, density: str | Function = "curvature", even: float = 0.0
) -> FloatArray:
    """Parameters of n nodes along a closed curve.

    Parameters
    ----------
    curve : callable
        Vectorised and closed: an array of t from 0 to 1 to the arrays x and y.
    n : int
        Number of nodes, at least 3.
    density : {"curvature", "length", "parameter"} or callable
        Measure of an arc; it is the same between any two neighbours:

        - ``"curvature"``: the integral of ``|k|^(1/3)`` over the arc length, where k is the
          curvature.  It makes the area between curve and polygon least.
        - ``"length"``: the arc length.
        - ``"parameter"``: the difference of the parameters.
        - a vectorised function u(x, y): the integral of ``|u_ss|^(2/5)`` over the arc length,
          where u_ss is the second derivative along the curve.  It makes the L2 error of
          linear interpolation along the curve least.
    even : float
        Share of the nodes, from 0 to 1, that is spread evenly over the arc length
        whatever the density is, so that straight stretches get nodes as well.

    Returns
    -------
    (n,) ndarray of float64
        Ascending from 0, and below 1.

    Raises
    ------
    MeshError
        If the curve is not closed, curve or function is not finite, or an argument is out
        of range.

    See Also
    --------
    deviation : the area between the curve and the polygon of these nodes.
    domain_mesh : a start mesh with these boundary nodes.

    Examples
    --------
    The ellipse is an affine image of the circle, and so are its best polygons:

    >>> def ellipse(t):
    ...     return 3 * np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)
    >>> boundary_parameters(ellipse, 4).round(6).tolist()
    [0.0, 0.25, 0.5, 0.75]
    """
    n = checks.whole(n, SMALLEST_RING, "n")
    even = checks.number(even, "even", 0, np.nextafter(1, 2), "a share from 0 to 1")
    points = _sampled(curve)
    speed = np.hypot(*derivative(points))
    if callable(density):
        found = data_density(_values_on_curve(density, points), speed)
    else:
        found = DENSITIES[checks.choice(density, tuple(DENSITIES), "density")](points, speed)
    if even == 1:
        return equidistributed(speed, n)
    return equidistributed((1 - even) * found / (found.mean() or 1) + even * speed / speed.mean(), n)


def deviation(curve: Curve, parameters: ArrayLike) -> float:
    """Area between a closed curve and the polygon with nodes at the given parameters.

    Parameters
    ----------
    curve : callable
        Vectorised and closed: an array of t from 0 to 1 to the arrays x and y.
    parameters : (n,) array_like of float
        Parameters of the nodes: at least 3, ascending, within one period.

    Returns
    -------
    float
        The sum of the areas of all slivers, in the unit of the coordinates squared; those
        outside the curve count as much as those inside.

    Raises
    ------
    MeshError
        If the parameters are too few or do not ascend within one period, or the curve is
        not closed or not finite.

    See Also
    --------
    boundary_parameters : the parameters for which this area is least.

    Examples
    --------
    A square leaves pi - 2 of the unit circle around it:

    >>> def circle(t):
    ...     return np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)
    >>> round(deviation(circle, [0, 0.25, 0.5, 0.75]), 3), round(np.pi - 2, 3)
    (1.142, 1.142)
    """
    x, y = _points(curve, arc_parameters(_ascending(curve, parameters)))
    return float(sliver_areas(x, y).sum())


def domain_mesh(curve: Curve, parameters: ArrayLike, spacing: float | None = None) -> Mesh:
    """A start mesh of the domain inside a closed curve.

    Parameters
    ----------
    curve : callable
        Vectorised and closed: an array of t from 0 to 1 to the arrays x and y; the curve runs
        counter-clockwise.
    parameters : (n,) array_like of float
        Parameters of the boundary nodes: at least 3, ascending, within one period.
    spacing : float, optional
        Distance of neighbouring inner nodes, in the unit of the coordinates; they form a
        lattice of equilateral triangles.  By default the mean length of the boundary edges.

    Returns
    -------
    Mesh
        The first n nodes are those along the curve.

    Raises
    ------
    MeshError
        If the parameters are too few or do not ascend within one period, the curve runs
        clockwise or crosses itself, or an edge of the boundary is not a Delaunay edge.

    See Also
    --------
    boundary_parameters : where the boundary nodes should be.
    meshlib.smoothed, meshlib.refined : what improves the mesh inside.

    Notes
    -----
    The Delaunay mesh of boundary and inner nodes covers their convex hull, which is the
    domain if the polygon is convex.  If it is not, the elements outside it are removed.
    Every edge of the polygon must therefore be an edge of the Delaunay mesh, as it is with
    enough boundary nodes where two parts of the boundary are near each other.

    Examples
    --------
    >>> def circle(t):
    ...     return np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)
    >>> mesh = domain_mesh(circle, boundary_parameters(circle, 12))
    >>> mesh.n_nodes, int(mesh.boundary_nodes.sum())
    (19, 12)
    """
    ring = _points(curve, _ascending(curve, parameters) % 1).T
    edges = np.roll(ring, -1, axis=0) - ring
    if (ring[:, 0] * edges[:, 1] - ring[:, 1] * edges[:, 0]).sum() <= 0:
        raise InvalidMeshError("orientation", "the curve goes round clockwise; reverse its parameter")
    spacing = np.hypot(*edges.T).mean() if spacing is None else spacing
    spacing = checks.number(spacing, "spacing", np.nextafter(0, 1), np.inf, "a finite length above 0")
    whole = delaunay(np.concatenate([ring, lattice_inside(ring, spacing)]))
    _refuse_missing(whole, len(ring))
    return Mesh(whole.nodes, whole.elements[inside(ring, whole.corners.mean(axis=1))]).validate()


def _ascending(curve: Curve, parameters: ArrayLike) -> FloatArray:
    """The parameters of nodes as an ascending array, or a MeshError; the curve is checked as well."""
    _sampled(curve)
    t = checks.numeric(parameters, "parameters")
    refuse_unordered(t, SMALLEST_RING)
    return t


def _refuse_missing(mesh: Mesh, n: int) -> None:
    """Raise a MeshError if an edge of the ring of the first n nodes is not in the mesh."""
    pairs = np.sort(np.column_stack([np.arange(n), np.roll(np.arange(n), -1)]), axis=1)
    known = np.isin(pairs @ [mesh.n_nodes, 1], mesh.edges.astype(np.int64) @ [mesh.n_nodes, 1])
    if not known.all():
        i, j = pairs[~known][0]
        raise InvalidInputError(
            "boundary",
            f"boundary nodes {i} and {j} are not joined in the Delaunay mesh; "
            "give more boundary nodes or a larger spacing",
            pairs[~known].ravel(),
            len(pairs[~known]),
        )


def _sampled(curve: Curve, samples: int = 4096) -> FloatArray:
    """Points of a closed curve at equal steps of its parameter, (2, samples), or a MeshError."""
    points = _points(curve, np.linspace(0, 1, samples + 1))
    refuse_open(points)
    return points[:, :-1]


def _points(curve: Curve, t: FloatArray) -> FloatArray:
    """The arrays x and y, stacked, at parameters of any shape, or a MeshError."""
    if not callable(curve):
        raise InvalidInputError(
            "type", f"the curve is a {type(curve).__name__}; give a function of t that returns x and y"
        )
    points = checks.numeric(np.stack(np.broadcast_arrays(*curve(t))), "points of the curve")
    if points.shape != (2, *t.shape) or not np.isfinite(points).all():
        raise InvalidInputError("finite", "the curve must return finite x and y for every t from 0 to 1")
    return points


def _values_on_curve(function: Function, points: FloatArray) -> FloatArray:
    """Values of u(x, y) at points (2, n), as an (n,) float64 array, or a MeshError."""
    u = checks.numeric(function(*points), "values")
    if u.shape != points.shape[1:] or not np.isfinite(u).all():
        raise InvalidInputError(
            "finite", "the function must return one finite value for each point of the curve"
        )
    return u
