"""Interpolants and functions, as surfaces and by their lines of constant value."""

from functools import lru_cache
from numbers import Integral
from typing import TYPE_CHECKING

import numpy as np

from .. import problems
from .._typing import ArrayLike, FloatArray, Function
from ..interpolation.interpolant import Interpolant
from ..mesh.mesh import Mesh
from ..refinement.refined import refined
from .look import bare, framed, pyplot, round_ticks
from .marks import draw_edges
from .meshes import plot_mesh
from .settings import LOOK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.tri import TriContourSet
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
    from mpl_toolkits.mplot3d.axes3d import Axes3D


def plot_surface(
    ax: "Axes3D",
    surface: Interpolant | Function,
    *,
    limits: tuple[float, float] | None = None,
    view: tuple[float, float] | None = None,
) -> "Poly3DCollection":
    """Draw an interpolant, element by element, or a smooth function as a surface.

    Parameters
    ----------
    ax : mpl_toolkits.mplot3d.axes3d.Axes3D
    surface : Interpolant or callable
        A vectorised function u(x, y) is drawn over the unit square, without edges.
    limits : (float, float), optional
        Values at the ends of the vertical axis and of the colours; by default the
        smallest and the largest nodal value.
    view : (float, float), optional
        Elevation and azimuth of the eye in degrees; by default `VIEW`, or its mirror
        image from behind if the surface falls away from the eye there.

    Returns
    -------
    mpl_toolkits.mplot3d.art3d.Poly3DCollection
        The elements, in the order of ``mesh.elements``.

    See Also
    --------
    plot_contours : Lines of constant value in the plane.
    representation : Mesh, surface and lines side by side.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import problems
    >>> ax = plt.figure().add_subplot(projection="3d")
    >>> u_h = Interpolant(problems.mesh("33"), problems.functions["SR1"])
    >>> len(plot_surface(ax, u_h).get_facecolor())
    56
    >>> plt.close(ax.figure)
    """
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    u_h, limits = _interpolant(surface), value_limits(surface, limits=limits)
    corners = np.column_stack([u_h.mesh.nodes, u_h.values])[u_h.mesh.elements]
    view = view or _uphill(u_h)
    colours = _lit(corners, limits, view)
    facets = Poly3DCollection(
        corners,
        facecolors=colours,
        edgecolors=LOOK.colours.ink if surface is u_h else colours,
        linewidths=LOOK.lines.thin,
        clip_on=False,
    )
    ax.add_collection3d(facets)
    _box(ax, u_h.mesh, limits, view)
    return facets


def _box(ax: "Axes3D", mesh: Mesh, limits: tuple[float, float], view: tuple[float, float]) -> None:
    """Axes around a surface: ends along x and y, round numbers along u, and the view."""
    low, high = mesh.box
    for axis, name, *ends in zip((ax.xaxis, ax.yaxis), "xy", low, high, strict=True):
        axis.set_ticks(ends, [f"{end:.3g}" for end in ends])
        axis.set_label_text(name)
        axis.labelpad = LOOK.surface.label_pad
    ax.zaxis.set_ticks(*round_ticks(*limits))
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_tick_params(pad=LOOK.surface.tick_pad)
        axis.set_pane_color("white")
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=limits)
    ax.grid(False)
    sides = (high - low) / (high - low).max()
    ax.set_box_aspect((*sides, LOOK.surface.height), zoom=LOOK.surface.zoom)
    ax.view_init(*view)


def _uphill(u_h: Interpolant) -> tuple[float, float]:
    """The view, from the front or from behind, in which the surface rises away from the eye."""
    elevation, azimuth = LOOK.surface.view
    slope = u_h.mesh.areas @ u_h.gradients
    towards = np.array([np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))])
    return (elevation, azimuth) if slope @ towards <= 0 else (elevation, -azimuth)


def _lit(corners: FloatArray, limits: tuple[float, float], view: tuple[float, float]) -> FloatArray:
    """Colours of facets by value, darker where they are turned away from the light."""
    extent = [np.ptp(corners[..., :2]), np.ptp(corners[..., :2]), np.ptp(limits) / LOOK.surface.height]
    a, b, c = np.moveaxis(corners / extent, 1, 0)
    normal = np.cross(b - a, c - a)
    lamp = np.array(LOOK.surface.light) * [1, -np.sign(view[1]) or 1, 1]  # behind the eye
    light = (normal @ lamp) / (np.linalg.norm(normal, axis=1) * np.linalg.norm(lamp))
    colours = colours_of(corners[..., 2].mean(axis=1), limits)
    colours[:, :3] *= 1 - LOOK.surface.shadow * (1 - light.clip(0, 1))[:, None]
    return colours


