"""The scene of the explorer as a picture, for pages without JavaScript."""

import re
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from ..interpolation.interpolant import Interpolant
from ..plotting import WIDTH, plot_contours, plot_mesh, spaced, style, value_limits
from ..plotting.look import framed, pyplot
from ..plotting.surfaces import colours_of
from .scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 150  # pixels per inch
ERRORS = "cividis"  # colours of errors
SHAPE = WIDTH, 0.6 * WIDTH  # inches
LETTERS = 10  # points, the size of the letters in a table
COLUMNS = 6  # columns of the first of two tables
HEAD = 2.6  # height of the labels above a table, in lines of numbers
NARROW = re.compile(r",? (?!\()")  # where a label breaks: before each word, but not before a unit
STAGES = "start", "adapted"


def png(scene: Scene) -> bytes:
    """The picture of `figure` as a PNG file.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    bytes
    """
    file = BytesIO()
    with style():
        drawn = figure(scene)
        drawn.savefig(file, format="png", dpi=DPI)
        pyplot().close(drawn)
    return file.getvalue()


def figure(scene: Scene) -> "Figure":
    """Adapted mesh over its interpolant, lines of constant value, error, and the quality table.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    matplotlib.figure.Figure
    """
    limits = value_limits(scene.before.interpolant, scene.after.interpolant)
    drawn = pyplot().figure(figsize=SHAPE, layout="constrained")
    axes = drawn.subplot_mosaic(
        [["mesh", "lines", "error"], ["counts"] * 3, ["shapes"] * 3], height_ratios=(3.2, 1, 1)
    )
    drawn.suptitle(scene.title, fontsize="medium")
    _draw_mesh(axes["mesh"], scene.after.interpolant, limits)
    plot_contours(axes["lines"], scene.after.interpolant, limits=limits, ticks=True)
    _draw_error(axes["error"], scene)
    _draw_table(axes["counts"], scene.rows[:COLUMNS])
    _draw_table(axes["shapes"], scene.rows[COLUMNS:])
    for name, title in (
        ("mesh", "mesh over the interpolant"),
        ("lines", "lines of constant value"),
        ("error", "error |u − u$_h$|"),
    ):
        axes[name].set_title(title)
    return drawn


def _draw_mesh(ax: Any, u_h: Interpolant, limits: tuple[float, float]) -> None:
    levels = spaced(limits)
    bands = np.concatenate([[-np.inf], levels, [np.inf]])
    middles = np.linspace(*limits, len(levels) + 1)
    ax.tricontourf(
        *u_h.mesh.nodes.T, u_h.mesh.elements, u_h.values, levels=bands, colors=colours_of(middles, limits)
    )
    # White on a dark rim can be seen on every colour.
    plot_mesh(ax, u_h.mesh, colour=(0, 0, 0, 0.45), width=2, ticks=True)
    plot_mesh(ax, u_h.mesh, colour="white", ticks=True)


def _draw_error(ax: Any, scene: Scene) -> None:
    mesh, error = scene.after.mesh, scene.after.error
    worst = max(stage.largest_error for stage in (scene.before, scene.after))
    framed(ax, mesh)
    low, high = mesh.box
    x, y = np.linspace(low, high, len(error)).T
    image = ax.pcolormesh(x, y, error, cmap=ERRORS, vmin=0, vmax=worst, shading="gouraud")
    ax.figure.colorbar(image, ax=ax, fraction=0.046, pad=0.04)


def _draw_table(ax: Any, rows: list[tuple[str, str, str]]) -> None:
    ax.axis("off")
    labels, *columns = zip(*rows, strict=True)
    table = ax.table(
        cellText=columns,
        rowLabels=STAGES,
        bbox=(0.06, 0, 0.94, 1),
        edges="B",
        colLabels=[NARROW.sub("\n", label) for label in labels],
    )
    table.auto_set_font_size(False)
    table.set_fontsize(LETTERS)
    for (row, column), cell in table.get_celld().items():
        cell.set(edgecolor="lightgrey", height=HEAD if row == 0 else 1)
        cell.set_text_props(ha="left" if column < 0 else "center")
