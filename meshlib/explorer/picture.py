"""The scene of the explorer as a picture, for pages without JavaScript."""

import re
from io import BytesIO

import numpy as np

from ..plotting import WIDTH, plot_contours, plot_mesh, spaced, style, value_limits
from ..plotting.look import framed, pyplot
from ..plotting.surfaces import colours_of

DPI = 150
ERRORS = "cividis"
SHAPE = WIDTH, 0.6 * WIDTH
LETTERS, COLUMNS = 10, 6  # points and columns of each of the two tables
HEAD = 2.6  # its lines of labels, in lines of numbers
NARROW = re.compile(r",? (?!\()")  # a new line for each word, but not for a unit
STAGES = "start", "adapted"


def png(scene):
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


def figure(scene):
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


def _draw_mesh(ax, u_h, limits):
    levels = spaced(limits)
    bands = np.concatenate([[-np.inf], levels, [np.inf]])
    middles = np.linspace(*limits, len(levels) + 1)
    ax.tricontourf(
        *u_h.mesh.nodes.T, u_h.mesh.elements, u_h.values, levels=bands, colors=colours_of(middles, limits)
    )
    # White on a dark rim can be seen on every colour.
    plot_mesh(ax, u_h.mesh, colour=(0, 0, 0, 0.45), width=2, ticks=True)
    plot_mesh(ax, u_h.mesh, colour="white", ticks=True)


def _draw_error(ax, scene):
    mesh, error = scene.after.mesh, scene.after.error
    worst = max(stage.largest_error for stage in (scene.before, scene.after))
    framed(ax, mesh)
    x, y = np.linspace(*mesh.box, len(error)).T
    image = ax.pcolormesh(x, y, error, cmap=ERRORS, vmin=0, vmax=worst, shading="gouraud")
    ax.figure.colorbar(image, ax=ax, fraction=0.046, pad=0.04)


def _draw_table(ax, rows):
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
