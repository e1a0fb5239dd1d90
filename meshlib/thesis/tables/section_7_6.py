"""The tables of section 7.6, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..studies import section_7_6_beyond as beyond
from .markup import grid, numbered, percent

if TYPE_CHECKING:
    from IPython.display import Markdown


def distances() -> Markdown:
    """What swapping and annealing reach where all meshes can be listed."""
    excess = "costs more, mean", "largest"
    head = ("Criterion", "Swapping finds the best", *excess, "Annealing finds the best", *excess)
    meshes = beyond.numbers_of_meshes()
    caption = (
        f"{len(beyond.FUNCTIONS)} functions on {beyond.SETS} sets of {beyond.NODES} nodes with "
        f"{meshes.min()} to {meshes.max()} meshes each: in how many of these cases the best of all "
        f"is found, and what is paid above it. Annealing has {beyond.LEVELS} temperatures and "
        f"{beyond.TRIES} tries for each edge."
    )
    rows = [(beyond.title(*case), *_reached(beyond.distances(*case))) for case in beyond.CASES]
    return numbered("tab-distances", caption, grid(head, rows))


def _reached(found: beyond.Distances) -> Iterator[str]:
    for way in ("swapped", "annealed"):
        excess = 100 * found.excess(way)
        yield from (percent(found.share(way)), *(f"{e:.1f} %" for e in (excess.mean(), excess.max())))


def large() -> Markdown:
    """What swapping and annealing reach on the start meshes of the thesis, beside the proved optimum."""
    costs = "Swapped", f"Best of {beyond.ORDERS} orders", "Annealed, median", "least", "Proved optimum"
    head = ("Problem", *costs, "$L_2$ swapped", "annealed", "optimum")
    caption = (
        f"Costs on the start meshes of the thesis, annealed with {len(beyond.SEEDS)} seeds by the "
        "default schedule, and $L_2$ errors of three of the meshes."
    )
    return numbered("tab-annealed", caption, grid(head, [_large(*case) for case in beyond.LARGE]))


def _large(nodes: str, function: str, name: str, norm: int) -> tuple:
    found = beyond.large(nodes, function, name, norm)
    costs = found.swapped, found.orders, np.median(found.annealed), found.annealed.min(), found.best
    errors = found.error_swapped, found.error_annealed, found.error_best
    problem = f"{function}, {nodes}, {beyond.title(name, norm)}"
    return problem, *(f"{cost:.2f}" for cost in costs), *(f"{error:.4f}" for error in errors)
