"""Figures of section 7.1: the three splittings side by side."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ... import plotting
from ...refinement.marking import MARKS
from ...refinement.splitting import SPLITS
from ..studies import section_7_1_splittings as splittings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["splittings_compared", "splittings_meshes"]

COLOURS = dict(zip(SPLITS, (plotting.SECOND, plotting.PALETTE["black"], plotting.ACCENT), strict=True))
DASHES = dict(zip(MARKS, ("-", (0, (5, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5))), strict=True))
HEIGHT, LEGEND = 4.3, 0.7  # inches
THIN, LINE = 0.5, 1.3  # points
ANGLES = (0.02, 30)  # degrees, the range of angles that is shown


def splittings_compared() -> Figure:
    """L2 error and smallest angle against the number of nodes, a column for each function."""
    with plotting.style():
        figure, rows = _two_rows(len(splittings.FUNCTIONS))
        for above, below, function in zip(*rows, splittings.FUNCTIONS, strict=True):
            _draw(above, below, function)
            above.set_title(function)
            below.set(xlabel="nodes", ylim=ANGLES)
        rows[0, 0].set_ylabel("$L_2$ error over that at the start")
        rows[1, 0].set_ylabel("smallest angle, degrees")
        _legend(figure)
    return figure


def _two_rows(columns: int) -> tuple[Figure, np.ndarray]:
    return plotting.look.pyplot().subplots(
        2,
        columns,
        sharex=True,
        sharey="row",
        squeeze=False,
        layout="constrained",
        figsize=(plotting.WIDTH, HEIGHT + LEGEND),
    )


def _draw(above: Axes, below: Axes, function: str) -> None:
    for split, colour in COLOURS.items():
        for mark, dashes in DASHES.items():
            found = splittings.rounds(function, split, mark)
            look: dict[str, Any] = dict(color=colour, linestyle=dashes, linewidth=LINE)
            above.loglog(found.nodes, found.errors / found.errors[0], **look)
            below.loglog(found.nodes, np.maximum(found.smallest_angles, ANGLES[0] / 10), **look)
    above.axhline(splittings.AIM, color=plotting.FAINT, linewidth=LINE, zorder=0)
    for ax in (above, below):
        ax.spines[["top", "right"]].set_visible(False)
        ax.minorticks_off()


def _legend(figure: Figure) -> None:
    line = plotting.look.pyplot().Line2D
    handles = [line([], [], color=colour, linewidth=2 * LINE, label=how) for how, colour in COLOURS.items()]
    handles += [
        line([], [], color=plotting.INK, linestyle=dashes, label=f"by {mark}")
        for mark, dashes in DASHES.items()
    ]
    spacing: dict[str, Any] = dict(columnspacing=1.0, handlelength=1.9, fontsize="small")
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles), **spacing)


def splittings_meshes(function: str = "SR3") -> Figure:
    """The first mesh of at least 500 nodes of each splitting, marked by element."""
    figure, axes = plotting.panels(len(SPLITS))
    for ax, split in zip(axes, SPLITS, strict=True):
        found = splittings.rounds(function, split, "element")
        plotting.plot_mesh(ax, found.shown, width=THIN)
        ax.set_title(f"{split}, {found.shown.n_nodes} nodes")
    return figure
