"""Figure of section 7.2: polygons in place of a curved domain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import curves, plotting
from ..studies import section_7_2_boundaries as boundaries

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["boundaries_compared"]

FEW, SOME = 10, 40  # nodes along the ellipse and along the trefoil
SHARES = (0.55, 1.0)  # relative heights of the two rows
HEIGHT = 5.2  # inches
FINE = 400  # points at which a curve is drawn
THIN = 0.8  # points
LOOKS = {  # colour and marker of a density
    "curvature": (plotting.SECOND, "o"),
    "length": (plotting.ACCENT, "s"),
    "parameter": (plotting.PALETTE["black"], "^"),
}
LINES = {"ellipse": "-", "trefoil": "--"}
LEFT_OUT = "ellipse", "parameter"  # the best polygons of an ellipse are those of its parameter


def boundaries_compared() -> Figure:
    """An ellipse by two rules, the area lost against n, and a mesh of a domain that is not convex."""
    with plotting.style():
        figure = plotting.look.pyplot().figure(figsize=(plotting.WIDTH, HEIGHT), layout="constrained")
        grid = figure.add_gridspec(2, 2, height_ratios=SHARES)
        axes = [figure.add_subplot(place) for place in grid]
        for ax, density in zip(axes, ("length", "curvature"), strict=False):
            _polygon(ax, "ellipse", density)
        _areas(axes[2])
        _mesh(axes[3], "trefoil")
        for ax, letter in zip(axes, "abcd", strict=True):
            ax.set_title(f"({letter}) {ax.get_title()}", loc="left")
            ax.set_title("")
    return figure


def _polygon(ax: Axes, name: str, density: str) -> None:
    """The curve, the polygon, and the area between them."""
    t = boundaries.placed(name, FEW, density)
    x, y = boundaries.CURVES[name](np.linspace(0, 1, FINE))
    p, q = boundaries.CURVES[name](np.append(t, 1))
    ax.fill(x, y, color=plotting.ACCENT, linewidth=0, zorder=1)
    ax.fill(p, q, color="white", linewidth=0, zorder=2)
    ax.plot(x, y, color=plotting.FAINT, linewidth=THIN, zorder=3)
    ax.plot(p, q, "o-", color=plotting.INK, linewidth=1.5 * THIN, markersize=4, zorder=4)
    area = curves.deviation(boundaries.CURVES[name], t)
    ax.set_title(f"equal {boundaries.DENSITIES[density]}: {area:.2f} lost")
    ax.set_aspect("equal")
    ax.axis("off")


def _mesh(ax: Axes, name: str) -> None:
    """A mesh of the domain inside a curve."""
    t = boundaries.placed(name, SOME)
    mesh = curves.domain_mesh(boundaries.CURVES[name], t)
    plotting.plot_mesh(ax, mesh, nodes=np.arange(SOME), width=THIN)
    curve = boundaries.CURVES[name](np.linspace(0, 1, FINE))
    ax.plot(*curve, color=plotting.ACCENT, linewidth=THIN, zorder=1)
    ax.set_title(f"{SOME} of {mesh.n_nodes} nodes on the boundary")


def _areas(ax: Axes) -> None:
    """n^2 times the area lost against n, and its limits."""
    for name in LINES:
        for density in LOOKS:
            if (name, density) != LEFT_OUT:
                _area(ax, name, density)
    ax.set(xlabel="nodes $n$ on the boundary", ylabel="$n^2$ times the area lost", ylim=(0, 170))
    ax.set_xticks(boundaries.NODES, boundaries.NODES)
    ax.minorticks_off()
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(fontsize="small", frameon=False, loc="lower right", ncols=2, handlelength=2.4)


def _area(ax: Axes, name: str, density: str) -> None:
    colour, marker = LOOKS[density]
    ax.axhline(boundaries.limits(name)[density], color=plotting.FAINT, linewidth=THIN, zorder=0)
    look = dict(color=colour, marker=marker, markersize=4, linestyle=LINES[name], linewidth=1.5 * THIN)
    label = f"{name}, {boundaries.DENSITIES[density]}"
    ax.semilogx(boundaries.NODES, boundaries.lost(name, density), label=label, **look)
