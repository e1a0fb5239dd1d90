"""Figures of sections 7.3 and 7.4: a ramp turned over a lattice, and springs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import Interpolant, plotting
from ..studies import section_7_3_alignment as alignment

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["aligned_meshes", "jitter", "repaired", "repaired_mesh", "turned"]

HEIGHT, LOW = 5.6, 3.4  # inches, of two panels above and beside each other
MARKED = "0", "1/3", "1/2", "1", "2", "3", "∞"  # the slopes of the lines of nodes
COARSE = tuple(range(0, 91, 5))  # degrees at which means over seeds are shown
SHOWN_JITTERS = (0.0, 0.1, 0.3, 0.5)
MESHES = 0.0, 20.0, 45.0, 45.5  # degrees
LEVELS = [0.1, 0.3, 0.5, 0.7, 0.9]
BAD = 0.0  # degrees, an angle at which swapping can do nothing
LOOKS = {  # colour and line of a strategy
    "start": ("black", ":"),
    "swapped": ("vermillion", "-"),
    "springs": ("green", "-."),
    "springs, swapped": ("blue", "-"),
    "springs, swapped, 8°": ("sky", "--"),
}
CURVE_WIDTH, FINE_WIDTH = 1.6, 0.6  # points, of curves and of the edges of crowded meshes
HEADROOM = 1.25  # height of the axes over that of the curves, which leaves room for a legend


def turned() -> Figure:
    """L2 error and mean skewness against the angle of the contours, before and after swapping."""
    return _over_angles(("start", "swapped"))


def repaired() -> Figure:
    """L2 error and mean skewness against the angle of the contours, for springs and swaps."""
    return _over_angles(tuple(LOOKS))


def _over_angles(strategies: Sequence[str]) -> Figure:
    figure, axes = _stacked()
    for name in strategies:
        colour, line = LOOKS[name]
        look: dict[str, Any] = dict(color=plotting.PALETTE[colour], label=name, linewidth=CURVE_WIDTH)
        for ax, values in zip(axes, alignment.curve(name), strict=True):
            ax.plot(alignment.ALL_ANGLES, values, line, **look)
    _marks(axes)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(strategies))
    return figure


def _stacked() -> tuple[Figure, Sequence[Axes]]:
    """Two wide panels over the angles, one above the other."""
    with plotting.style():
        figure, axes = plotting.look.pyplot().subplots(
            2, 1, sharex=True, layout="constrained", figsize=(plotting.WIDTH, HEIGHT)
        )
    axes[0].set(ylabel="$L_2$ error", xlim=(-1, 91), xticks=range(0, 91, 15))
    axes[1].set(ylabel="mean skewness", xlabel="angle of the contours, degrees")
    for ax in axes:
        ax.spines[["top", "right"]].set_visible(False)
    return figure, axes


def _marks(axes: Sequence[Axes]) -> None:
    """Lines where contours run along lines of nodes, named by their slope above the first panel."""
    for angle, name in zip(alignment.ALIGNED, MARKED, strict=True):
        for ax in axes:
            ax.axvline(angle, color=plotting.FAINT, linewidth=plotting.LOOK.lines.edge, zorder=0)
        place = ("data", "axes fraction")
        axes[0].annotate(name, (angle, 1), (0, 3), xycoords=place, textcoords="offset points", ha="center")
    for ax in axes:
        ax.set_ylim(0)


def jitter() -> Figure:
    """L2 error after swapping on a lattice with jitter: against the angle, and over all angles."""
    figure, (left, right) = plotting.panels(2, size=plotting.WIDTH / 2)
    figure.set_size_inches(plotting.WIDTH, LOW)
    colours = ("black", "blue", "orange", "vermillion")
    for share, colour, line in zip(SHOWN_JITTERS, colours, ("-", "--", "-.", "-"), strict=True):
        errors, _ = alignment.curve("swapped", COARSE, share, alignment.SEEDS if share else (0,))
        left.plot(COARSE, errors, line, color=plotting.PALETTE[colour], label=f"{100 * share:.0f} %")
    left.set(xlabel="angle of the contours, degrees", ylabel="$L_2$ error, swapped", xticks=range(0, 91, 15))
    _over_jitters(right)
    for ax, columns in ((left, 4), (right, 3)):
        ax.set_ylim(0, HEADROOM * ax.get_ylim()[1])
        ax.legend(loc="upper center", ncols=columns, frameon=False, fontsize="small", columnspacing=1)
        ax.spines[["top", "right"]].set_visible(False)
    return figure


def _over_jitters(ax: Axes) -> None:
    """Mean of the errors over the angles, and the band from least to largest, for each strategy."""
    shares = 100 * np.array(alignment.JITTERS)
    for name in ("start", "swapped", "springs, swapped"):
        found = [
            alignment.curve(name, COARSE, j, alignment.SEEDS if j else (0,))[0] for j in alignment.JITTERS
        ]
        colour = plotting.PALETTE[LOOKS[name][0]]
        low, mean, high = (of(found, axis=1) for of in (np.min, np.mean, np.max))
        ax.plot(shares, mean, LOOKS[name][1], marker="o", markersize=4, color=colour, label=name)
        ax.fill_between(shares, low, high, color=colour, alpha=0.15, linewidth=0)
    ax.set(xlabel="jitter, per cent of the spacing", ylabel="$L_2$ error")


def aligned_meshes() -> Figure:
    """Swapped meshes at four angles, with contours of the ramp."""
    return _meshes([("swapped", angle) for angle in MESHES], [f"{angle:g}°" for angle in MESHES])


def repaired_mesh() -> Figure:
    """One badly aligned mesh: at the start, swapped, moved by springs, and both."""
    names = "start", "swapped", "springs", "springs, swapped"
    return _meshes([(name, BAD) for name in names], names)


def _meshes(cases: Sequence[tuple[str, float]], titles: Sequence[str]) -> Figure:
    figure, axes = plotting.panels(len(cases), size=plotting.WIDTH / len(cases))
    figure.set_size_inches(plotting.WIDTH, plotting.WIDTH / len(cases) + 0.4)
    for ax, (strategy, angle), title in zip(axes, cases, titles, strict=True):
        mesh, u = alignment.adapted(strategy, angle), alignment.Ramp(angle)
        plotting.plot_contours(ax, Interpolant(mesh, u), levels=LEVELS, limits=(0, 1))
        plotting.plot_mesh(ax, mesh, width=FINE_WIDTH)
        error, skewness = alignment.measures(strategy, angle)
        ax.set_title(f"{title}\n$L_2$ {error:.4f}, skewness {skewness:.2f}", fontsize="small")
    return figure
