"""The continuous piecewise linear interpolant u_h of nodal values (chapter 2)."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from .. import checks
from .._typing import ArrayLike, FloatArray, Function, Values
from ..errors import InvalidInputError
from ..kernels import for_work
from ..mesh.mesh import Mesh
from ..support.drawing import drawn
from .locate_by_buckets import by_buckets
from .locate_by_strips import in_strips
from .on_elements import gradients, squared_errors

DEFAULT_DEGREE = 8  # polynomial degree up to which quadrature is exact
ROUNDING = 8 * np.finfo(float).eps  # relative error of the place where a row of a grid cuts a side
STEPS_OF_AN_ELEMENT, POINTS_IN_A_STEP = 5, 8  # work of filling a grid, in steps of plain Python


class Interpolant:
    """The function that is linear on each element and equals u at the nodes.

    Parameters
    ----------
    mesh : Mesh
    values : (N,) array_like of float, or callable
        Values of u at the nodes, or a vectorised function u(x, y).

    Attributes
    ----------
    mesh : Mesh
    values : (N,) ndarray of float64
        Values of u at the nodes; read-only.

    Raises
    ------
    MeshError
        If the mesh is not valid, or a value is missing or not finite.

    See Also
    --------
    Mesh, delaunay, meshlib.plotting.plot_surface

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
            Array with the common shape of x and y.
        """
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        points = np.column_stack([x.ravel(), y.ravel()])
        return self._at(points).reshape(x.shape)

    def _at(self, points: FloatArray) -> FloatArray:
        """Values at the rows of an array of points."""
        strips = in_strips(self.mesh, points)
        if strips is not None:
            return strips.values(self.values)
        element = by_buckets(self.mesh, points)
        first = self.mesh.elements[element, 0]
        away = points - self.mesh.nodes[first]
        values = self.values[first] + (self.gradients[element] * away).sum(axis=1)
        return np.asarray(np.where(element < 0, np.nan, values))

    def on_grid(self, nx: int = 101, ny: int | None = None) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Values on a regular grid over the bounding box of the mesh.

        Parameters
        ----------
        nx, ny : int
            Number of points along x and y, at least 2; by default ``ny`` is ``nx``.

        Returns
        -------
        x : (nx,) ndarray of float64
        y : (ny,) ndarray of float64
        u : (ny, nx) ndarray of float64
            Values, NaN outside the domain.

        Raises
        ------
        MeshError
            If ``nx`` or ``ny`` is not a whole number of at least 2.

        Examples
        --------
        >>> from meshlib import delaunay
        >>> u_h = Interpolant(delaunay([[0, 0], [1, 0], [0, 1]]), [0, 2, 4])
        >>> u_h.on_grid(3)[2].tolist()
        [[0.0, 1.0, 2.0], [2.0, 3.0, nan], [4.0, nan, nan]]
        """
        nx = checks.whole(nx, 2, "nx")
        ny = nx if ny is None else checks.whole(ny, 2, "ny")
        low, high = self.mesh.box
        x, y = np.linspace(low[0], high[0], nx), np.linspace(low[1], high[1], ny)
        return x, y, self._raster(low, high, nx, ny)

    def _raster(self, low: FloatArray, high: FloatArray, nx: int, ny: int) -> FloatArray:
        """Values on a grid of ny rows and nx columns from the corner ``low`` to the corner ``high``."""
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
            In the unit of u times that of the coordinates.

        See Also
        --------
        squared_errors, error_on_grid

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
        if rule == "exact":
            square = float(self.squared_errors(function, checks.whole(degree, 0, "degree")).sum())
        else:
            square = self._by_grid(function, points)
        if not np.isfinite(square):
            raise InvalidInputError(
                "finite", "the function is not finite everywhere in the domain; l2_error needs it to be"
            )
        return float(np.sqrt(square))

    def _by_grid(self, function: Function, points: int, rounding: float = 1e-9) -> float:
        """Integral of (u - u_h)^2 by the trapezium rule, if the domain fills its box but for rounding."""
        x, y, error = self.error_on_grid(function, checks.whole(points, 2, "points"))
        if not np.isclose(np.ptp(x) * np.ptp(y), self.mesh.domain_area, rtol=rounding, atol=0):
            message = 'the trapezium rule needs a rectangular domain; use rule="exact"'
            raise InvalidInputError("domain", message)
        return float(np.trapezoid(np.trapezoid(error**2, x, axis=1), y))

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
        """The error u - u_h on a regular grid over the bounding box of the mesh.

        Parameters
        ----------
        function : callable
            Vectorised u(x, y).
        points : int
            Number of grid points in each direction, at least 2.

        Returns
        -------
        x, y : (points,) ndarray of float64
        error : (points, points) ndarray of float64
            One row for each y, NaN outside the domain.

        See Also
        --------
        on_grid, l2_error

        Examples
        --------
        >>> from meshlib import delaunay
        >>> u_h = Interpolant(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), lambda x, y: x**2)
        >>> u_h.error_on_grid(lambda x, y: x**2, points=3)[2].tolist()
        [[0.0, -0.25, 0.0], [0.0, -0.25, 0.0], [0.0, -0.25, 0.0]]
        """
        x, y, u_h = self.on_grid(points)
        return x, y, function(x[None, :], y[:, None]) - u_h

    def squared_errors(self, function: Function, degree: int = DEFAULT_DEGREE) -> FloatArray:
        """The integral of (u - u_h)^2 over each element, by quadrature.

        Parameters
        ----------
        function : callable
            Vectorised u(x, y).
        degree : int
            Polynomial degree of (u - u_h)^2 that is integrated exactly.

        Returns
        -------
        (T,) ndarray of float64

        See Also
        --------
        l2_error

        Examples
        --------
        >>> from meshlib import Mesh
        >>> u_h = Interpolant(Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]), [0, 0, 0])
        >>> u_h.squared_errors(lambda x, y: 0 * x + 3).round(12).tolist()
        [4.5]
        """
        return squared_errors(self.mesh.corners, self.values[self.mesh.elements], function, degree)
