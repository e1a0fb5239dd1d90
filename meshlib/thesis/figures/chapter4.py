"""Figures of chapter 4: nodes, functions and start meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import meshlib as ml
from meshlib import problems
from meshlib.geometry.predicates import incircle
from meshlib.plotting import bare, framed, function_view, mark_nodes, number_nodes, panels, plot_mesh, style
from meshlib.problems.start_meshes import SQUARE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [f"figure_4_{k}" for k in range(1, 10)]

PANEL = 4.2  # inches
NUMBER_SIZE = 8  # points
DECIMAL = 10  # the nodes of Appendix A have one decimal: multiplied by this they are whole numbers


@style()
def figure_4_1() -> Figure:
    """The 81 evenly spaced nodes (Figure 4.1)."""
    return _nodes("81")[0]


@style()
def figure_4_2() -> Figure:
    """The mesh of four nodes from which the 81 nodes are generated (Figure 4.2)."""
    figure, (ax,) = panels(size=PANEL)
    plot_mesh(ax, ml.delaunay(SQUARE.nodes), nodes=True, ticks=True)
    return figure


@style()
def figure_4_3() -> Figure:
    """The 33 nodes of Appendix A, with their numbers there (Figure 4.3)."""
    figure, mesh = _nodes("33")
    ax = bare(figure.axes[0], mesh)
    number_nodes(ax, mesh, labels=range(1, mesh.n_nodes + 1), size=NUMBER_SIZE)
    return figure


def _nodes(name: str) -> tuple[Figure, ml.Mesh]:
    mesh = problems.mesh(name)
    figure, (ax,) = panels(size=PANEL)
    framed(ax, mesh)
    mark_nodes(ax, mesh)
    return figure, mesh


def figure_4_4() -> Figure:
    """The test function SR1 (Figure 4.4)."""
    return function_view(problems.functions["SR1"])


def figure_4_5() -> Figure:
    """The test function SR2 (Figure 4.5)."""
    return function_view(problems.functions["SR2"])


def figure_4_6() -> Figure:
    """The test function SR3 (Figure 4.6)."""
    return function_view(problems.functions["SR3"])


def figure_4_7() -> Figure:
    """The test function DD1 (Figure 4.7)."""
    return function_view(problems.functions["DD1"])


@style()
def figure_4_8() -> Figure:
    """The Delaunay mesh of the 33 nodes; edges between cocircular nodes in colour (Figure 4.8)."""
    mesh = problems.mesh("33")
    figure, (ax,) = panels(size=PANEL)
    plot_mesh(ax, mesh, edges=_cocircular(mesh), nodes=True, ticks=True)
    return figure


def _cocircular(mesh: ml.Mesh) -> np.ndarray:
    """Inner edges whose quadrilateral has its four nodes on one circle."""
    inner = np.flatnonzero(~mesh.boundary)
    t, s = mesh.edge_elements[inner].T
    opposite = mesh.elements[s].sum(axis=1) - mesh.edges[inner].sum(axis=1)
    points = np.rint(DECIMAL * mesh.nodes)
    a, b, c = points[mesh.elements[t].T]
    side = incircle(a, b, c, points[opposite])
    return inner[side == 0]


@style()
def figure_4_9() -> Figure:
    """The Delaunay mesh of the 81 nodes from which all adaptation starts (Figure 4.9)."""
    figure, (ax,) = panels(size=PANEL)
    plot_mesh(ax, problems.mesh("81"), nodes=True, ticks=True)
    return figure
