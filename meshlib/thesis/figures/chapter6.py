"""Figures of chapter 6: the modified procedures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import Interpolant, Mesh, plotting
from ..studies.experiments import run
from .adapted import DOUBLE, HEAVY, refined, swapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["figure_6_1", "figure_6_2", "figure_6_3"]

LINEAR = 1e-6  # jump of the gradient up to which u_h counts as linear across an edge


def figure_6_1() -> Figure:
    """SR3 on the 81 nodes, edges swapped unless that creates an angle below 8 degrees."""
    return swapped("SR3-81-8-degrees")


def figure_6_2() -> Figure:
    """SR1 on the 33 nodes, a fifth of the elements refined by cost density."""
    return refined("SR1-33-density")


def figure_6_3() -> Figure:
    """Two local optima for DD1 on the refined 33-node mesh, with the edges that are not in both."""
    one, two = run("DD1-33-refined-ABN-L2"), run("DD1-33-refined-reordered")
    figure, axes = plotting.panels(2, size=DOUBLE)
    plot_differences(axes[0], one.interpolant, two.mesh)
    plot_differences(axes[1], two.interpolant, one.mesh)
    for ax, label in zip(axes, ("original order", "reordered"), strict=True):
        ax.set_title(label)
    return figure


def plot_differences(ax: Axes, interpolant: Interpolant, other: Mesh) -> None:
    """A mesh, with the edges that the other does not have; thick where they crease u_h."""
    mesh = interpolant.mesh
    edges = plotting.edges_not_in(mesh, other)
    thick = creased(interpolant, edges)
    plotting.plot_mesh(ax, mesh, edges=edges[thick])
    plotting.highlight_edges(ax, mesh, edges[~thick], colour=plotting.SECOND, width=HEAVY)


def creased(interpolant: Interpolant, edges: np.ndarray) -> np.ndarray:
    """Whether the gradient jumps across inner edges: a mask over their numbers."""
    left, right = interpolant.mesh.edge_elements[edges].T
    jump = interpolant.gradients[left] - interpolant.gradients[right]
    return np.linalg.norm(jump, axis=1) > LINEAR
