"""Figures of chapter 2: what a mesh is."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import meshlib as ml
from meshlib.plotting import ACCENT, mark_nodes, number_nodes, panels, plot_mesh, style

from .patches import flipped, hanging, split, unclosed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["figure_2_1", "figure_2_2"]

PANEL = 3.2  # inches
KITE = np.array([[0, 0], [4, 0.4], [2.1, -1.7], [1.7, 2.6]])
CONVEX = np.array([[0, 0.4], [2.4, 0], [3.2, 1.9], [0.7, 2.4]])


@style()
def figure_2_1() -> Figure:
    """A hanging node, 2 between 1 and 3 (Figure 2.1)."""
    mesh = ml.Mesh(KITE, np.array([[0, 1, 3], [0, 2, 1]]))
    below = unclosed(mesh, split(mesh, [1], "longest-edge"))
    figure, (ax,) = panels(size=PANEL)
    plot_mesh(ax, below, nodes=True)
    (node,) = hanging(below)
    mark_nodes(ax, below, [node], colour=ACCENT)
    number_nodes(ax, below, [0, node, 1], labels=[1, 2, 3])
    return figure


@style()
def figure_2_2() -> Figure:
    """The two meshes of four nodes in convex position (Figure 2.2)."""
    mesh = ml.delaunay(CONVEX)
    figure, axes = panels(2, size=PANEL)
    for ax, shown in zip(axes, (mesh, flipped(mesh, mesh.boundary.argmin())), strict=True):
        plot_mesh(ax, shown, nodes=True)
    return figure
