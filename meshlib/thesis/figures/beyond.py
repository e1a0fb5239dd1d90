"""Figures of section 7.6: how far from the best mesh swapping ends, and how near annealing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import Interpolant, plotting, problems
from ..studies import section_7_6_beyond as beyond

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["annealed", "distances", "every_cost"]

WAYS = {"start": ("black", ":"), "swapped": ("vermillion", "-"), "annealed": ("blue", "--")}
BINS, RATIOS = 60, (1, 1.5, 2, 3, 5, 10)
LOW, TALL = 3.1, 5.0  # inches
LINEAR, MOST = 1.0, 1000.0  # per cent, where the linear part of an axis ends, and where the axis ends
TICKS = (0, 0.5, 1, 10, 100)  # per cent
SIDES = {"swapped": -1, "annealed": 1}  # above or below the middle of a row
APART, SPREAD = 0.2, 0.14  # rows, distance of the dots from the middle, and how far they are spread
FOUND, COLUMN = 0.955, 0.04  # widths of the axes, where the shares stand, and half their distance
GUIDE, FINE_WIDTH = 0.5, 0.6  # points, widths of a guide line and of an edge
SHOWN = "81", "SR3", "abn", 1
CONTOURS = 6


def every_cost() -> Figure:
    """Costs of all meshes of twelve nodes, and where swapping and annealing end."""
    figure, axes = plotting.panels(len(beyond.LISTED), size=plotting.WIDTH / len(beyond.LISTED))
    figure.set_size_inches(plotting.WIDTH, LOW)
    for ax, (name, norm) in zip(axes, beyond.LISTED, strict=True):
        costs, run = beyond.listed(name, norm, *beyond.TWELVE)
        _histogram(ax, costs, (run.cost_before, run.cost_swapped, run.cost_after))
        fewer = np.count_nonzero(costs < run.cost_swapped * (1 - beyond.SAME))
        ax.set_title(f"{beyond.title(name, norm)}\n{fewer} cost less than swapped", fontsize="small")
    axes[0].set_ylabel(f"all {len(costs)} meshes")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(WAYS))
    return figure


def _histogram(ax: Axes, costs: np.ndarray, ends: Sequence[float]) -> None:
    """Costs of all meshes relative to the least, with lines at those of start, swapped and annealed."""
    ratios = costs / costs.min()
    ax.hist(ratios, np.geomspace(1, ratios.max(), BINS).tolist(), color=plotting.FAINT)
    for end, (way, (colour, line)) in zip(ends, WAYS.items(), strict=True):
        ax.axvline(end / costs.min(), linestyle=line, color=plotting.PALETTE[colour], label=way)
    ax.set(xscale="log", yticks=[], xlabel="cost / least cost")
    ax.set_xticks([tick for tick in RATIOS if tick <= ratios.max()], minor=False)
    ax.xaxis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    ax.spines[["top", "right", "left"]].set_visible(False)


def distances() -> Figure:
    """How much more than the best mesh those of swapping and annealing cost, for each criterion."""
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(plotting.WIDTH, TALL)
    for row, case in enumerate(beyond.CASES):
        ax.axhline(row, color=plotting.FAINT, linewidth=GUIDE, zorder=0, xmax=FOUND - 3 * COLUMN)
        for way in SIDES:
            _dots(ax, beyond.distances(*case), row, way, way if row == 0 else None)
    for way in SIDES:
        _beside(ax, way, "found", 1, xycoords="axes fraction", xytext=(0, 3), textcoords="offset points")
    _percent_axes(ax, [beyond.title(*case) for case in beyond.CASES])
    figure.legend(loc="outside lower center", ncols=len(SIDES), markerscale=2)
    return figure


def _dots(ax: Axes, found: beyond.Distances, row: int, way: str, label: str | None) -> None:
    """Dots for a criterion, spread so that equal ones are told apart, and the share at 0."""
    values = np.sort(100 * found.excess(way))
    heights = row + SIDES[way] * APART + SPREAD * np.linspace(-1, 1, len(values))
    ax.plot(values, heights, "o", color=_colour(way), markersize=3, alpha=0.6, label=label)
    share = f"{100 * found.share(way):.0f} %"
    _beside(ax, way, share, row, xycoords=("axes fraction", "data"), va="center")


def _beside(ax: Axes, way: str, text: str, y: float, **options: Any) -> None:
    """A text in the column of shares of swapping or of annealing."""
    x, colour = FOUND + SIDES[way] * COLUMN, _colour(way)
    ax.annotate(text, (x, y), ha="right", fontsize="small", color=colour, **options)


def _colour(way: str) -> str:
    return plotting.PALETTE[WAYS[way][0]]


def _percent_axes(ax: Axes, names: Sequence[str]) -> None:
    """Per cent along x, linear below one and logarithmic above, and a name for each row."""
    ax.set_xscale("symlog", linthresh=LINEAR)
    ax.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    ax.set(
        yticks=range(len(names)),
        yticklabels=names,
        ylim=(len(names) - 0.4, -0.6),
        xlim=(-LINEAR / 10, MOST),
        xlabel="cost above that of the best mesh, per cent",
    )
    ax.tick_params(axis="y", length=0)
    ax.spines[["top", "right", "left"]].set_visible(False)


def annealed() -> Figure:
    """Cost against the falling temperature, and the meshes that swapping and annealing end in."""
    figure, (left, *right) = _one_wide_panel_and_two()
    _cooling(left)
    found = beyond.large(*SHOWN)
    run = min((beyond.annealing(*SHOWN, seed) for seed in beyond.SEEDS), key=lambda run: run.cost_after)
    ends = (
        ("swapped", beyond.in_natural_order(*SHOWN), found.swapped, found.error_swapped),
        ("annealed", run.mesh, run.cost_after, found.error_annealed),
    )
    for ax, (way, mesh, cost, error) in zip(right, ends, strict=True):
        plotting.plot_contours(ax, Interpolant(mesh, problems.functions[SHOWN[1]]), levels=CONTOURS)
        plotting.plot_mesh(ax, mesh, width=FINE_WIDTH)
        ax.set_title(f"{way}\ncost {cost:.2f}, $L_2$ {error:.4f}", fontsize="small")
    return figure


def _one_wide_panel_and_two() -> tuple[Figure, Sequence[Axes]]:
    size, ratios = (plotting.WIDTH, plotting.WIDTH / 2.75), (1.1, 1, 1)
    with plotting.style():
        return plotting.look.pyplot().subplots(1, 3, layout="constrained", width_ratios=ratios, figsize=size)


def _cooling(ax: Axes) -> None:
    """The cost at the end of each temperature for every seed, and lines of costs to compare it with."""
    for seed in beyond.SEEDS:
        run = beyond.annealing(*SHOWN, seed)
        ax.plot(run.temperatures, run.history, color=plotting.PALETTE["sky"], linewidth=0.8)
    found = beyond.large(*SHOWN)
    _level(ax, "swapped", found.swapped, plotting.PALETTE["vermillion"])
    _level(ax, f"best of {beyond.ORDERS} orders", found.orders, plotting.PALETTE["orange"])
    _level(ax, "proved optimum", found.best, plotting.PALETTE["black"])
    ax.set(xscale="log", xlabel="temperature", ylabel=f"cost, {beyond.title(*SHOWN[2:])}", ylim=(0, None))
    ax.invert_xaxis()
    ax.spines[["top", "right"]].set_visible(False)


def _level(ax: Axes, text: str, cost: float, colour: str) -> None:
    """A dashed line at a cost, with its name above the right end."""
    ax.axhline(cost, color=colour, linestyle="--", linewidth=1)
    place: dict[str, Any] = dict(xycoords=("axes fraction", "data"), textcoords="offset points")
    look: dict[str, Any] = dict(ha="right", va="bottom", fontsize="small", color=colour)
    ax.annotate(text, (1, cost), (-2, 2), **place, **look)
