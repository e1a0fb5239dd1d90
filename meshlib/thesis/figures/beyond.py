"""Figures of the section on annealing: how far from the best, and how near."""

import numpy as np

from ... import plotting, problems
from ...interpolation.interpolant import Interpolant
from ..studies import section_7_6_beyond as beyond

__all__ = ["annealed", "distances", "every_cost"]

WAYS = {"start": ("black", ":"), "swapped": ("vermillion", "-"), "annealed": ("blue", "--")}
BINS, RATIOS = 60, (1, 1.5, 2, 3, 5, 10)
LOW, TALL = 3.1, 5.0  # inches
LINEAR, MOST, TICKS = 1.0, 1000.0, (0, 0.5, 1, 10, 100)  # per cent: end of the linear part, and of all
SIDES = {"swapped": -1, "annealed": 1}  # of a row
SPREAD, APART = 0.14, 0.2  # of the dots, and between swapped and annealed, in rows
FOUND, COLUMN, GUIDE = 0.955, 0.04, 0.5  # where the shares stand, in widths of the axes, and points
SHOWN = "81", "SR3", "abn", 1
CONTOURS = 6
FINE_WIDTH = 0.6  # points, of edges


def every_cost():
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


def _histogram(ax, costs, ends):
    ratios = costs / costs.min()
    ax.hist(ratios, np.geomspace(1, ratios.max(), BINS), color=plotting.FAINT)
    for end, (way, (colour, line)) in zip(ends, WAYS.items(), strict=True):
        ax.axvline(end / costs.min(), linestyle=line, color=plotting.PALETTE[colour], label=way)
    ax.set(xscale="log", yticks=[], xlabel="cost / least cost")
    ax.set_xticks([tick for tick in RATIOS if tick <= ratios.max()], minor=False)
    ax.xaxis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    ax.spines[["top", "right", "left"]].set_visible(False)


def distances():
    """How much swapping and annealing cost more than the best mesh, for each criterion."""
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(plotting.WIDTH, TALL)
    for row, case in enumerate(beyond.CASES):
        ax.axhline(row, color=plotting.FAINT, linewidth=GUIDE, zorder=0, xmax=FOUND - 3 * COLUMN)
        for way, side in SIDES.items():
            _dots(ax, beyond.distances(*case), row + side * APART, way, way if row == 0 else None)
    for way, side in SIDES.items():
        ax.annotate(
            "found",
            (FOUND + side * COLUMN, 1),
            (0, 3),
            xycoords="axes fraction",
            ha="right",
            textcoords="offset points",
            fontsize="small",
            color=_colour(way),
        )
    _percent_axes(ax, [beyond.title(*case) for case in beyond.CASES])
    figure.legend(loc="outside lower center", ncols=len(SIDES), markerscale=2)
    return figure


def _dots(ax, found, y, way, label):
    """A row of dots, spread so that equal ones are told apart, and the share at 0."""
    values = np.sort(100 * found.excess(way))
    ax.plot(
        values,
        y + SPREAD * np.linspace(-1, 1, len(values)),
        "o",
        color=_colour(way),
        markersize=3,
        alpha=0.6,
        label=label,
    )
    ax.annotate(
        f"{100 * found.share(way):.0f} %",
        (FOUND + SIDES[way] * COLUMN, round(y)),
        ha="right",
        va="center",
        xycoords=("axes fraction", "data"),
        fontsize="small",
        color=_colour(way),
    )


def _colour(way):
    return plotting.PALETTE[WAYS[way][0]]


def _percent_axes(ax, names):
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


def annealed():
    """Cost while it gets colder, and the meshes that swapping and annealing end in."""
    pyplot, found = plotting.look.pyplot(), beyond.large(*SHOWN)
    with plotting.style():
        figure, axes = pyplot.subplots(
            1,
            3,
            layout="constrained",
            width_ratios=(1.1, 1, 1),
            figsize=(plotting.WIDTH, plotting.WIDTH / 2.75),
        )
    _cooling(axes[0], found)
    run = min((beyond.annealing(*SHOWN, seed) for seed in beyond.SEEDS), key=lambda run: run.cost_after)
    ends = (
        ("swapped", beyond.in_natural_order(*SHOWN), found.swapped, found.error_swapped),
        ("annealed", run.mesh, run.cost_after, found.error_annealed),
    )
    for ax, (way, mesh, cost, error) in zip(axes[1:], ends, strict=True):
        plotting.plot_contours(ax, Interpolant(mesh, problems.functions[SHOWN[1]]), levels=CONTOURS)
        plotting.plot_mesh(ax, mesh, width=FINE_WIDTH)
        ax.set_title(f"{way}\ncost {cost:.2f}, $L_2$ {error:.4f}", fontsize="small")
    return figure


def _cooling(ax, found):
    """The cost at the end of each level for every seed, and where the others stand."""
    for seed in beyond.SEEDS:
        run = beyond.annealing(*SHOWN, seed)
        ax.plot(run.temperatures, run.history, color=plotting.PALETTE["sky"], linewidth=0.8)
    orders = f"best of {beyond.ORDERS} orders"
    marks = (
        ("swapped", found.swapped, "vermillion"),
        (orders, found.orders, "orange"),
        ("proved optimum", found.best, "black"),
    )
    for text, cost, colour in marks:
        ax.axhline(cost, color=plotting.PALETTE[colour], linestyle="--", linewidth=1)
        ax.annotate(
            text,
            (1, cost),
            (-2, 2),
            xycoords=("axes fraction", "data"),
            textcoords="offset points",
            ha="right",
            va="bottom",
            fontsize="small",
            color=plotting.PALETTE[colour],
        )
    ax.set(xscale="log", xlabel="temperature", ylabel=f"cost, {beyond.title(*SHOWN[2:])}", ylim=(0, None))
    ax.invert_xaxis()
    ax.spines[["top", "right"]].set_visible(False)
