r"""Nodes along a smooth closed boundary, and start meshes of the domain inside (section 7.2).

A curve is a function of a parameter t from 0 to 1 that returns the arrays x and y, with the
same point at both ends.  Chords between nodes on it leave slivers::

          . - ~ ~ ~ - .
        .               .       an arc of length h and curvature k
       s_i ----------- s_i+1    above its chord: a sliver of area k h^3 / 12

The total is least where the integral of k^(1/3) is the same between any two neighbours: a
mesh problem in one dimension, cut open at t = 0.  `boundary_parameters` solves it; what it
returns goes, with the curve, into `deviation` and `domain_mesh`.
"""

import numpy as np

from . import checks
from .errors import InvalidInputError, InvalidMeshError
from .geometry.polygons import inside, lattice_inside
from .mesh.delaunay import delaunay
from .mesh.mesh import Mesh

DENSITIES = ("curvature", "length", "parameter")
SAMPLES = 4096  # of the curve, along which the density is integrated
CLOSED = 1e-9  # gap between both ends of a curve, relative to its extent
PER_ARC = 256  # parts of an arc, over which a sliver is integrated
DATA_POWER, CURVATURE_POWER = 2 / 5, 1 / 3
NOISE = 8  # units of rounding in a second difference
SMALLEST_RING = 3


def equidistributed(density, n):
    """Parameters between which a periodic density has the same integral.

    Parameters
    ----------
    density : (m,) array_like of float
        Values of at least 0 at the parameters 0, 1/m, 2/m, ...
    n : int

    Returns
    -------
    (n,) ndarray of float64
        Ascending from 0, where the period is cut open.

    Raises
    ------
    MeshError
        If a value is negative or not finite, or all are 0.

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


def boundary_parameters(curve, n, density="curvature", even=0.0):
    """Parameters of n nodes along a closed curve.

    Parameters
    ----------
    curve : callable
        Vectorised: t from 0 to 1 to the arrays x and y.
    n : int
        At least 3.
    density : {"curvature", "length", "parameter"} or callable
        What is the same between any two neighbours: the integral over the arc length s of
        ``|k|^(1/3)``, which makes the area between curve and polygon least; the arc
        length; the parameter; or for a function u(x, y) the integral of
        ``|u_ss|^(2/5)``, which makes the L2 error of linear interpolation along the
        curve least.
    even : float
        Share of the nodes, from 0 to 1, that is spread evenly over the arc length
        whatever the density is, so that straight stretches get some as well.

    Returns
    -------
    (n,) ndarray of float64
        Ascending from 0.

    Raises
    ------
    MeshError
        If the curve is not closed or not finite, or an argument out of range.

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
    speed = np.hypot(*_derivative(points))
    if callable(density):
        found = _of_data(points, speed, density)
    else:
        found = _OF_CURVE[checks.choice(density, DENSITIES, "density")](points, speed)
    if even == 1:
        return equidistributed(speed, n)
    return equidistributed((1 - even) * found / (found.mean() or 1) + even * speed / speed.mean(), n)


def deviation(curve, parameters):
    """Area between a closed curve and the polygon with nodes at the given parameters.

    Parameters
    ----------
    curve : callable
        As for `boundary_parameters`.
    parameters : (n,) array_like of float
        At least 3, ascending, within one period.

    Returns
    -------
    float
        Slivers inside and outside both count with their size.

    Raises
    ------
    MeshError
        If the parameters are too few or do not ascend within one period.

    Examples
    --------
    Of a circle around a square:

    >>> def circle(t):
    ...     return np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)
    >>> round(deviation(circle, [0, 0.25, 0.5, 0.75]), 3), round(np.pi - 2, 3)
    (1.142, 1.142)
    """
    start = _ascending(curve, parameters)
    end = np.append(start[1:], start[0] + 1)
    t = start[:, None] + (end - start)[:, None] * np.linspace(0, 1, PER_ARC + 1)
    x, y = _points(curve, t % 1)
    chord = np.stack([x[:, -1] - x[:, 0], y[:, -1] - y[:, 0]])[..., None]
    away = np.stack([x - x[:, :1], y - y[:, :1]])
    along = (away * chord).sum(axis=0)
    height = np.abs(chord[0] * away[1] - chord[1] * away[0])
    slivers = ((height[:, 1:] + height[:, :-1]) / 2 * np.diff(along)).sum(axis=1)
    return float((slivers / (chord**2).sum(axis=0)[:, 0]).sum())


