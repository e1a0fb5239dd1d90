"""Figures of the appendix on reproducibility."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import plotting
from ..record import printed
from ..studies import appendix_b as studies
from ..studies.experiments import EXPERIMENTS
from ..studies.measures import L2

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["study_angle_limits", "study_every_mesh", "study_maxima", "study_means", "study_noise"]

BINS = 30
LARGEST_DOT = 400  # square points, the area of a dot for all orders
ROOM, LEAST_ROOM = 0.06, 0.01  # beside a histogram, relative to its width; at least, relative to the values
ROW, TALL, LEGEND = 1.25, 4.2, 0.9  # inches
WIDE = 1.6  # width of a single panel over its height
COLOURS = [plotting.PALETTE[c] for c in ("black", "orange", "sky", "green", "purple", "blue", "vermillion")]
RULES = "tolerance of the library", "its relative part alone"
MARKERS = "osv^D*X"
HEADS = {
    L2: "$L_2$ error",
    ("maximum_angle", "mean"): "maximum angle",
    ("skewness", "mean"): "skewness",
    ("aspect_ratio", "mean"): "aspect ratio",
    ("maximum_angle", "max"): "maximum angle",
    ("skewness", "max"): "skewness",
    ("aspect_ratio", "max"): "aspect ratio",
}
BAND = (0.1, 0.5, 0.9)  # quantiles
PRINTED_AT = {"jnd": (0, "SR3-81-JND-L2"), "abn": (8, "SR3-81-8-degrees")}  # limit in degrees, experiment


def study_means() -> Figure:
    """L2 error and means of the shapes over all edge orders, with the printed values."""
    return _distributions((L2, *((m, "mean") for m in printed.GEOMETRY)))


def study_maxima() -> Figure:
    """Maxima of the shapes over all edge orders, with the printed values."""
    return _distributions(tuple((m, "max") for m in printed.GEOMETRY))


def _distributions(measures: Sequence[tuple[str, str]]) -> Figure:
    """A row of histograms for each experiment, a column for each measure."""
    size = plotting.WIDTH, ROW * len(studies.SWAPS)
    with plotting.style():
        figure, rows = plotting.look.pyplot().subplots(
            len(studies.SWAPS), len(measures), layout="constrained", squeeze=False, figsize=size
        )
        for key, row in zip(studies.SWAPS, rows, strict=True):
            for which, ax in zip(measures, row, strict=True):
                _distribution(ax, studies.orders(key).values(which), float(printed.texts(key)[which]))
            row[0].set_ylabel(studies.title(key).replace(", ", "\n", 1), rotation=0, ha="right", va="center")
        for which, ax in zip(measures, rows[0], strict=True):
            ax.set_title(HEADS[which])
    return figure


def _distribution(ax: Axes, values: np.ndarray, text: float) -> None:
    """Shares of the orders by value, and the printed value as a line."""
    low, high = min(values.min(), text), max(values.max(), text)
    room = max(ROOM * (high - low), LEAST_ROOM * abs(high))
    ends = low - room, high + room
    shares = np.full(len(values), 100 / len(values))
    ax.hist(values, BINS, range=ends, weights=shares, color=plotting.SECOND)
    ax.axvline(text, color=plotting.ACCENT, linewidth=plotting.LOOK.lines.thick / 2)
    ax.set(yticks=[], xlim=ends)
    ax.xaxis.set_major_locator(plotting.look.pyplot().MaxNLocator(2))
    ax.spines[["top", "right", "left"]].set_visible(False)


def study_noise() -> Figure:
    """Share of the trials in which noise changes a printed digit, against its size."""
    figure, axes = plotting.panels(2, size=plotting.WIDTH / 2)
    figure.set_size_inches(plotting.WIDTH, plotting.WIDTH / 2.4 + LEGEND)
    for ax, title, tolerance in zip(axes, RULES, (None, 0.0), strict=True):
        _noise(ax, tolerance)
        ax.set(title=title, xscale="log", xlabel="size of the noise", ylim=(-4, 104))
    axes[0].set_ylabel("trials with a changed digit, per cent")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _noise(ax: Axes, tolerance: float | None) -> None:
    keys = [key for key in studies.SWAPS if not EXPERIMENTS[key].shuffled]
    for key, colour, marker in zip(keys, COLOURS, MARKERS, strict=True):
        shares = [100 * max(studies.noise(key, size, tolerance).values()) for size in studies.MAGNITUDES]
        look: dict[str, Any] = dict(color=colour, marker=marker, markersize=4)
        ax.plot(studies.MAGNITUDES, shares, label=studies.title(key), **look)


def study_angle_limits() -> Figure:
    """L2 error of SR3 on 81 nodes against the limit on the smallest angle, for two criteria."""
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(WIDE * TALL, TALL)
    for criterion, colour in zip(studies.CRITERIA, (plotting.SECOND, plotting.ACCENT), strict=True):
        low, middle, high = np.quantile(studies.angle_limits(criterion), BAND, axis=1)
        ax.fill_between(studies.ANGLES, low, high, color=colour, alpha=0.2, linewidth=0, step="pre")
        ax.step(studies.ANGLES, middle, color=colour, label=f"{criterion.upper()}-L2, median")
        limit, key = PRINTED_AT[criterion]
        label, black = "printed" if criterion == "jnd" else None, plotting.PALETTE["black"]
        ax.plot(limit, float(printed.texts(key)[L2]), "s", color=black, zorder=3, label=label)
    ax.set(xlabel="no new angle below, degrees", ylabel="$L_2$ error")
    ax.legend()
    return figure


def study_every_mesh() -> Figure:
    """Cost against L2 error of all meshes of ten nodes, and where edge swapping ends."""
    costs, errors, reached = studies.every_mesh()
    figure, (ax,) = plotting.panels(size=TALL)
    figure.set_size_inches(WIDE * TALL, TALL)
    ax.plot(costs, errors, ".", color=plotting.FAINT, markersize=3, label=f"all {len(costs)} meshes")
    ends, label = np.flatnonzero(reached), "local optima, by share of orders"
    sizes = LARGEST_DOT * reached[ends] / reached.sum()
    ax.scatter(costs[ends], errors[ends], sizes, color=plotting.SECOND, zorder=3, label=label)
    cheapest, best = costs.argmin(), errors.argmin()
    star: dict[str, Any] = dict(color=plotting.ACCENT, markersize=14, zorder=4, label="least cost of all")
    ax.plot(costs[cheapest], errors[cheapest], "*", **star)
    diamond: dict[str, Any] = dict(color=plotting.PALETTE["black"], zorder=4, label="least error of all")
    ax.plot(costs[best], errors[best], "D", **diamond)
    ax.set(xlabel="cost, ABN-L1", ylabel="$L_2$ error")
    ax.legend()
    return figure
