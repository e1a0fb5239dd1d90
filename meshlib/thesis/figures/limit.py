"""Figures of section 7.7: how near the limit, what the meshes look like, and what they cost a solver."""

import numpy as np

from ... import Interpolant, plotting
from ..studies import section_7_7a_limit as limit
from ..studies import section_7_7b_conditioning as conditioning

__all__ = ["conditioned", "directed", "efficient", "gallery", "terrain_and_hole"]

COLOURS = dict(
    zip(limit.FUNCTIONS, (plotting.PALETTE[c] for c in ("blue", "green", "vermillion", "black")), strict=True)
)
MARKERS = "osv^D*X"
GALLERY = "ring", "DD1", "Franke"
FEW = limit.DIRECTED_NODES[0]  # nodes at which single elements can be seen
DOTS = 10, 5  # points, so that one is seen behind the other
FINE, HAIR = 0.5, 0.3  # points, of edges
TALL, LOW = 3.6, 3.1  # inches
CONTOURS = 9
RELIEF, GREYS = 3.0, "gray"  # how steep the light makes terrain


def efficient():
    """Error times elements over the limit, against the number of nodes; dashed on lattices."""
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(plotting.WIDTH, TALL)
    for (name, colour), marker in zip(COLOURS.items(), MARKERS, strict=False):
        found, lattice = limit.efficiencies(name)
        ax.loglog(
            limit.NODES,
            lattice,
            linestyle=(0, (2, 2)),
            color=colour,
            linewidth=1,
            marker=marker,
            markersize=4,
            markerfacecolor="white",
        )
        ax.loglog(limit.NODES, found, color=colour, marker=marker, markersize=5, label=name)
    ax.axhline(1, color=plotting.INK, linewidth=1, zorder=0)
    ax.annotate(
        "limit", (1, 1), (4, 0), xycoords=("axes fraction", "data"), textcoords="offset points", va="center"
    )
    _ticks(ax, limit.NODES, (0.8, 1, 1.5, 2, 3, 5, 10, 20, 50, 100))
    ax.set(xlabel="nodes", ylabel="error · elements / B")
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=len(COLOURS))
    return figure


def _ticks(ax, x, y):
    """The given numbers, and no others, along logarithmic axes."""
    ax.minorticks_off()
    ax.set_xticks(x, [f"{tick:g}" for tick in x])
    ax.set_yticks(y, [f"{tick:g}" for tick in y])
    ax.spines[["top", "right"]].set_visible(False)


def gallery():
    """Meshes above, and lines of constant value below."""
    figure, axes = plotting.panels(2 * len(GALLERY), rows=2)
    for (above, below), name in zip(axes.reshape(2, -1).T, GALLERY, strict=True):
        mesh = limit.made(name).mesh
        plotting.plot_mesh(above, mesh, width=FINE)
        above.set_title(f"{name}, {mesh.n_nodes} nodes")
        plotting.plot_contours(below, Interpolant(mesh, limit.FUNCTIONS[name]), levels=CONTOURS)
    return figure


def terrain_and_hole():
    """Samples of terrain as a relief, the mesh made for them, and a mesh around a hole."""
    figure, (relief, flat, hole) = plotting.panels(3)
    ground = limit.terrain()
    plotting.plot_mesh(relief, ground.made.mesh, width=0)
    relief.imshow(_lit(ground.heights), cmap=GREYS, origin="lower")
    relief.set_title("{1} × {0} samples".format(*ground.heights.shape))
    plotting.plot_mesh(flat, ground.made.mesh, width=FINE)
    flat.set_title(f"{ground.made.mesh.n_nodes} nodes")
    found = limit.around_hole()
    plotting.plot_mesh(hole, found.mesh, width=FINE)
    _contours(hole, found.interpolant)
    hole.set_title(f"{found.mesh.n_nodes} nodes")
    return figure


def _contours(ax, u_h):
    ax.tricontour(
        *u_h.mesh.nodes.T,
        u_h.mesh.elements,
        u_h.values,
        levels=CONTOURS,
        colors=plotting.ACCENT,
        linewidths=1,
        linestyles="-",
    )


def _lit(heights):
    """Light from the upper left on a surface of so many metres a sample."""
    down, across = np.gradient(heights)
    spread = RELIEF * np.hypot(across, down).mean()
    return np.arctan((across - down) / spread)


def directed():
    """Error over that of parallel strips, and two meshes of few nodes."""
    figure, (ax, *flat) = plotting.panels(3)
    for (name, u), colour, size in zip(limit.DIRECTED.items(), COLOURS.values(), DOTS, strict=False):
        ratios = [
            limit.error(limit.made(name, n).mesh, u) / limit.strip_error(u, n) for n in limit.DIRECTED_NODES
        ]
        ax.semilogx(limit.DIRECTED_NODES, ratios, marker="o", markersize=size, color=colour, label=name)
    for height, text in ((1, "strips"), (limit.ZIGZAG, "zigzag")):
        ax.axhline(height, color=plotting.INK, linewidth=1, zorder=0)
        ax.annotate(
            text,
            (1, height),
            (-2, -2),
            xycoords=("axes fraction", "data"),
            ha="right",
            va="top",
            textcoords="offset points",
            fontsize="small",
        )
    ax.minorticks_off()
    ax.set_xticks(limit.DIRECTED_NODES, limit.DIRECTED_NODES)
    ax.set(xlabel="nodes", ylabel="error / error of strips", ylim=(0, None), box_aspect=1)
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(frameon=False, loc="lower right")
    for ax, name in zip(flat, limit.DIRECTED, strict=True):
        plotting.plot_mesh(ax, limit.made(name, FEW).mesh, width=FINE)
        ax.set_title(f"{name}, {FEW} nodes")
    return figure


def conditioned():
    """Condition numbers against the smallest angle: of the stiffness matrix, and scaled by its diagonal."""
    figure, axes = plotting.panels(2, size=plotting.WIDTH / 2)
    figure.set_size_inches(plotting.WIDTH, TALL + 0.6)
    found, colours = conditioning.measured(), [*plotting.PALETTE.values()]
    for family, marker, colour in zip(conditioning.families(), MARKERS, colours, strict=False):
        rows = np.array([row for (where, _), row in found.items() if where == family])
        for ax, column in zip(axes, (1, 2), strict=True):
            ax.loglog(
                rows[:, 0],
                rows[:, column],
                marker,
                color=colour,
                label=family,
                linestyle="none",
                markeredgecolor=plotting.INK,
                markeredgewidth=HAIR,
                markersize=7,
            )
    for ax, title in zip(axes, ("stiffness matrix", "scaled by its diagonal"), strict=True):
        ax.set(title=title, xlabel="smallest angle, degrees")
        ax.spines[["top", "right"]].set_visible(False)
    axes[1].set_ylim(axes[0].get_ylim())
    axes[0].set_ylabel("condition number")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure
