"""The look of the library for figures, and empty panels that have it."""

from collections.abc import Iterator
from contextlib import contextmanager
from string import ascii_lowercase
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from .._typing import FloatArray, NDArray
from ..errors import missing_extra
from ..mesh.mesh import Mesh
from .settings import LOOK, WIDTH

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def pyplot() -> ModuleType:
    """The module matplotlib.pyplot, or the error that names the extra."""
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise missing_extra("matplotlib", "plot") from error
    return matplotlib.pyplot


@contextmanager
def style() -> Iterator[None]:
    """Context, or decorator, in which matplotlib draws in the look of the library.

    Figures are white in dark mode too.  At the end of the context the settings
    that it changed are what they were before.

    Raises
    ------
    ImportError
        If matplotlib is not installed.

    See Also
    --------
    panels : A figure in this look.
    Look : The values behind it.

    Examples
    --------
    >>> import matplotlib
    >>> with style():
    ...     matplotlib.rcParams["figure.facecolor"]
    'white'
    """
    current, ours = pyplot().rcParams, LOOK.settings()
    before = {name: current[name] for name in ours}
    current.update(ours)
    try:
        yield
    finally:  # rc_context would also take back what a notebook sets up at its first figure
        current.update(before)


def panels(
    count: int = 1, *, size: float | None = None, labels: bool = False, rows: int = 1
) -> "tuple[Figure, NDArray[Any]]":
    """A figure with square panels in rows.

    Parameters
    ----------
    count : int
        Number of panels.
    size : float, optional
        Side of a panel in inches; by default three panels fill the page.
    labels : bool
        Whether to letter the panels (a), (b), ...
    rows : int
        Number of rows into which the panels are divided.

    Returns
    -------
    figure : matplotlib.figure.Figure
    axes : (count,) ndarray of matplotlib.axes.Axes
        The panels, row by row.

    Raises
    ------
    ImportError
        If matplotlib is not installed.

    See Also
    --------
    plot_mesh, plot_contours : Draw in a panel.
    style : The look for figures made elsewhere.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> figure, axes = panels(2, labels=True)
    >>> [ax.get_title(loc="left") for ax in axes]
    ['(a)', '(b)']
    >>> plt.close(figure)
    """
    side, columns = size or WIDTH / 3, -(-count // rows)
    with style():
        figure, axes = pyplot().subplots(
            rows, columns, squeeze=False, layout="constrained", figsize=(columns * side, rows * side)
        )
        for ax, letter in zip(axes.flat, ascii_lowercase if labels else "", strict=False):
            ax.set_title(f"({letter})", loc="left")
    return figure, axes.ravel()[:count]


def bare(ax: "Axes", mesh: Mesh) -> "Axes":
    """Equal scales along x and y around a mesh, and no frame.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    See Also
    --------
    framed : With coordinates.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import problems
    >>> figure, (ax,) = panels()
    >>> [round(float(x), 2) for x in bare(ax, problems.mesh("33")).get_xlim()]
    [-0.03, 1.03]
    >>> plt.close(figure)
    """
    low, high = mesh.box
    margin = LOOK.page.margin * (high - low).max()
    ax.set(aspect="equal", xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    ax.axis("off")
    return ax


def framed(ax: "Axes", mesh: Mesh) -> "Axes":
    """Equal scales along x and y around a mesh, with coordinates along two sides.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh

    Returns
    -------
    matplotlib.axes.Axes
        The axes that were given.

    See Also
    --------
    bare : Without coordinates.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import problems
    >>> figure, (ax,) = panels()
    >>> [tick.get_text() for tick in framed(ax, problems.mesh("33")).get_xticklabels()]
    ['0', '0.5', '1']
    >>> plt.close(figure)
    """
    bare(ax, mesh).axis("on")
    ax.spines[:].set_visible(False)
    for axis, column in zip((ax.xaxis, ax.yaxis), mesh.nodes.T, strict=True):
        axis.set_ticks(*round_ticks(column.min(), column.max()))
    ax.tick_params(length=LOOK.text.tick_length, pad=LOOK.text.tick_pad)
    return ax


def round_ticks(low: float, high: float) -> tuple[FloatArray, list[str]]:
    """About three round numbers from low to high, and their labels."""
    from matplotlib.ticker import MaxNLocator

    slack = LOOK.page.margin * (high - low)  # an end of 1e-8 looks like 0
    locator = MaxNLocator(LOOK.text.ticks, steps=[1, 2, 5, 10])
    ticks = np.asarray(locator.tick_values(low - slack, high + slack))
    ticks = ticks[(ticks >= low - slack) & (ticks <= high + slack)]
    return ticks.clip(low, high), [f"{tick:g}" for tick in ticks.round(LOOK.text.tick_digits)]
