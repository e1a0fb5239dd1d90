"""Figures of section 7.5: a cycle of Algorithm 7.5.1, and what it makes of the 33 nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import Interpolant, Mesh, combined, delaunay, plotting, problems
from ...combination.combined import Combination
from ..studies import section_7_5_combining as combining

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["combining_compared", "combining_cycle"]

HEIGHT = 1.95  # inches
DOT = 4.0  # points
DASHES = (0, (4, 3))
KINK = (0, 3)  # x and y at the ends of the kink, from one side of the rectangle to the other


def combining_cycle() -> Figure:
    """The meshes of the cycle; shaded is the patch that acts next, coloured the edge that was made last."""
    meshes, found = _meshes()
    costs, acting = [found.indicator, *found.history["indicator"]], found.history["node"]
    with plotting.style():
        size = plotting.WIDTH, HEIGHT
        figure, axes = plotting.look.pyplot().subplots(1, 3, figsize=size, layout="constrained")
        for k, (ax, mesh) in enumerate(zip(axes, meshes, strict=True)):
            plotting.plot_mesh(ax, mesh, numbers=True)
            ax.plot(KINK, KINK, color=plotting.SECOND, linestyle=DASHES, zorder=2.5)
            plotting.highlight_edges(ax, mesh, plotting.edges_not_in(mesh, meshes[max(k - 1, 0)]))
            plotting.shade_elements(ax, mesh, np.isin(mesh.elements, acting[k : k + 1]).any(axis=1))
            ax.set_title(f"({'abc'[k]})  $J = {costs[k]:.2f}$")
    return figure


def _meshes() -> tuple[list[Mesh], Combination]:
    """The meshes of the cycle, and the run."""
    found, start = combining.cycle(), delaunay(combining.CYCLE_NODES)
    share = found.history["gain"].mean() / found.indicator  # the first step gains it, the second does not
    first = combined(start, combining.ridge, "jnd", rim=False, max_sweeps=1, min_relative_gain=share)
    return [start, first.mesh, found.mesh], found


def combining_compared(function: str = "DD1") -> Figure:
    """Two rows of mesh, surface and lines of constant value: the start, and combined with a limit."""
    u = problems.functions[function]
    before, after = (
        Interpolant(mesh, u) for mesh in (problems.mesh(combining.START), combining.adapted(function).mesh)
    )
    figure = plotting.representation(after, before=before, labels=("start", "combined"))
    moved = np.flatnonzero((before.mesh.nodes != after.mesh.nodes).any(axis=1))
    plotting.mark_nodes(figure.axes[-3], after.mesh, moved, colour=plotting.ACCENT, size=DOT)
    return figure
