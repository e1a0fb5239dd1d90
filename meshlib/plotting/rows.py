"""The standard row: mesh, surface and lines of constant value."""
from .look import WIDTH, pyplot, style
from .meshes import plot_mesh
from .surfaces import LEVELS, VIEW, plot_contours, plot_surface, value_limits


def representation(interpolant, before=None, labels=("before", "after"), levels=LEVELS, limits=None,
                   view=VIEW, **highlights):
    """Mesh, surface and lines of constant value side by side.

    Parameters
    ----------
    interpolant : Interpolant
    before : Interpolant, optional
        Shown in a row above, with the same values, colours and levels.
    labels : (str, str)
        Names of the two rows, if there are two.
    levels, limits, view
        See `plot_contours` and `plot_surface`.
    **highlights
        ``elements``, ``edges``, ``nodes`` or ``numbers`` of `plot_mesh`, for the
        mesh of ``interpolant``.

    Returns
    -------
    matplotlib.figure.Figure

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
        figure, rows = _rows(len(shown))
        for (flat, solid, lines), u_h in zip(rows, shown, strict=True):
            plot_mesh(flat, u_h.mesh, ticks=True, **(highlights if u_h is interpolant else {}))
            plot_surface(solid, u_h, limits, view)
            plot_contours(lines, u_h, levels, limits, ticks=True)
        if before is not None:
            for (flat, *_), label in zip(rows, labels, strict=True):
                flat.set_ylabel(label)
    return figure


def _rows(count):
    """A figure with flat, solid and flat axes in each row."""
    height = 0.3 * WIDTH
    figure = pyplot().figure(figsize=(WIDTH, count * height))
    grid = figure.add_gridspec(count, 3, width_ratios=(1, 1.25, 1), left=0.05, right=0.98,
                               bottom=0.09 / count, top=1 - 0.03 / count, wspace=0.2, hspace=0.15)
    kinds = (None, "3d", None)
    return figure, [[figure.add_subplot(grid[row, column], projection=kind)
                     for column, kind in enumerate(kinds)] for row in range(count)]
