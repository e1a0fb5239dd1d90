"""Elements, edges and nodes of a mesh, pointed out by colours, discs and numbers."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from .._typing import ArrayLike, BoolArray, FloatArray, IntArray
from ..errors import InvalidInputError
from ..mesh.mesh import Mesh
from .settings import LOOK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.lines import Line2D
    from matplotlib.text import Annotation
    from matplotlib.typing import ColorType


def highlight_edges(
    ax: "Axes",
    mesh: Mesh,
    edges: ArrayLike | bool,
    *,
    colour: "ColorType" = LOOK.colours.accent,
    width: float = LOOK.lines.thick,
    linestyle: str = "-",
) -> "LineCollection":
    """Draw some edges of a mesh in a colour.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
    edges : (n,) array_like of int, (n_edges,) of bool, or True
        Numbers of the edges, rows of ``mesh.edges``; or a mask of them; True for all.
    colour : colour of matplotlib
    width : float
        Width of the lines in points.
    linestyle : str
        Style of the lines, as matplotlib writes it, for example ``"--"``.

    Returns
    -------
    matplotlib.collections.LineCollection

    Raises
    ------
    MeshError
        If the mesh has no edge of a given number, or a mask has another length.

    See Also
    --------
    edges_not_in : The edges in which two meshes differ.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> mesh = problems.mesh("33")
    >>> figure, (ax,) = plotting.panels()
    >>> len(highlight_edges(ax, mesh, mesh.boundary).get_segments())
    8
    >>> plt.close(figure)
    """
    return draw_edges(ax, mesh, edges, color=colour, linewidth=width, linestyle=linestyle, zorder=3)


def draw_edges(ax: "Axes", mesh: Mesh, edges: ArrayLike | bool, **options: Any) -> "LineCollection":
    """Some edges of a mesh, with options of LineCollection."""
    from matplotlib.collections import LineCollection

    ends = mesh.edges[chosen(edges, mesh.n_edges, "edge")]
    lines = LineCollection(list(mesh.nodes[ends]), capstyle="round", **options)
    ax.add_collection(lines)
    return lines


def shade_elements(
    ax: "Axes",
    mesh: Mesh,
    elements: ArrayLike | bool,
    *,
    colour: "ColorType" = LOOK.colours.shade,
    opacity: float = LOOK.colours.shade_opacity,
) -> "PolyCollection":
    """Fill some elements of a mesh with a colour.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
    elements : (n,) array_like of int, (n_elements,) of bool, or True
        Numbers of the elements, rows of ``mesh.elements``; or a mask of them; True for all.
    colour : colour of matplotlib
    opacity : float
        Between 0, invisible, and 1.

    Returns
    -------
    matplotlib.collections.PolyCollection

    Raises
    ------
    MeshError
        If the mesh has no element of a given number, or a mask has another length.

    See Also
    --------
    plot_mesh : The edges of the mesh.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> figure, (ax,) = plotting.panels()
    >>> len(shade_elements(ax, problems.mesh("33"), [0, 5]).get_paths())
    2
    >>> plt.close(figure)
    """
    from matplotlib.collections import PolyCollection

    corners = mesh.corners[chosen(elements, mesh.n_elements, "element")]
    triangles = PolyCollection(list(corners), facecolors=colour, edgecolors="none", alpha=opacity, zorder=1)
    ax.add_collection(triangles)
    return triangles


def mark_nodes(
    ax: "Axes",
    mesh: Mesh,
    nodes: ArrayLike | bool = True,
    *,
    colour: "ColorType" = LOOK.colours.ink,
    size: float = LOOK.lines.node,
) -> "Line2D":
    """Mark some nodes of a mesh by discs.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
    nodes : (n,) array_like of int, (n_nodes,) of bool, or True
        Numbers of the nodes; or a mask of them; True for all.
    colour : colour of matplotlib
    size : float
        Diameter of the discs in points.

    Returns
    -------
    matplotlib.lines.Line2D

    Raises
    ------
    MeshError
        If the mesh has no node of a given number, or a mask has another length.

    See Also
    --------
    number_nodes : Write numbers beside nodes.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> figure, (ax,) = plotting.panels()
    >>> len(mark_nodes(ax, problems.mesh("33"), [0, 7, 8]).get_xdata())
    3
    >>> plt.close(figure)
    """
    x, y = mesh.nodes[chosen(nodes, mesh.n_nodes, "node")].T
    return ax.plot(x, y, "o", color=colour, markersize=size, zorder=4, clip_on=False)[0]


def number_nodes(
    ax: "Axes",
    mesh: Mesh,
    nodes: ArrayLike | bool = True,
    *,
    labels: Iterable[object] | None = None,
    distance: float = LOOK.text.number_distance,
    size: float = LOOK.text.size,
) -> "list[Annotation]":
    """Write numbers or other labels beside nodes, where they cross no edge.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    mesh : Mesh
    nodes : (n,) array_like of int, (n_nodes,) of bool, or True
        Numbers of the nodes; or a mask of them; True for all.
    labels : iterable of n objects, optional
        What is written beside each node; by default its number, from 0.
    distance : float
        Distance of a label from its node in points.
    size : float
        Font size in points.

    Returns
    -------
    list of matplotlib.text.Annotation

    Raises
    ------
    MeshError
        If the mesh has no node of a given number, or a mask has another length.
    ValueError
        If there are more or fewer labels than nodes.

    See Also
    --------
    mark_nodes : Mark nodes by discs.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> figure, (ax,) = plotting.panels()
    >>> [text.get_text() for text in number_nodes(ax, problems.mesh("33"), [0, 7], labels="ab")]
    ['a', 'b']
    >>> plt.close(figure)
    """
    numbers = chosen(nodes, mesh.n_nodes, "node")
    return [
        ax.annotate(
            str(label),
            tuple(mesh.nodes[node]),
            tuple(distance * _free_direction(mesh, node)),
            textcoords="offset points",
            size=size,
            ha="center",
            va="center",
            zorder=5,
        )
        for node, label in zip(numbers, numbers if labels is None else labels, strict=True)
    ]


def chosen(items: ArrayLike | bool, count: int, what: str) -> IntArray:
    """Numbers of nodes, edges or elements, given as such, as a mask, or as True for all; or a MeshError."""
    if isinstance(items, bool):
        return np.arange(count if items else 0)
    numbers = np.atleast_1d(np.asarray(items))
    if numbers.dtype == bool:
        numbers = _where(numbers, count, what)
    wrong = numbers[(numbers < 0) | (numbers >= count) | (numbers % 1 != 0)]
    if wrong.size:
        remedy = f"give whole numbers from 0 to {count - 1}"
        raise InvalidInputError("range", f"there is no {what} {wrong[0]}; {remedy}", wrong, wrong.size)
    return numbers.astype(np.int64)


def _where(mask: BoolArray, count: int, what: str) -> IntArray:
    """Numbers of the items for which a mask is True."""
    if mask.shape != (count,):
        raise InvalidInputError(
            "shape", f"the mask has shape {mask.shape}; give ({count},), one for each {what}"
        )
    return np.flatnonzero(mask)


def _free_direction(mesh: Mesh, node: int) -> FloatArray:
    """Unit vector into the widest angle between the edges at a node."""
    ends = mesh.edges[(mesh.edges == node).any(axis=1)]
    away = mesh.nodes[ends.sum(axis=1) - node] - mesh.nodes[node]
    angle = np.sort(np.arctan2(away[:, 1], away[:, 0]))
    gap = np.diff(angle, append=angle[0] + 2 * np.pi)
    middle = angle[gap.argmax()] + gap.max() / 2
    return np.array([np.cos(middle), np.sin(middle)])
