"""Figures of chapter 5: start meshes, and what swapping, refining and moving make of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import plotting
from ..studies.experiments import run
from .adapted import DOT, DOUBLE, HEAVY, refined, started, swapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "figure_5_1",
    "figure_5_2",
    "figure_5_3",
    "figure_5_4",
    "figure_5_5",
    "figure_5_6",
    "figure_5_7",
    "figure_5_8",
    "figure_5_9",
    "figure_5_10",
    "figure_5_11",
    "figure_5_12",
    "figure_5_13",
    "figure_5_14",
    "figure_5_15",
    "figure_5_16",
    "figure_5_17",
]

SINGLE = 4.0  # inches


def figure_5_1() -> Figure:
    """SR1 on the start mesh of the 33 nodes."""
    return started("SR1-33")


def figure_5_2() -> Figure:
    """SR2 on the start mesh of the 33 nodes."""
    return started("SR2-33")


def figure_5_3() -> Figure:
    """SR1 on the start mesh of the 81 nodes."""
    return started("SR1-81")


def figure_5_4() -> Figure:
    """SR2 on the start mesh of the 81 nodes."""
    return started("SR2-81")


def figure_5_5() -> Figure:
    """SR3 on the start mesh of the 81 nodes."""
    return started("SR3-81")


def figure_5_6() -> Figure:
    """The start mesh for DD1, with the edges of the 33-node mesh that it refines."""
    coarse, fine = run("start-33").start, run("start-33-refined").start
    figure, (ax,) = plotting.panels(size=SINGLE)
    plotting.plot_mesh(ax, fine)
    plotting.plot_mesh(ax, coarse, colour=plotting.SECOND, width=HEAVY)
    return figure


def figure_5_7() -> Figure:
    """DD1 on the refined start mesh of the 33 nodes."""
    return started("DD1-33-refined")


def figure_5_8() -> Figure:
    """SR2 on the 81 nodes, edges swapped by JND-L2."""
    return swapped("SR2-81-JND-L2")


def figure_5_9() -> Figure:
    """SR3 on the 81 nodes, edges swapped by JND-L2."""
    return swapped("SR3-81-JND-L2")


def figure_5_10() -> Figure:
    """SR1 on the 33 nodes, edges swapped by ABN-L2."""
    return swapped("SR1-33-ABN-L2")


def figure_5_11() -> Figure:
    """SR1 on the 33 nodes, edges swapped by ABN-L1."""
    return swapped("SR1-33-ABN-L1")


def figure_5_12() -> Figure:
    """SR2 on the 33 nodes, edges swapped by ABN-L1."""
    return swapped("SR2-33-ABN-L1")


def figure_5_13() -> Figure:
    """DD1 on the refined 33-node mesh, edges swapped by ABN-L2."""
    return swapped("DD1-33-refined-ABN-L2")


def figure_5_14() -> Figure:
    """SR1 on the 81 nodes, a fifth of the elements refined by edge."""
    return refined("SR1-81-by-edge")


def figure_5_15() -> Figure:
    """SR1 on the 33 nodes, a fifth of the elements refined by edge."""
    return refined("SR1-33-by-edge")


def figure_5_16() -> Figure:
    """SR1 on the 33 nodes, a fifth of the elements refined by element."""
    return refined("SR1-33-by-element")


def figure_5_17() -> Figure:
    """The 33-node mesh after Laplacian smoothing, with lines from old to new places of its nodes."""
    found = run("smoothed-33")
    start, end, inner = found.start, found.mesh, np.flatnonzero(~found.start.boundary_nodes)
    figure, axes = plotting.panels(2, size=DOUBLE)
    for ax, mesh, label in zip(axes, (start, end), ("start", "smoothed"), strict=True):
        plotting.plot_mesh(ax, mesh)
        ax.set_title(label)
        plotting.mark_nodes(ax, start, inner, colour=plotting.SECOND, size=DOT)
    draw_ways(axes[1], start.nodes[inner], end.nodes[inner])
    plotting.mark_nodes(axes[1], end, inner, colour=plotting.ACCENT, size=DOT)
    return figure


def draw_ways(ax: Axes, old: np.ndarray, new: np.ndarray) -> None:
    """Lines from the old to the new places of nodes."""
    x, y = np.stack([old, new]).transpose(2, 0, 1)
    ax.plot(x, y, color=plotting.ACCENT, linewidth=HEAVY)
