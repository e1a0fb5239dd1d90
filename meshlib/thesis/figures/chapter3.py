"""Figures of chapter 3: how a mesh is adapted."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import meshlib as ml
from meshlib import plotting
from meshlib.plotting import highlight_edges, number_nodes, panels, plot_mesh, shade_elements, style

from ...refinement.refined import Refinement
from .patches import SQUARE, cuts, flipped, four_elements, hanging, hexagon, split, unclosed

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [f"figure_3_{k}" for k in range(1, 11)]

RED, GREEN = plotting.ACCENT, plotting.PALETTE["green"]
BLUE, SKY = plotting.SECOND, plotting.PALETTE["sky"]
PANEL = 2.9  # inches
JITTER = 0.14  # largest movement of an inner node along x and y, in lengths of an edge
DART = np.array([[0, 0], [3.4, 0.5], [0.5, 3.2], [1.1, 1.2]])  # nodes 1 to 4 of Figure 3.2
DIAMOND = np.array([[0, 0], [2, 0], [1, -1.5], [1, 1.5]])
STAGES = 3  # rounds of refinement


# -- section 3.1 ------------------------------------------------------------------------


@style()
def figure_3_1() -> Figure:
    """A mesh, and one with an edge reconnected, a node inserted, a node moved (Figure 3.1)."""
    mesh = ml.delaunay(SQUARE)
    figure, axes = panels(4, size=plotting.WIDTH / 4, labels=True)
    plot_mesh(axes[0], mesh)
    _reconnection(axes[1], mesh)
    _insertion(axes[2], mesh)
    _movement(axes[3], mesh)
    return figure


def _reconnection(ax: Axes, mesh: ml.Mesh) -> None:
    inner = np.flatnonzero(~mesh.boundary)
    edge = min(inner, key=lambda e: _worst_angle(flipped(mesh, e)))
    other = flipped(mesh, edge)
    highlight_edges(ax, mesh, [edge], colour=plotting.FAINT, linestyle="--")
    plot_mesh(ax, other, edges=plotting.edges_not_in(other, mesh))


def _worst_angle(mesh: ml.Mesh) -> float:
    return ml.quality(mesh).max["maximum_angle"] if (mesh.areas > 0).all() else np.inf


def _insertion(ax: Axes, mesh: ml.Mesh) -> None:
    refinement = split(mesh, [mesh.areas.argmax()], "centroid")
    new = np.arange(mesh.n_nodes, refinement.mesh.n_nodes)
    plot_mesh(ax, refinement.mesh, edges=np.concatenate(cuts(mesh, refinement)))
    plotting.mark_nodes(ax, refinement.mesh, new, colour=RED)


def _movement(ax: Axes, mesh: ml.Mesh) -> None:
    moved = ml.smoothed(mesh).mesh
    node = np.flatnonzero(~mesh.boundary_nodes)
    around = (mesh.edges == node).any(axis=1)
    highlight_edges(ax, mesh, around, colour=plotting.FAINT, linestyle="--")
    plot_mesh(ax, moved, edges=around)
    plotting.mark_nodes(ax, moved, node, colour=RED)


@style()
def figure_3_2() -> Figure:
    """A quadrilateral that is not convex, and what a swap would do to it (Figure 3.2)."""
    mesh = ml.Mesh(DART, np.array([[0, 1, 3], [0, 3, 2]]))
    edge = mesh.boundary.argmin()
    figure, axes = panels(2, size=PANEL, labels=True)
    for ax, shown in zip(axes, (mesh, flipped(mesh, edge)), strict=True):
        inner = shown.boundary.argmin()
        for element, colour in zip(shown.edge_elements[inner], (plotting.SHADE, SKY), strict=True):
            shade_elements(ax, shown, [element], colour=colour)
        plot_mesh(ax, shown, edges=[inner], nodes=True)
        number_nodes(ax, shown, labels=range(1, 5))
    return figure


@style()
def figure_3_3() -> Figure:
    """The edges and elements that a swap can affect (Figure 3.3)."""
    mesh = hexagon(3, JITTER)
    edge = _central_edge(mesh)
    pair = mesh.edge_elements[edge]
    sides = np.setdiff1d(mesh.element_edges[pair], edge)
    figure, (ax,) = panels(size=1.3 * PANEL)
    plot_mesh(ax, mesh, elements=np.union1d(pair, mesh.neighbours[pair]))
    highlight_edges(ax, mesh, sides, colour=BLUE)
    highlight_edges(ax, mesh, [edge], colour=RED)
    return figure


def _central_edge(mesh: ml.Mesh) -> int:
    return int(np.hypot(*mesh.nodes[mesh.edges].mean(axis=1).T).argmin())


# -- section 3.2 ------------------------------------------------------------------------


@style()
def figure_3_4() -> Figure:
    """One node marks its patch of six elements (Figure 3.4)."""
    mesh = hexagon(2, JITTER)
    centre = np.hypot(*mesh.nodes.T).argmin()
    worst = ml.criteria.Criterion("one node", "node", lambda u_h: np.eye(mesh.n_nodes)[centre])
    refinement = ml.refined(mesh, np.zeros(mesh.n_nodes), worst, fraction=1 / mesh.n_elements, mark="node")
    figure, axes = panels(2, size=PANEL, labels=True)
    plot_mesh(axes[0], mesh, elements=refinement.marked)
    plotting.mark_nodes(axes[0], mesh, [centre], colour=RED)
    _plot_split(axes[1], mesh, refinement)
    return figure


def _plot_split(ax: Axes, mesh: ml.Mesh, refinement: Refinement) -> None:
    """The refined mesh, with the edges of red and of green refinement in red and green."""
    shaded = np.isin(refinement.parents, refinement.marked)
    plot_mesh(ax, refinement.mesh, elements=np.flatnonzero(shaded))
    for edges, colour in zip(cuts(mesh, refinement), (RED, GREEN), strict=True):
        highlight_edges(ax, refinement.mesh, edges, colour=colour)


def _plot_hanging(ax: Axes, mesh: ml.Mesh, refinement: Refinement) -> None:
    """The mesh before closure, with its hanging nodes."""
    shown = unclosed(mesh, refinement)
    children = np.arange(np.isin(refinement.parents, refinement.marked).sum())
    plot_mesh(ax, shown, elements=children)
    new = refinement.mesh.edges[np.concatenate(cuts(mesh, refinement))]
    inside = np.isin(shown.edges @ [shown.n_nodes, 1], new @ [shown.n_nodes, 1])
    highlight_edges(ax, shown, inside, colour=RED)
    if len(hanging(shown)):
        plotting.mark_nodes(ax, shown, hanging(shown), colour=BLUE)


@style()
def figure_3_5() -> Figure:
    """Red refinement of an element, which leaves hanging nodes (Figure 3.5)."""
    mesh, middle = four_elements()
    figure, axes = panels(2, size=PANEL, labels=True)
    plot_mesh(axes[0], mesh, elements=[middle])
    _plot_hanging(axes[1], mesh, split(mesh, [middle]))
    return figure


@style()
def figure_3_6() -> Figure:
    """Green refinement of its neighbours (Figure 3.6)."""
    mesh, middle = four_elements()
    figure, (ax,) = panels(size=PANEL)
    _plot_split(ax, mesh, split(mesh, [middle]))
    return figure


@style()
def figure_3_7() -> Figure:
    """Red refinement of elements with two or three hanging nodes (Figure 3.7)."""
    mesh, middle = four_elements()
    outer = np.setdiff1d(np.arange(mesh.n_elements), middle)
    figure, axes = panels(4, size=plotting.WIDTH / 4, labels=True)
    for pair, marked in zip(axes.reshape(2, 2), (outer[:2], outer), strict=True):
        refinement = split(mesh, marked)
        _plot_hanging(pair[0], mesh, refinement)
        _plot_split(pair[1], mesh, refinement)
    return figure


@style()
def figure_3_8() -> Figure:
    """Green refinement repeated, above; taken back before each round, below (Figure 3.8)."""
    figure, axes = panels(2 * STAGES, rows=2, size=PANEL, labels=True)
    for row, forget in zip(axes.reshape(2, STAGES), (True, False), strict=True):
        mesh = ml.Mesh(DIAMOND, np.array([[0, 1, 3], [0, 2, 1]]))
        for ax in row:
            mesh = split(mesh, _below(mesh)).mesh
            plot_mesh(ax, mesh, elements=np.flatnonzero(mesh.corners[..., 1].mean(axis=1) > 0))
            mesh = ml.Mesh(mesh.nodes, mesh.elements) if forget else mesh
    return figure


def _below(mesh: ml.Mesh) -> np.ndarray:
    """Elements that touch the line y = 0 with an edge from below."""
    height = mesh.corners[..., 1]
    return np.flatnonzero(((height == 0).sum(axis=1) == 2) & (height.mean(axis=1) < 0))


@style()
def figure_3_9() -> Figure:
    """A node at the centroid of an element (Figure 3.9)."""
    mesh, middle = four_elements()
    refinement = split(mesh, [middle], "centroid")
    figure, axes = panels(2, size=PANEL, labels=True)
    plot_mesh(axes[0], mesh, elements=[middle])
    _plot_hanging(axes[1], mesh, refinement)
    plotting.mark_nodes(axes[1], refinement.mesh, [mesh.n_nodes], colour=RED)
    return figure


@style()
def figure_3_10() -> Figure:
    """The longest edge bisected, the hanging node, and its closure (Figure 3.10)."""
    mesh, middle = four_elements()
    refinement = split(mesh, [middle], "longest-edge")
    edges = mesh.element_edges[middle]
    lengths = np.linalg.norm(np.diff(mesh.nodes[mesh.edges[edges]], axis=1), axis=2)
    figure, axes = panels(3, size=PANEL, labels=True)
    plot_mesh(axes[0], mesh, elements=[middle])
    highlight_edges(axes[0], mesh, edges[[lengths.argmax()]], colour=BLUE)
    _plot_hanging(axes[1], mesh, refinement)
    _plot_split(axes[2], mesh, refinement)
    return figure
