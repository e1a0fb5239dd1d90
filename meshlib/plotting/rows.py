"""The standard row: mesh, surface and lines of constant value."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .._typing import ArrayLike, Function
from ..interpolation.interpolant import Interpolant
from .look import pyplot, style
from .meshes import plot_mesh
from .settings import LOOK
from .surfaces import plot_contours, plot_surface, value_limits

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Projection = str | None  # kind of axes: "3d" for a surface, None for the plane


def representation(
    interpolant: Interpolant,
    *,
    before: Interpolant | None = None,
    labels: tuple[str, str] = ("before", "after"),
    levels: int | ArrayLike = LOOK.surface.levels,
    limits: tuple[float, float] | None = None,
    view: tuple[float, float] | None = None,
    **highlights: Any,
) -> "Figure":
    """Mesh, surface and lines of constant value side by side.

    Parameters
    ----------
    interpolant : Interpolant
    before : Interpolant, optional
        Shown in a row above, with the values, colours and levels of the row below.
    labels : (str, str)
        Names of the two rows, if there are two.
    levels : int or array_like of float
        Number of lines of constant value, or their values; see `plot_contours`.
    limits : (float, float), optional
        Values at the ends of the vertical axis and of the colours; by default the
        smallest and the largest nodal value of both interpolants.
    view : (float, float), optional
        Elevation and azimuth of the eye in degrees; see `plot_surface`.
    **highlights
        ``elements``, ``edges``, ``nodes`` or ``numbers`` of `plot_mesh`, for the
        mesh of ``interpolant``.

    Returns
    -------
    matplotlib.figure.Figure
        With three axes in each row.

    See Also
    --------
    function_view : Surface and lines of a function without a mesh.
    plot_mesh, plot_surface, plot_contours : The single pictures.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import Interpolant, problems
    >>> figure = representation(Interpolant(problems.mesh("33"), problems.functions["SR1"]))
    >>> len(figure.axes)
    3
    >>> plt.close(figure)
    """
    shown = [interpolant] if before is None else [before, interpolant]
    limits = value_limits(*shown, limits=limits)
    with style():
        figure, rows = _rows(len(shown), (None, "3d", None))
        for (flat, solid, lines), u_h in zip(rows, shown, strict=True):
            plot_mesh(flat, u_h.mesh, ticks=True, **(highlights if u_h is interpolant else {}))
            plot_surface(solid, u_h, limits=limits, view=view)
            plot_contours(lines, u_h, levels=levels, limits=limits, ticks=True)
        if before is not None:
            for (flat, *_), label in zip(rows, labels, strict=True):
                flat.set_ylabel(label)
    return figure


def function_view(
    function: Function,
    *,
    levels: int | ArrayLike = LOOK.surface.levels,
    limits: tuple[float, float] | None = None,
    view: tuple[float, float] | None = None,
) -> "Figure":
    """Surface and lines of constant value of a function on the unit square.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    levels : int or array_like of float
        Number of lines of constant value, or their values; see `plot_contours`.
    limits : (float, float), optional
        Values at the ends of the vertical axis and of the colours; by default the
        smallest and the largest value of the function.
    view : (float, float), optional
        Elevation and azimuth of the eye in degrees; see `plot_surface`.

    Returns
    -------
    matplotlib.figure.Figure
        With two axes.

    See Also
    --------
    representation : An interpolant and its mesh.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import problems
    >>> figure = function_view(problems.functions["DD1"])
    >>> len(figure.axes)
    2
    >>> plt.close(figure)
    """
    limits = value_limits(function, limits=limits)
    with style():
        figure, ((solid, lines),) = _rows(1, ("3d", None))
        plot_surface(solid, function, limits=limits, view=view)
        plot_contours(lines, function, levels=levels, limits=limits, ticks=True)
    return figure


def _rows(count: int, kinds: Sequence[Projection]) -> "tuple[Figure, list[list[Any]]]":
    """A figure with axes of the given kinds in each row; a row of three is as wide as the page."""
    page = LOOK.page
    share = {None: 1.0, "3d": page.surface_share}
    widths = [share[kind] for kind in kinds]
    width = page.width * sum(widths) / (2 + page.surface_share)
    figure = pyplot().figure(figsize=(width, count * page.row_height * page.width))
    grid = figure.add_gridspec(
        count,
        len(kinds),
        width_ratios=widths,
        left=page.left,
        right=page.right,
        bottom=page.below / count,
        top=1 - page.above / count,
        wspace=page.between_panels,
        hspace=page.between_rows,
    )
    return figure, [
        [figure.add_subplot(grid[row, column], projection=kind) for column, kind in enumerate(kinds)]
        for row in range(count)
    ]
