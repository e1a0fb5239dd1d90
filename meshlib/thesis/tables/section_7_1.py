"""The tables of section 7.1, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ...refinement.splitting import SPLITS
from ..studies import section_7_1_splittings as splittings
from .markup import grid, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown


def needed() -> Markdown:
    """Nodes at which the error is a hundredth, by splitting and marking."""
    rows = [
        (*names, *(_needed(splittings.rounds(function, split, mark)) for mark in splittings.MARKINGS))
        for names, function, split in _lines()
    ]
    head = ("", "", *(f"by {mark}" for mark in splittings.MARKINGS))
    caption = (
        "Nodes needed until the $L_2$ error is a hundredth of that on the 33 nodes; in brackets, where a "
        f"mesh of {splittings.MOST_NODES} nodes or more came first, the error there in per cent of it."
    )
    return numbered("tab-7-1-nodes", caption, grid(head, rows))


def _lines() -> Iterator[tuple[tuple[str, str], str, str]]:
    """The first two cells of each row, its function and its splitting."""
    for function in splittings.FUNCTIONS:
        for split in SPLITS:
            yield (function * (split == next(iter(SPLITS))), split), function, split


def _needed(found: splittings.Rounds) -> str:
    share = 100 * found.errors[-1] / found.errors[0]
    return f"({share:.3g})" if np.isnan(found.needed) else str(int(float(f"{found.needed:.3g}")))


def reasons() -> Markdown:
    """What the closure adds and what shapes come out, marked by element."""
    angles = "Smallest angle", "Mean largest angle", "Largest kink"
    head = ("", "", "Elements changed for each one marked", *angles)
    caption = (
        "Marked by element: what has to change with each marked element, the "
        "angles of the last mesh, and the largest angle between normals there."
    )
    rows = [(*names, *_reasons(function, split)) for names, function, split in _lines()]
    return numbered("tab-7-1-reasons", caption, grid(head, rows))


def _reasons(function: str, split: str) -> tuple[str, ...]:
    found = splittings.rounds(function, split, "element")
    return (
        f"{found.changed:.1f}",
        f"{found.smallest_angles[-1]:.2f}°",
        f"{found.mean_largest_angle:.0f}°",
        f"{splittings.largest_kink(function, split):.0f}°",
    )
