"""The look of all figures: colours, sizes, and empty panels."""

from contextlib import contextmanager

from ..errors import missing_extra

# Okabe and Ito's palette, which readers with any kind of colour vision can tell apart.
PALETTE = {
    "black": "#000000",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "green": "#009E73",
    "yellow": "#F0E442",
    "blue": "#0072B2",
    "vermillion": "#D55E00",
    "purple": "#CC79A7",
}
INK, FAINT = "#3a3a3a", "#c4c4c4"  # edges of the mesh itself, and of a mesh in the background
SHADE, ACCENT, SECOND = PALETTE["yellow"], PALETTE["vermillion"], PALETTE["blue"]
VALUES, BRIGHTEST = "viridis", 0.9  # the end of viridis is too bright for lines on white

WIDTH = 9.0  # inches; 800 pixels on the page
RESOLUTION = 120
EDGE_WIDTH, THICK = 0.9, 2.2  # points
FONT_SIZE = 10
MARGIN = 0.03  # around a mesh, relative to its extent
TICKS, TICK_DIGITS = 3, 9

RC = {
    "figure.dpi": RESOLUTION,
    "savefig.dpi": RESOLUTION,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "axes.facecolor": "white",
    "text.color": "black",
    "font.size": FONT_SIZE,
    "font.family": "DejaVu Sans",
    "axes.titlesize": FONT_SIZE,
    "axes.labelsize": FONT_SIZE,
    "xtick.labelsize": FONT_SIZE - 1,
    "ytick.labelsize": FONT_SIZE - 1,
    "axes.edgecolor": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "axes.grid": False,
    "svg.hashsalt": "meshlib",
}


def pyplot():
    """The module matplotlib.pyplot, or the error that names the extra."""
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise missing_extra("matplotlib", "plot") from error
    return matplotlib.pyplot


@contextmanager
def style():
    """Context, or decorator, in which figures look alike; also white in dark mode.

    Examples
    --------
    >>> import matplotlib
    >>> with style():
    ...     matplotlib.rcParams["figure.facecolor"]
    'white'
    """
    settings = pyplot().rcParams
    before = {name: settings[name] for name in RC}
    settings.update(RC)
    try:
        yield
    finally:  # rc_context would also take back what a notebook sets up at its first figure
        settings.update(before)


def panels(count=1, size=None, labels=False, rows=1):
    """A figure with square panels in rows.

    Parameters
    ----------
    count : int
        Number of panels.
    size : float, optional
        Side of a panel in inches; by default three of them fill the page.
    labels : bool
        Whether to letter the panels (a), (b), ...
    rows : int

    Returns
    -------
    figure : matplotlib.figure.Figure
    axes : (count,) ndarray of matplotlib.axes.Axes

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
        for ax, letter in zip(axes.flat, "abcdefgh" if labels else "", strict=False):
            ax.set_title(f"({letter})", loc="left")
    return figure, axes.ravel()[:count]


def bare(ax, mesh):
    """Equal scales along x and y around a mesh, and no frame; returns the axes."""
    low, high = mesh.box
    margin = MARGIN * (high - low).max()
    ax.set(aspect="equal", xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    ax.axis("off")
    return ax


def framed(ax, mesh):
    """As `bare`, but with coordinates along two sides; returns the axes."""
    bare(ax, mesh).axis("on")
    ax.spines[:].set_visible(False)
    for axis, column in zip((ax.xaxis, ax.yaxis), mesh.nodes.T, strict=True):
        axis.set_ticks(*round_ticks(column.min(), column.max()))
    ax.tick_params(length=2, pad=2)
    return ax


def round_ticks(low, high):
    """About three round numbers from low to high, and their labels."""
    from matplotlib.ticker import MaxNLocator

    slack = MARGIN * (high - low)  # an end of 1e-8 still is 0 to the eye
    ticks = MaxNLocator(TICKS, steps=[1, 2, 5, 10]).tick_values(low - slack, high + slack)
    ticks = ticks[(ticks >= low - slack) & (ticks <= high + slack)]
    return ticks.clip(low, high), [f"{tick:g}" for tick in ticks.round(TICK_DIGITS)]