def plot_contours(
    ax: "Axes",
    surface: Interpolant | Function,
    *,
    levels: int | ArrayLike = LOOK.surface.levels,
    limits: tuple[float, float] | None = None,
    ticks: bool = False,
) -> "TriContourSet | None":
    """Draw lines of constant value, and below them the mesh of an interpolant.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    surface : Interpolant or callable
        A vectorised function u(x, y) is drawn over the unit square, without a mesh.
    levels : int or array_like of float
        Number of lines, evenly spaced inside the limits, or their values in
        ascending order.
    limits : (float, float), optional
        Values at the ends of the colours; by default the smallest and the largest
        nodal value.
    ticks : bool
        Whether coordinates are shown along two sides.

    Returns
    -------
    matplotlib.tri.TriContourSet or None
        None if the surface takes none of the values.

    See Also
    --------
    meshlib.Interpolant.plot : A method that needs no axes.
    plot_surface : The graph in space.
    spaced : The values of the lines.

    Examples
    --------
    >>> import matplotlib.pyplot as plt
    >>> from meshlib import plotting, problems
    >>> figure, (ax,) = plotting.panels()
    >>> u_h = Interpolant(problems.mesh("33"), problems.functions["SR2"])
    >>> plot_contours(ax, u_h, levels=[0.25, 0.5, 0.75]).levels.tolist()
    [0.25, 0.5, 0.75]
    >>> plt.close(figure)
    """
    u_h, limits = _interpolant(surface), value_limits(surface, limits=limits)
    if surface is u_h:
        plot_mesh(ax, u_h.mesh, colour=LOOK.colours.faint, width=LOOK.lines.thin)
    framed(ax, u_h.mesh) if ticks else bare(ax, u_h.mesh)
    draw_edges(ax, u_h.mesh, u_h.mesh.boundary, color=LOOK.colours.ink, linewidth=LOOK.lines.edge, zorder=2)
    lines = spaced(limits, levels) if isinstance(levels, Integral) else np.asarray(levels, dtype=float)
    lines = lines[(lines > u_h.values.min()) & (lines < u_h.values.max())]
    return _contours(ax, u_h, lines, limits) if lines.size else None


def _contours(
    ax: "Axes", u_h: Interpolant, levels: FloatArray, limits: tuple[float, float]
) -> "TriContourSet":
    """Lines of an interpolant at some of its values."""
    from matplotlib.tri import Triangulation

    x, y = u_h.mesh.nodes.T
    return ax.tricontour(
        Triangulation(x, y, u_h.mesh.elements),
        u_h.values,
        levels=levels,
        zorder=3,
        colors=colours_of(levels, limits),
        linewidths=LOOK.lines.contour,
    )


def spaced(limits: tuple[float, float], count: int = LOOK.surface.levels) -> FloatArray:
    """Values evenly spaced inside the limits, half a step away from each.

    A function that is constant at one of the limits is thus not crossed by lines there.

    Parameters
    ----------
    limits : (float, float)
        Smallest and largest value.
    count : int
        Number of values.

    Returns
    -------
    (count,) ndarray of float

    See Also
    --------
    value_limits : Limits of surfaces.
    plot_contours : Lines at these values.

    Examples
    --------
    >>> spaced((0, 1), 4).tolist()
    [0.125, 0.375, 0.625, 0.875]
    """
    low, high = limits
    return low + (high - low) * (np.arange(count) + 0.5) / count


def value_limits(
    *surfaces: Interpolant | Function, limits: tuple[float, float] | None = None
) -> tuple[float, float]:
    """Smallest and largest value of some surfaces, or the limits if they are given.

    Parameters
    ----------
    *surfaces : Interpolant or callable
        A vectorised function u(x, y) counts on the unit square.
    limits : (float, float), optional
        Returned as given.

    Returns
    -------
    (float, float)
        Of a constant c the limits are c - 0.5 and c + 0.5.

    See Also
    --------
    spaced : Values between the limits.

    Examples
    --------
    >>> from meshlib import Interpolant, Mesh
    >>> mesh = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> value_limits(Interpolant(mesh, [3, 1, 2]), Interpolant(mesh, [0, 1, 0]))
    (0.0, 3.0)
    """
    if limits is not None:
        return limits
    values = np.concatenate([_interpolant(surface).values for surface in surfaces])
    low, high = float(values.min()), float(values.max())
    return (low, high) if low < high else (low - 0.5, high + 0.5)


def colours_of(values: ArrayLike, limits: tuple[float, float]) -> FloatArray:
    """Colours that stand for values between the limits: red, green, blue and opacity in four columns."""
    share = (np.asarray(values) - limits[0]) / (limits[1] - limits[0])
    colours = pyplot().get_cmap(LOOK.colours.values)
    return colours(LOOK.colours.brightest * share.clip(0, 1))


def _interpolant(surface: Interpolant | Function) -> Interpolant:
    """An interpolant as it is, and of a function one on a fine mesh of the unit square."""
    return surface if isinstance(surface, Interpolant) else Interpolant(_fine_mesh(), surface)


@lru_cache(maxsize=1)
def _fine_mesh() -> Mesh:
    """A mesh on which a function looks smooth."""
    mesh = problems.mesh("81")
    for _ in range(LOOK.surface.refinements):
        mesh = refined(mesh, np.zeros(mesh.n_nodes), fraction=1).mesh
    return mesh
