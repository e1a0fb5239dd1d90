"""Figures of chapter 6: the modified procedures."""

import numpy as np

from ... import plotting
from ..studies.experiments import run
from .adapted import DOUBLE, HEAVY, refined, swapped

__all__ = ["figure_6_1", "figure_6_2", "figure_6_3"]

LINEAR = 1e-6  # jumps of the gradient up to here are rounding: u_h is linear across the edge


def figure_6_1():
    """SR3 on the 81 nodes, edges swapped unless that creates an angle below 8 degrees."""
    return swapped("SR3-81-8-degrees")


def figure_6_2():
    """SR1 on the 33 nodes, a fifth of the elements refined by cost density."""
    return refined("SR1-33-density")


def figure_6_3():
    """Two local optima for DD1 on the refined 33-node mesh, and the edges not in both."""
    one, two = run("DD1-33-refined-ABN-L2"), run("DD1-33-refined-reordered")
    figure, axes = plotting.panels(2, size=DOUBLE)
    plot_differences(axes[0], one.interpolant, two.mesh)
    plot_differences(axes[1], two.interpolant, one.mesh)
    for ax, label in zip(axes, ("original order", "reordered"), strict=True):
        ax.set_title(label)
    return figure


def plot_differences(ax, interpolant, other):
    """A mesh, with the edges that another does not have; thick where they crease u_h."""
    mesh = interpolant.mesh
    edges = plotting.edges_not_in(mesh, other)
    thick = creased(interpolant, edges)
    plotting.plot_mesh(ax, mesh, edges=edges[thick])
    plotting.highlight_edges(ax, mesh, edges[~thick], colour=plotting.SECOND, width=HEAVY)


def creased(interpolant, edges):
    """Whether the gradient jumps across interior edges."""
    left, right = interpolant.mesh.edge_elements[edges].T
    jump = interpolant.gradients[left] - interpolant.gradients[right]
    return np.linalg.norm(jump, axis=1) > LINEAR
