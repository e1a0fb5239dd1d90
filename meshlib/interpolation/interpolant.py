"""The continuous piecewise linear interpolant u_h of nodal values (chapter 2)."""

from functools import cached_property
from typing import Any

import numpy as np

from .. import checks
from .._typing import ArrayLike, FloatArray, Function, Values
from ..errors import InvalidInputError
from ..geometry import quadrature
from ..kernels import for_work
from ..kernels.element_shapes import gradient
from ..mesh.mesh import Mesh
from ..support.drawing import drawn
from .locate_by_buckets import by_buckets
from .locate_by_strips import in_strips

DEFAULT_DEGREE = 8
ROUNDING = 8 * np.finfo(float).eps  # of a coordinate, in the places where a row cuts a side
POINTS_AT_ONCE = 100_000  # of quadrature, which keeps them in nearby memory
STEPS_OF_AN_ELEMENT, POINTS_IN_A_STEP = 5, 8  # of plain Python, when a grid is filled
FILLED = 1e-9  # how far, relatively, the domain may fall short of its bounding box


class Interpolant:
    """The function that is linear on each element and equals u at the nodes.

    Parameters
    ----------
    mesh : Mesh
    values : (N,) array_like of float, or callable
        Values of u at the nodes, or a vectorised function u(x, y).

    Raises
    ------
    MeshError
        If a value is missing or not finite.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> mesh = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> u_h = Interpolant(mesh, lambda x, y: 1 + 2 * x - y)
    >>> u_h.gradients.tolist()
    [[2.0, -1.0], [2.0, -1.0]]
    >>> float(u_h(0.5, 0.25))
    1.75
    """

    def __init__(self, mesh: Mesh, values: Values) -> None:
        self.mesh = checks.a_mesh(mesh)
        self.values = checks.nodal_values(mesh, values)
        self.values.flags.writeable = False

    def __repr__(self) -> str:
        low, high = self.values.min(), self.values.max()
        return f"Interpolant({self.mesh!r}, values from {low:.6g} to {high:.6g})"

    @cached_property
    def gradients(self) -> FloatArray:
        """(T, 2) float64: the constants a, b of the plane a x + b y + c of each element."""
        return gradients(self.mesh.corners, self.values[self.mesh.elements])

    def __call__(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """Values at points, NaN outside the domain.

        Parameters
        ----------
        x, y : array_like of float
            Coordinates, broadcast against each other.

        Returns
        -------
        ndarray of float64
            Of the common shape of x and y.
        """
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        points = np.column_stack([x.ravel(), y.ravel()])
        return self._at(points).reshape(x.shape)

    def _at(self, points):
        """Values at the rows of an array of points."""
        strips = in_strips(self.mesh, points)
        if strips is not None:
            return strips.values(self.values)
        element = by_buckets(self.mesh, points)
        first = self.mesh.elements[element, 0]
        away = points - self.mesh.nodes[first]
        values = self.values[first] + (self.gradients[element] * away).sum(axis=1)
        return np.where(element < 0, np.nan, values)

    def on_grid(self, nx: int = 101, ny: int | None = None) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Values on a regular grid over the bounding box of the mesh.

        Parameters
        ----------
        nx, ny : int
            Number of points along x and y; ``ny`` is ``nx`` if left out.

        Returns
        -------
        x : (nx,) ndarray, y : (ny,) ndarray, u : (ny, nx) ndarray
            NaN outside the domain.
        """
        nx = checks.whole(nx, 2, "nx")
        ny = nx if ny is None else checks.whole(ny, 2, "ny")
        low, high = self.mesh.box
        x, y = np.linspace(low[0], high[0], nx), np.linspace(low[1], high[1], ny)
        return x, y, self._raster(low, high, nx, ny)

    def _raster(self, low, high, nx, ny):
        """Values on the grid from low to high."""
        kernels = for_work(STEPS_OF_AN_ELEMENT * self.mesh.n_elements + nx * ny // POINTS_IN_A_STEP)
        step, largest = (high - low) / (nx - 1, ny - 1), np.abs([low, high]).max(axis=0)
        slack = kernels.raster.SLACK + ROUNDING * (largest / step).max()
        values = kernels.writable(np.full(nx * ny, np.nan))
        start, cells = tuple(low.tolist()), tuple((1 / step).tolist())
        grid = kernels.raster.Grid(values, nx, ny, start, cells, float(slack))
        arrays = map(kernels.readable, (self.mesh.elements, self.mesh.nodes, self.values))
        kernels.raster.filled(grid, *arrays, float(largest.max()))
        return np.reshape(values, (ny, nx))

    def l2_error(
        self, function: Function, *, rule: str = "exact", points: int = 101, degree: int = DEFAULT_DEGREE
    ) -> float:
        """The L2 norm of u - u_h over the domain (section 4.5.1).

        Parameters
        ----------
        function : callable
            Vectorised u(x, y).
        rule : {"exact", "trapezium"}
            ``"exact"`` integrates over each element, by a quadrature that is exact for
            polynomials; ``"trapezium"`` is the rule of the thesis on a grid over the
            bounding box, for rectangular domains.
        points : int
            Number of grid points in each direction for ``"trapezium"``.
        degree : int
            Polynomial degree of (u - u_h)^2 that ``"exact"`` integrates exactly.

        Returns
        -------
        float

        Raises
        ------
        MeshError
            If an argument is out of range, the function is not finite, or the domain
            does not fill its bounding box.

        Examples
        --------
        >>> from meshlib import problems
        >>> u = problems.functions["SR3"]
        >>> u_h = Interpolant(problems.mesh("81"), u)
        >>> round(u_h.l2_error(u), 6), round(u_h.l2_error(u, rule="trapezium"), 6)
        (0.059694, 0.059697)
        """
        checks.choice(rule, ("exact", "trapezium"), "rule")
        square = self._by_quadrature(function, degree) if rule == "exact" else self._by_grid(function, points)
        if not np.isfinite(square):
            raise InvalidInputError(
                "finite", "the function is not finite everywhere in the domain; l2_error needs it to be"
            )
        return float(np.sqrt(square))

    def _by_quadrature(self, function, degree):
        return self.squared_errors(function, checks.whole(degree, 0, "degree")).sum()

    def _by_grid(self, function, points):
        x, y, error = self.error_on_grid(function, checks.whole(points, 2, "points"))
        if not np.isclose(np.ptp(x) * np.ptp(y), self.mesh.domain_area, rtol=FILLED, atol=0):
            raise InvalidInputError(
                "domain", 'the trapezium rule needs a rectangular domain; use rule="exact"'
            )
        return np.trapezoid(np.trapezoid(error**2, x, axis=1), y)

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draw lines of constant value over the mesh.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            By default the axes of a new figure.
        **options
            As for `meshlib.plotting.plot_contours`, for example ``levels=20``.

        Returns
        -------
        matplotlib.axes.Axes

        See Also
        --------
        meshlib.Mesh.plot, meshlib.plotting.plot_surface

        Examples
        --------
        >>> from matplotlib import pyplot
        >>> from meshlib import problems
        >>> ax = Interpolant(problems.mesh("33"), problems.SR2).plot(ticks=True)
        >>> len(ax.collections[-1].levels)
        10
        >>> pyplot.close(ax.figure)
        """
        return drawn("plot_contours", self, ax, options)

    def error_on_grid(
        self, function: Function, points: int = 101
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """u - u_h on a regular grid: x (points,), y (points,), error (points, points)."""
        x, y, u_h = self.on_grid(points)
        return x, y, function(x[None, :], y[:, None]) - u_h

    def squared_errors(self, function: Function, degree: int = DEFAULT_DEGREE) -> FloatArray:
        """(T,) float64: the integral of (u - u_h)^2 over each element, by quadrature."""
        return squared_errors(self.mesh.corners, self.values[self.mesh.elements], function, degree)


def gradients(corners, values):
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
    return np.column_stack(gradient(e.T, f.T, du, dv, twice_area))


def squared_errors(corners, values, function, degree):
    """Integral of (u - u_h)^2 over each element with the given corners and values."""
    found, step = np.empty(len(corners)), max(1, POINTS_AT_ONCE // len(quadrature.rule(degree)[1]))
    for start in range(0, len(corners), step):
        batch = slice(start, start + step)
        found[batch] = _squared_errors(corners[batch], values[batch], function, degree)
    return found


def _squared_errors(corners, values, function, degree):
    x, y, barycentric, weights = quadrature.points_in(corners, degree)
    error = function(x, y) - values @ barycentric.T
    e, f = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]) / 2
    return areas * (error**2 @ weights)
