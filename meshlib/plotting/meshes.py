"""Meshes, and the edges in which two of them differ."""

from typing import TYPE_CHECKING

import numpy as np

from .._typing import ArrayLike, IntArray
from ..mesh.mesh import Mesh
from .look import bare, framed
from .marks import draw_edges, highlight_edges, mark_nodes, number_nodes, shade_elements
from .settings import LOOK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection
    from matplotlib.typing import ColorType


def plot_mesh(
    ax: "Axes",
    mesh: Mesh,
    *,
    elements: ArrayLike | bool | None = None,
    edges: ArrayLike | bool | None = None,
    nodes: ArrayLike | bool | None = None,
    numbers: ArrayLike | bool | None = None,
    colour: "ColorType" = LOOK.colours.ink,
    width: float = LOOK.lines.edge,
    ticks: bool = False,
) -> "LineCollection":
    """Draw the edges of a mesh, and point out some of its elements, edges and nodes.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
        Need not be valid: hanging nodes and overlapping elements can be shown.
    elements, edges : array_like of int or bool, or True, optional
        Numbers of the elements to shade and of the edges to highlight; or a mask of
        them; True for all.  For other colours call `shade_elements` and `highlight_edges`.
    nodes, numbers : array_like of int or bool, or True, optional
        Nodes to mark, and nodes to label with their numbers, which count from 0; or
        a mask of them; True for all.
    colour : colour of matplotlib
        Colour of the edges.
    width : float
        Width of the edges in points.
    ticks : bool
        Whether coordinates are shown along two sides.

    Returns
    -------
    matplotlib.collections.LineCollection
        The edges, in the order of ``mesh.edges``.

    Raises
    ------
    MeshError
        If the mesh has no node, edge or element of a given number, or a mask has another length.

    See Also
    --------
    meshlib.Mesh.plot : A method that needs no axes.
    plot_contours : Lines of constant value over a mesh.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> figure, (ax,) = plotting.panels()
    >>> lines = plot_mesh(ax, problems.mesh("81"), nodes=True)
    >>> len(lines.get_segments())
    208
    >>> plt.close(figure)
    """
    framed(ax, mesh) if ticks else bare(ax, mesh)
    lines = draw_edges(ax, mesh, True, color=colour, linewidth=width, zorder=2)
    if elements is not None:
        shade_elements(ax, mesh, elements)
    if edges is not None:
        highlight_edges(ax, mesh, edges)
    if nodes is not None:
        mark_nodes(ax, mesh, nodes)
    if numbers is not None:
        number_nodes(ax, mesh, numbers)
    return lines


def edges_not_in(mesh: Mesh, other: Mesh) -> IntArray:
    """Numbers of the edges of a mesh that another mesh with the same nodes lacks.

    Parameters
    ----------
    mesh, other : Mesh
        Edges are compared by the numbers of their two nodes.

    Returns
    -------
    (n,) ndarray of int
        Rows of ``mesh.edges``, in ascending order.

    See Also
    --------
    highlight_edges : Draw these edges.

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
