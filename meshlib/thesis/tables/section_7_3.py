"""The tables of sections 7.3 and 7.4, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..studies import section_7_3_alignment as alignment
from .markup import grid, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown


def slopes() -> Markdown:
    """Exact alignment: lines of nodes, and what swapping makes of them."""
    errors = "Between lines", "Start", "Swapped", "Swapped, far from boundary"
    head = ("Slope", "Angle", "Lines apart", *errors, "Skewness", "½° beside")
    caption = (
        "Contours along lines of lattice nodes. Distance of these lines in spacings; $L_2$ error of "
        "linear interpolation between them, of the start mesh, after swapping, and after that on a "
        "finer lattice; mean skewness after swapping there, and half a degree to either side."
    )
    rows = [_slope(rise, run) for rise, run in alignment.SLOPES if rise <= run]
    return numbered("tab-slopes", caption, grid(head, rows))


def _slope(rise: int, run: int) -> tuple:
    angle = alignment.angle_of(rise, run)
    apart = f"{alignment.lines_apart(rise, run):.3f}"
    slope = f"{rise}/{run}" if run > 1 else rise
    errors, skewness = _errors_of_slope(rise, run), _skewness_of_slope(angle)
    return slope, f"{angle:.1f}°", apart, *(f"{e:.4f}" for e in errors), *(f"{s:.2f}" for s in skewness)


def _errors_of_slope(rise: int, run: int) -> Iterator[float]:
    yield alignment.error_between_lines(rise, run)
    for strategy in ("start", "swapped"):
        yield alignment.measures(strategy, alignment.angle_of(rise, run))[0]
    yield alignment.error_far_from_boundary(rise, run)


def _skewness_of_slope(angle: float) -> tuple[float, float]:
    """Mean skewness at an angle, and the mean of those on both sides of it."""
    steps = -alignment.BESIDE, alignment.BESIDE
    beside = [alignment.measures("swapped", angle + step)[1] for step in steps]
    return alignment.measures("swapped", angle)[1], float(np.mean(beside))


def repair() -> Markdown:
    """What springs before swapping repair where contours follow lines of nodes."""
    ways = "springs", "springs, swapped"
    head = ("Angle", "$L_2$ swapped", *ways, "ratio", "Skewness swapped", *ways)
    caption = (
        "Contours along lines of lattice nodes: $L_2$ error and mean skewness after swapping, after "
        "springs, and after both; the ratio is that of the errors without and with springs."
    )
    rows = [_repair(alignment.angle_of(rise, run)) for rise, run in alignment.SLOPES]
    return numbered("tab-repair", caption, grid(head, rows))


def _repair(angle: float) -> tuple:
    names = "swapped", "springs", "springs, swapped"
    errors, skewness = np.transpose([alignment.measures(name, angle) for name in names])
    ratio = f"{errors[0] / errors[-1]:.1f}"
    return f"{angle:.1f}°", *(f"{e:.4f}" for e in errors), ratio, *(f"{s:.2f}" for s in skewness)


def strategies() -> Markdown:
    """What each strategy reaches over all angles."""
    head = ("", "$L_2$ mean", "largest", "largest / least", "Skewness mean", "largest")
    caption = "The ramp on the lattice, over all angles: $L_2$ error and mean skewness of the mesh."
    rows = [(name, *_strategy(name)) for name in alignment.STRATEGIES]
    return numbered("tab-strategies", caption, grid(head, rows))


def _strategy(name: str) -> Iterator[str]:
    errors, skewness = alignment.curve(name)
    yield from (f"{errors.mean():.4f}", f"{errors.max():.4f}", f"{errors.max() / errors.min():.1f}")
    yield from (f"{skewness.mean():.2f}", f"{skewness.max():.2f}")


def constants() -> Markdown:
    """What other springs reach, and springs and swaps by turns."""
    springs = "First", "Second", "Power", "Rounds"
    head = (*springs, "Springs, mean", "largest", "Springs, swapped, mean", "largest")
    caption = "$L_2$ error for other weights and powers of the springs, and for springs and swaps by turns."
    trials = [(*constants, 1) for constants in alignment.CONSTANTS]
    trials += [(*alignment.DEFAULT, rounds) for rounds in alignment.ROUNDS[1:]]
    return numbered("tab-constants", caption, grid(head, [_constants(*trial) for trial in trials]))


def _constants(first: float, second: float, power: float, rounds: int) -> tuple:
    found = alignment.trial(first, second, power, rounds)
    cells = [f"{value:.4f}" for column in found.T for value in (column.mean(), column.max())]
    return *(f"{value:g}" for value in (first, second, power, rounds)), *cells


def elsewhere() -> Markdown:
    """Springs before swapping on the problems of the thesis."""
    head = ("Function", "Nodes", "Start", "Swapped", *(f"Weight {w}, swapped" for w in alignment.WEIGHTS))
    caption = (
        "$L_2$ error on the problems of the thesis, for three weights of the second derivative; where "
        "the springs find no rest, it depends on when they are stopped."
    )
    rows = [(*problem, *map(_or_no_rest, alignment.elsewhere(*problem))) for problem in alignment.ELSEWHERE]
    return numbered("tab-elsewhere", caption, grid(head, rows))


def _or_no_rest(error: float) -> str:
    return "no rest" if np.isnan(error) else f"{error:.4f}"
