"""Meshes, with elements, edges and nodes to look at."""

import numpy as np

from .look import ACCENT, EDGE_WIDTH, FONT_SIZE, INK, SHADE, THICK, bare, framed

MARK_SIZE, NUMBER_DISTANCE = 5.0, 9.0  # points
SHADE_OPACITY = 0.55


def plot_mesh(
    ax, mesh, elements=None, edges=None, nodes=None, numbers=None, colour=INK, width=EDGE_WIDTH, ticks=False
):
    """Draw the edges of a mesh, and what is to be seen in it.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
        Need not be valid: hanging nodes and overlapping elements can be shown.
    elements, edges : array_like of int, optional
        Numbers of those to highlight; for other colours call `shade_elements` and
        `highlight_edges`.
    nodes, numbers : array_like of int or True, optional
        Nodes to mark, and nodes to number, from 0; True for all of them.
    colour : str
    width : float
        Of the edges, in points.
    ticks : bool
        Whether coordinates are shown.

    Returns
    -------
    matplotlib.collections.LineCollection

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting
    >>> from meshlib import problems
    >>> figure, (ax,) = plotting.panels()
    >>> lines = plot_mesh(ax, problems.mesh("81"), nodes=True)
    >>> len(lines.get_segments())
    208
    >>> plt.close(figure)
    """
    framed(ax, mesh) if ticks else bare(ax, mesh)
    lines = draw_edges(ax, mesh, slice(None), colour, width, zorder=2)
    if elements is not None:
        shade_elements(ax, mesh, elements)
    if edges is not None:
        highlight_edges(ax, mesh, edges)
    if nodes is not None:
        mark_nodes(ax, mesh, nodes)
    if numbers is not None:
        number_nodes(ax, mesh, numbers)
    return lines


def highlight_edges(ax, mesh, edges, colour=ACCENT, width=THICK, linestyle="-"):
    """Draw some edges in colour; returns the LineCollection."""
    return draw_edges(ax, mesh, edges, colour, width, linestyle=linestyle, zorder=3)


def draw_edges(ax, mesh, edges, colour, width, **options):
    from matplotlib.collections import LineCollection

    return ax.add_collection(
        LineCollection(
            mesh.nodes[mesh.edges[edges]], colors=colour, linewidths=width, capstyle="round", **options
        )
    )


def shade_elements(ax, mesh, elements, colour=SHADE, opacity=SHADE_OPACITY):
    """Fill some elements with a colour; returns the PolyCollection."""
    from matplotlib.collections import PolyCollection

    return ax.add_collection(
        PolyCollection(mesh.corners[elements], facecolors=colour, edgecolors="none", alpha=opacity, zorder=1)
    )


def mark_nodes(ax, mesh, nodes=True, colour=INK, size=MARK_SIZE):
    """Mark some nodes, or all with True, by discs; returns the Line2D."""
    x, y = mesh.nodes[slice(None) if nodes is True else nodes].T
    return ax.plot(x, y, "o", color=colour, markersize=size, zorder=4, clip_on=False)[0]


def number_nodes(ax, mesh, nodes=True, labels=None, distance=NUMBER_DISTANCE, size=FONT_SIZE):
    """Write numbers, or other labels, where they cross no edge; returns the texts."""
    nodes = np.arange(mesh.n_nodes) if nodes is True else np.asarray(nodes)
    return [
        ax.annotate(
            str(label),
            mesh.nodes[node],
            distance * _free_direction(mesh, node),
            textcoords="offset points",
            size=size,
            ha="center",
            va="center",
            zorder=5,
        )
        for node, label in zip(nodes, nodes if labels is None else labels, strict=True)
    ]


def _free_direction(mesh, node):
    """Unit vector into the widest angle between the edges at a node."""
    ends = mesh.edges[(mesh.edges == node).any(axis=1)]
    away = mesh.nodes[ends.sum(axis=1) - node] - mesh.nodes[node]
    angle = np.sort(np.arctan2(away[:, 1], away[:, 0]))
    gap = np.diff(angle, append=angle[0] + 2 * np.pi)
    middle = angle[gap.argmax()] + gap.max() / 2
    return np.array([np.cos(middle), np.sin(middle)])


def edges_not_in(mesh, other):
    """Numbers of the edges of a mesh that another mesh on the same nodes does not have.

    Examples
    --------
    >>> from meshlib import Mesh
    >>> nodes = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> one, two = Mesh(nodes, [[0, 1, 2], [0, 2, 3]]), Mesh(nodes, [[0, 1, 3], [1, 2, 3]])
    >>> one.edges[edges_not_in(one, two)].tolist()
    [[0, 2]]
    """
    size = max(mesh.n_nodes, other.n_nodes)
    keys, others = (m.edges.astype(np.int64) @ [size, 1] for m in (mesh, other))
    return np.flatnonzero(~np.isin(keys, others))
