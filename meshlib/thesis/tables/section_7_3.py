"""The tables of sections 7.3 and 7.4, every cell computed."""

import numpy as np

from ..studies import section_7_3_alignment as alignment
from .numbered import grid, numbered


def slopes():
    """Exact alignment: lines of nodes, and what swapping makes of them."""
    head = (
        "Slope",
        "Angle",
        "Lines apart",
        "Between lines",
        "Start",
        "Swapped",
        "Swapped, far from boundary",
        "Skewness",
        "½° beside",
    )
    rows = [_slope(rise, run) for rise, run in alignment.SLOPES if rise <= run]
    caption = (
        "Contours along lines of lattice nodes. Distance of these lines in spacings; $L_2$ error of "
        "linear interpolation between them, of the start mesh, after swapping, and after that on a "
        "finer lattice; mean skewness after swapping there, and half a degree to either side."
    )
    return numbered("tab-slopes", caption, grid(head, rows))


def _slope(rise, run):
    angle = alignment.angle_of(rise, run)
    errors = (
        alignment.error_between_lines(rise, run),
        alignment.measures("start", angle)[0],
        alignment.measures("swapped", angle)[0],
        alignment.error_far_from_boundary(rise, run),
    )
    steps = -alignment.BESIDE, alignment.BESIDE
    beside = [alignment.measures("swapped", angle + step)[1] for step in steps]
    skewness = alignment.measures("swapped", angle)[1], np.mean(beside)
    return (
        f"{rise}/{run}" if run > 1 else rise,
        f"{angle:.1f}°",
        f"{alignment.lines_apart(rise, run):.3f}",
        *(f"{e:.4f}" for e in errors),
        *(f"{s:.2f}" for s in skewness),
    )


def repair():
    """What springs before swapping repair where contours follow lines of nodes."""
    head = (
        "Angle",
        "$L_2$ swapped",
        "springs",
        "springs, swapped",
        "ratio",
        "Skewness swapped",
        "springs",
        "springs, swapped",
    )
    rows = [_repair(alignment.angle_of(rise, run)) for rise, run in alignment.SLOPES]
    caption = (
        "Contours along lines of lattice nodes: $L_2$ error and mean skewness after swapping, after "
        "springs, and after both; the ratio is that of the errors without and with springs."
    )
    return numbered("tab-repair", caption, grid(head, rows))


def _repair(angle):
    names = "swapped", "springs", "springs, swapped"
    errors, skewness = np.transpose([alignment.measures(name, angle) for name in names])
    return (
        f"{angle:.1f}°",
        *(f"{e:.4f}" for e in errors),
        f"{errors[0] / errors[-1]:.1f}",
        *(f"{s:.2f}" for s in skewness),
    )


def strategies():
    """What each strategy reaches over all angles."""
    head = ("", "$L_2$ mean", "largest", "largest / least", "Skewness mean", "largest")
    rows = []
    for name in alignment.STRATEGIES:
        errors, skewness = alignment.curve(name)
        rows.append(
            (
                name,
                f"{errors.mean():.4f}",
                f"{errors.max():.4f}",
                f"{errors.max() / errors.min():.1f}",
                f"{skewness.mean():.2f}",
                f"{skewness.max():.2f}",
            )
        )
    caption = "The ramp on the lattice, over all angles: $L_2$ error and mean skewness of the mesh."
    return numbered("tab-strategies", caption, grid(head, rows))


def constants():
    """What other springs reach, and springs and swaps by turns."""
    head = (
        "First",
        "Second",
        "Power",
        "Rounds",
        "Springs, mean",
        "largest",
        "Springs, swapped, mean",
        "largest",
    )
    default = next(c for c in alignment.CONSTANTS if c == (0, 100, 0.4))
    trials = [(*c, 1) for c in alignment.CONSTANTS] + [(*default, n) for n in alignment.ROUNDS[1:]]
    rows = []
    for trial in trials:
        found = alignment.trial(*trial)
        cells = [f"{value:.4f}" for column in found.T for value in (column.mean(), column.max())]
        rows.append((*(f"{value:g}" for value in trial), *cells))
    caption = "$L_2$ error for other weights and powers of the springs, and for springs and swaps by turns."
    return numbered("tab-constants", caption, grid(head, rows))


def elsewhere():
    """Springs before swapping on the problems of the thesis."""
    rows = [
        (
            function,
            nodes,
            *(
                "no rest" if np.isnan(error) else f"{error:.4f}"
                for error in alignment.elsewhere(function, nodes)
            ),
        )
        for function, nodes in alignment.ELSEWHERE
    ]
    head = "Function", "Nodes", "Start", "Swapped", *(f"Weight {w}, swapped" for w in alignment.WEIGHTS)
    caption = (
        "$L_2$ error on the problems of the thesis, for three weights of the second derivative; where "
        "the springs find no rest, it depends on when they are stopped."
    )
    return numbered("tab-elsewhere", caption, grid(head, rows))
