"""Figures of section 7.7: efficiencies, meshes, and what thin elements cost a solver."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import Interpolant, plotting
from ..studies import section_7_7a_limit as limit
from ..studies import section_7_7b_conditioning as conditioning

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["conditioned", "directed", "efficient", "gallery", "terrain_and_hole"]

COLOURS = {
    name: plotting.PALETTE[colour]
    for name, colour in zip(limit.FUNCTIONS, ("blue", "green", "vermillion", "black"), strict=True)
}
MARKERS = "osv^D*X"
GALLERY = "ring", "DD1", "Franke"
FEW = limit.DIRECTED_NODES[0]  # nodes at which single elements can be seen
DOTS = 10, 5  # points, so that a dot is seen behind another
FINE, HAIR = 0.5, 0.3  # points, widths of an edge and of the outline of a marker
TALL, LOW = 3.6, 3.1  # inches
CONTOURS = 9
RELIEF = 3.0  # slope that is lit half way to the brightest, in mean slopes of the terrain
GREYS = "gray"
EFFICIENCIES = (0.8, 1, 1.5, 2, 3, 5, 10, 20, 50, 100)  # ticks


def efficient() -> Figure:
    """Error times elements over the limit, against the number of nodes; dashed on lattices."""
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(plotting.WIDTH, TALL)
    for (name, colour), marker in zip(COLOURS.items(), MARKERS, strict=False):
        found, lattice = limit.efficiencies(name)
        dashed = dict(linestyle=(0, (2, 2)), linewidth=1, markersize=4, markerfacecolor="white")
        ax.loglog(limit.NODES, lattice, color=colour, marker=marker, **dashed)
        ax.loglog(limit.NODES, found, color=colour, marker=marker, markersize=5, label=name)
    ax.axhline(1, color=plotting.INK, linewidth=1, zorder=0)
    place = dict(xycoords=("axes fraction", "data"), textcoords="offset points")
    ax.annotate("limit", (1, 1), (4, 0), va="center", **place)
    _ticks(ax, limit.NODES, EFFICIENCIES)
    ax.set(xlabel="nodes", ylabel="error · elements / B")
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=len(COLOURS))
    return figure


def _ticks(ax: Axes, x: Sequence[float], y: Sequence[float]) -> None:
    """Ticks at the given numbers and nowhere else, along logarithmic axes."""
    ax.minorticks_off()
    ax.set_xticks(x, [f"{tick:g}" for tick in x])
    ax.set_yticks(y, [f"{tick:g}" for tick in y])
    ax.spines[["top", "right"]].set_visible(False)


def gallery() -> Figure:
    """Meshes made for three functions, and lines of constant value below them."""
    figure, axes = plotting.panels(2 * len(GALLERY), rows=2)
    for (above, below), name in zip(axes.reshape(2, -1).T, GALLERY, strict=True):
        mesh = limit.made(name).mesh
        plotting.plot_mesh(above, mesh, width=FINE)
        above.set_title(f"{name}, {mesh.n_nodes} nodes")
        plotting.plot_contours(below, Interpolant(mesh, limit.FUNCTIONS[name]), levels=CONTOURS)
    return figure


def terrain_and_hole() -> Figure:
    """Samples of terrain as a relief, the mesh made for them, and a mesh around a hole."""
    figure, (relief, flat, hole) = plotting.panels(3)
    ground = limit.terrain()
    plotting.plot_mesh(relief, ground.made.mesh, width=0)
    relief.imshow(_lit(ground.heights), cmap=GREYS, origin="lower")
    relief.set_title("{1} × {0} samples".format(*ground.heights.shape))
    plotting.plot_mesh(flat, ground.made.mesh, width=FINE)
    flat.set_title(f"{ground.made.mesh.n_nodes} nodes")
    found = limit.around_hole()
    plotting.plot_mesh(hole, found.mesh, width=FINE)
    _contours(hole, found.interpolant)
    hole.set_title(f"{found.mesh.n_nodes} nodes")
    return figure


def _contours(ax: Axes, u_h: Interpolant) -> None:
    from matplotlib.tri import Triangulation

    x, y = u_h.mesh.nodes.T
    look: dict[str, Any] = dict(colors=plotting.ACCENT, linewidths=1, linestyles="-")
    ax.tricontour(Triangulation(x, y, u_h.mesh.elements), u_h.values, levels=CONTOURS, **look)


def _lit(heights: np.ndarray) -> np.ndarray:
    """Light from the upper left on terrain, from the slopes of its samples."""
    down, across = np.gradient(heights)
    spread = RELIEF * np.hypot(across, down).mean()
    return np.arctan((across - down) / spread)


def directed() -> Figure:
    """Error over that of parallel strips, and two meshes of few nodes."""
    figure, (ax, *flat) = plotting.panels(3)
    for name, colour, size in zip(limit.DIRECTED, COLOURS.values(), DOTS, strict=False):
        ratios = limit.over_strips(name)
        ax.semilogx(limit.DIRECTED_NODES, ratios, marker="o", markersize=size, color=colour, label=name)
    _level(ax, "strips", 1)
    _level(ax, "zigzag", limit.ZIGZAG)
    ax.minorticks_off()
    ax.set_xticks(limit.DIRECTED_NODES, limit.DIRECTED_NODES)
    ax.set(xlabel="nodes", ylabel="error / error of strips", ylim=(0, None), box_aspect=1)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(frameon=False, loc="lower right")
    for ax, name in zip(flat, limit.DIRECTED, strict=True):
        plotting.plot_mesh(ax, limit.made(name, FEW).mesh, width=FINE)
        ax.set_title(f"{name}, {FEW} nodes")
    return figure


def _level(ax: Axes, text: str, height: float) -> None:
    """A line at a height, with its name below the right end."""
    ax.axhline(height, color=plotting.INK, linewidth=1, zorder=0)
    place: dict[str, Any] = dict(xycoords=("axes fraction", "data"), textcoords="offset points")
    ax.annotate(text, (1, height), (-2, -2), ha="right", va="top", fontsize="small", **place)


def conditioned() -> Figure:
    """Condition numbers against the smallest angle: of the stiffness matrix, and scaled by its diagonal."""
    figure, axes = plotting.panels(2, size=plotting.WIDTH / 2)
    figure.set_size_inches(plotting.WIDTH, TALL + 0.6)
    colours = plotting.PALETTE.values()
    for family, marker, colour in zip(conditioning.families(), MARKERS, colours, strict=False):
        _family(list(axes), family, marker, colour)
    for ax, title in zip(axes, ("stiffness matrix", "scaled by its diagonal"), strict=True):
        ax.set(title=title, xlabel="smallest angle, degrees")
        ax.spines[["top", "right"]].set_visible(False)
    axes[1].set_ylim(axes[0].get_ylim())
    axes[0].set_ylabel("condition number")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _family(axes: Sequence[Axes], family: str, marker: str, colour: str) -> None:
    """A dot in each panel for each mesh of a family."""
    found = conditioning.measured().items()
    angles, *conditions = np.transpose([row for (where, _), row in found if where == family])
    look: dict[str, Any] = dict(markeredgecolor=plotting.INK, markeredgewidth=HAIR, markersize=7)
    for ax, values in zip(axes, conditions, strict=True):
        ax.loglog(angles, values, marker, color=colour, label=family, linestyle="none", **look)
