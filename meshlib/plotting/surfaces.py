"""Interpolants and functions, as surfaces and by their lines of constant value."""

from functools import lru_cache

import numpy as np

from .. import problems
from ..interpolation.interpolant import Interpolant
from ..refinement.refined import refined
from .look import BRIGHTEST, EDGE_WIDTH, FAINT, INK, VALUES, bare, framed, pyplot, round_ticks
from .meshes import draw_edges, plot_mesh

VIEW = 32, -60  # elevation and azimuth of the eye, degrees
HEIGHT = 0.62  # of a surface, in units of the width of its domain
ZOOM = 1.22
TICK_PAD, LABEL_PAD = -2, -11  # points; matplotlib leaves much room
LIGHT = np.array([0.1, -0.55, 0.83])
SHADOW = 0.55  # how much darker a facet gets that is turned away from the light
LEVELS = 10
FINE = 4  # bisections of the 81-node mesh on which a function counts as smooth


def plot_surface(ax, surface, limits=None, view=None):
    """Draw an interpolant, element by element, or a smooth function as a surface.

    Parameters
    ----------
    ax : mpl_toolkits.mplot3d.axes3d.Axes3D
    surface : Interpolant or callable
        A function u(x, y) is drawn over the unit square, without edges.
    limits : (float, float), optional
        Values at the ends of the vertical axis and of the colours.
    view : (float, float), optional
        Elevation and azimuth of the eye in degrees; by default `VIEW`, or from the
        other side if the surface would hide its slope from there.

    Returns
    -------
    mpl_toolkits.mplot3d.art3d.Poly3DCollection

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
    own_edges = surface is u_h
    facets = Poly3DCollection(
        corners,
        facecolors=colours,
        edgecolors=INK if own_edges else colours,
        linewidths=EDGE_WIDTH / 2,
        clip_on=False,
    )
    ax.add_collection3d(facets)
    _box(ax, u_h.mesh, limits, view)
    return facets


def _box(ax, mesh, limits, view):
    low, high = mesh.box
    for axis, name, *ends in zip((ax.xaxis, ax.yaxis), "xy", low, high, strict=True):
        axis.set_ticks(ends, [f"{end:.3g}" for end in ends])
        axis.set_label_text(name)
        axis.labelpad = LABEL_PAD
    ax.zaxis.set_ticks(*round_ticks(*limits))
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_tick_params(pad=TICK_PAD)
        axis.set_pane_color("white")
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=limits)
    ax.grid(False)
    ax.set_box_aspect((*(high - low) / (high - low).max(), HEIGHT), zoom=ZOOM)
    ax.view_init(*view)


def _uphill(u_h):
    """The view, from in front or from the back, that has the surface rise away from the eye."""
    elevation, azimuth = VIEW
    slope = u_h.mesh.areas @ u_h.gradients
    towards = np.array([np.cos(np.radians(azimuth)), np.sin(np.radians(azimuth))])
    return (elevation, azimuth) if slope @ towards <= 0 else (elevation, -azimuth)


def _lit(corners, limits, view):
    """Colours of facets by value, darker where they are turned away from the light."""
    extent = [np.ptp(corners[..., :2]), np.ptp(corners[..., :2]), np.ptp(limits) / HEIGHT]
    a, b, c = np.moveaxis(corners / extent, 1, 0)
    normal = np.cross(b - a, c - a)
    lamp = LIGHT * [1, -np.sign(view[1]) or 1, 1]  # behind the eye
    light = (normal @ lamp) / (np.linalg.norm(normal, axis=1) * np.linalg.norm(lamp))
    colours = colours_of(corners[..., 2].mean(axis=1), limits)
    colours[:, :3] *= 1 - SHADOW * (1 - light.clip(0, 1))[:, None]
    return colours


def plot_contours(ax, surface, levels=LEVELS, limits=None, ticks=False):
    """Draw lines of constant value, of an interpolant over its own mesh.

    Parameters
    ----------
    ax : matplotlib.axes.Axes
    surface : Interpolant or callable
        A function u(x, y) is drawn over the unit square, without a mesh.
    levels : int or array_like of float
        Number of lines, evenly spaced inside the limits, or their values.
    limits : (float, float), optional
        Values at the ends of the colours.
    ticks : bool
        Whether coordinates are shown.

    Returns
    -------
    matplotlib.tri.TriContourSet or None
        None if the surface takes none of the values.

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
        plot_mesh(ax, u_h.mesh, colour=FAINT, width=EDGE_WIDTH / 2)
    framed(ax, u_h.mesh) if ticks else bare(ax, u_h.mesh)
    draw_edges(ax, u_h.mesh, u_h.mesh.boundary, INK, EDGE_WIDTH, zorder=2)
    levels = spaced(limits, levels) if np.isscalar(levels) else np.asarray(levels, dtype=float)
    levels = levels[(levels > u_h.values.min()) & (levels < u_h.values.max())]
    return _contours(ax, u_h, levels, limits) if levels.size else None


def _contours(ax, u_h, levels, limits):
    return ax.tricontour(
        *u_h.mesh.nodes.T,
        u_h.mesh.elements,
        u_h.values,
        levels=levels,
        zorder=3,
        colors=colours_of(levels, limits),
        linewidths=1.5 * EDGE_WIDTH,
    )


def spaced(limits, count=LEVELS):
    """Values evenly spaced inside the limits, and away from plateaux at the limits.

    Examples
    --------
    >>> spaced((0, 1), 4).tolist()
    [0.125, 0.375, 0.625, 0.875]
    """
    low, high = limits
    return low + (high - low) * (np.arange(count) + 0.5) / count


def value_limits(*surfaces, limits=None):
    """Smallest and largest value of some surfaces, or the limits if they are given."""
    if limits is not None:
        return limits
    values = np.concatenate([_interpolant(surface).values for surface in surfaces])
    low, high = float(values.min()), float(values.max())
    return (low, high) if low < high else (low - 0.5, high + 0.5)


def colours_of(values, limits):
    """Colours (n, 4) that stand for values between the limits."""
    share = (np.asarray(values) - limits[0]) / (limits[1] - limits[0])
    return pyplot().get_cmap(VALUES)(BRIGHTEST * share.clip(0, 1))


def _interpolant(surface):
    return surface if isinstance(surface, Interpolant) else Interpolant(_fine_mesh(), surface)


@lru_cache(maxsize=1)
def _fine_mesh():
    mesh = problems.mesh("81")
    for _ in range(FINE):
        mesh = refined(mesh, np.zeros(mesh.n_nodes), fraction=1).mesh
    return mesh
