"""The standard row: mesh, surface and lines of constant value."""

from .look import WIDTH, pyplot, style
from .meshes import plot_mesh
from .surfaces import LEVELS, plot_contours, plot_surface, value_limits

ROW = FLAT, SOLID, FLAT = None, "3d", None  # kinds of axes
SHARES = {FLAT: 1, SOLID: 1.25}  # of the width
ROW_HEIGHT = 0.3 * WIDTH


def representation(
    interpolant, before=None, labels=("before", "after"), levels=LEVELS, limits=None, view=None, **highlights
):
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
        figure, rows = _rows(len(shown), ROW)
        for (flat, solid, lines), u_h in zip(rows, shown, strict=True):
            plot_mesh(flat, u_h.mesh, ticks=True, **(highlights if u_h is interpolant else {}))
            plot_surface(solid, u_h, limits, view)
            plot_contours(lines, u_h, levels, limits, ticks=True)
        if before is not None:
            for (flat, *_), label in zip(rows, labels, strict=True):
                flat.set_ylabel(label)
    return figure


def function_view(function, levels=LEVELS, limits=None, view=None):
    """Surface and lines of constant value of a function on the unit square.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    levels, limits, view
        See `plot_contours` and `plot_surface`.

    Returns
    -------
    matplotlib.figure.Figure

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
        figure, ((solid, lines),) = _rows(1, ROW[1:])
        plot_surface(solid, function, limits, view)
        plot_contours(lines, function, levels, limits, ticks=True)
    return figure


def _rows(count, kinds):
    """A figure with axes of the given kinds in each row."""
    shares = [SHARES[kind] for kind in kinds]
    width = WIDTH * sum(shares) / sum(SHARES[kind] for kind in ROW)
    figure = pyplot().figure(figsize=(width, count * ROW_HEIGHT))
    grid = figure.add_gridspec(
        count,
        len(kinds),
        width_ratios=shares,
        left=0.05,
        right=0.98,
        bottom=0.09 / count,
        top=1 - 0.03 / count,
        wspace=0.2,
        hspace=0.15,
    )
    return figure, [
        [figure.add_subplot(grid[row, column], projection=kind) for column, kind in enumerate(kinds)]
        for row in range(count)
    ]