def domain_mesh(curve, parameters, spacing=None):
    """A start mesh of the domain inside a closed curve.

    Parameters
    ----------
    curve : callable
        As for `boundary_parameters`; it goes round counter-clockwise.
    parameters : (n,) array_like of float
        Of the boundary nodes: at least 3, ascending, within one period.
    spacing : float, optional
        Of the inner nodes, which form a lattice of equilateral triangles; by default the
        mean length of the boundary edges.

    Returns
    -------
    Mesh
        The first n nodes are those along the curve.

    Raises
    ------
    MeshError
        If the parameters are too few or do not ascend within one period, the curve goes
        round clockwise or crosses itself, or an edge of the boundary is no Delaunay edge.

    Notes
    -----
    The Delaunay mesh of boundary and inner nodes covers their convex hull.  For a convex
    domain this is all.  For another one the elements outside the polygon are left out,
    which is possible if every edge of the polygon is an edge of that mesh; enough boundary
    nodes, close together where two parts of the boundary are near each other, see to it.

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


def _ascending(curve, parameters):
    """Parameters of nodes in order along a closed curve, or a MeshError."""
    _sampled(curve)
    t = checks.numeric(parameters, "parameters")
    if t.ndim != 1 or len(t) < SMALLEST_RING:
        raise InvalidInputError(
            "shape",
            f"parameters have shape {t.shape}; give one number for each of at least {SMALLEST_RING} nodes",
        )
    bad = np.flatnonzero(~(np.diff(t, append=t[0] + 1) > 0))
    if bad.size:
        k = (bad[0] + 1) % len(t)
        raise InvalidInputError(
            "order",
            f"parameter {k} is {t[k]:g}, which does not follow {t[bad[0]]:g}; "
            "give them ascending, within one period",
            (k,),
        )
    return t


def _refuse_missing(mesh, n):
    """Raise a MeshError that names an edge between the first n nodes that the mesh does not have."""
    pairs = np.sort(np.column_stack([np.arange(n), (np.arange(n) + 1) % n]), axis=1)
    known = np.isin(pairs @ [mesh.n_nodes, 1], mesh.edges.astype(np.int64) @ [mesh.n_nodes, 1])
    if not known.all():
        i, j = pairs[~known][0]
        raise InvalidInputError(
            "boundary",
            f"boundary nodes {i} and {j} are not joined in the Delaunay mesh; "
            "give more boundary nodes or a larger spacing",
            (i, j),
        )


# -- densities --------------------------------------------------------------------------


def _sampled(curve):
    """Points (2, SAMPLES) of a closed curve at equal steps of its parameter, or a MeshError."""
    points = _points(curve, np.linspace(0, 1, SAMPLES + 1))
    if np.abs(points[:, -1] - points[:, 0]).max() > CLOSED * np.ptp(points, axis=1).max():
        raise InvalidInputError(
            "closed",
            f"the curve is at {_text(points[:, 0])} for t = 0 and at "
            f"{_text(points[:, -1])} for t = 1; give a closed one",
        )
    return points[:, :-1]


def _points(curve, t):
    """The arrays x and y, stacked, at parameters of any shape, or a MeshError."""
    if not callable(curve):
        raise InvalidInputError(
            "type", f"the curve is a {type(curve).__name__}; give a function of t that returns x and y"
        )
    points = checks.numeric(np.stack(np.broadcast_arrays(*curve(t))), "points of the curve")
    if points.shape != (2, *t.shape) or not np.isfinite(points).all():
        raise InvalidInputError("finite", "the curve must return finite x and y for every t from 0 to 1")
    return points


def _text(point):
    return "({:g}, {:g})".format(*point)


def _derivative(values):
    """Periodic central difference along the last axis."""
    return (np.roll(values, -1, axis=-1) - np.roll(values, 1, axis=-1)) * values.shape[-1] / 2


def _second(values):
    return (np.roll(values, -1, axis=-1) - 2 * values + np.roll(values, 1, axis=-1)) * values.shape[-1] ** 2


def _of_curvature(points, speed):
    """|k|^(1/3) ds/dt, in which the speed cancels: the affine arc length."""
    (x, y), (xx, yy) = _derivative(points), _second(points)
    return _above_noise(x * yy - y * xx, points * speed) ** CURVATURE_POWER


def _above_noise(second, values):
    """Size of second differences, 0 where they are but the rounding of such values."""
    noise = NOISE * np.finfo(float).eps * SAMPLES**2 * np.abs(values).max()
    return np.where(np.abs(second) > noise, np.abs(second), 0)


_OF_CURVE = {
    "curvature": _of_curvature,
    "length": lambda points, speed: speed,
    "parameter": lambda points, speed: np.ones_like(speed),
}


def _of_data(points, speed, function):
    """|u_ss|^(2/5) ds/dt, with u_ss = (u_tt - u_t speed_t / speed) / speed^2."""
    u = checks.numeric(function(*points), "values")
    if u.shape != speed.shape or not np.isfinite(u).all():
        raise InvalidInputError(
            "finite", "the function must return one finite value for each point of the curve"
        )
    u_ss = (_second(u) - _derivative(u) * _derivative(speed) / speed) / speed**2
    return _above_noise(u_ss, u / speed**2) ** DATA_POWER * speed
