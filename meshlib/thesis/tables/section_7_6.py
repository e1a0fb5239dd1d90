"""The tables of the section on annealing, every cell computed."""

import numpy as np

from ..studies import section_7_6_beyond as beyond
from .appendix_b import percent
from .numbered import grid, numbered


def distances():
    """What swapping and annealing reach where all meshes can be listed."""
    head = (
        "Criterion",
        "Swapping finds the best",
        "costs more, mean",
        "largest",
        "Annealing finds the best",
        "costs more, mean",
        "largest",
    )
    rows = [(beyond.title(*case), *_reached(beyond.distances(*case))) for case in beyond.CASES]
    meshes = beyond.numbers_of_meshes()
    caption = (
        f"{len(beyond.FUNCTIONS)} functions on {beyond.SETS} sets of {beyond.NODES} nodes with "
        f"{meshes.min()} to {meshes.max()} meshes each: in how many of these cases the best of all "
        f"is found, and what is paid above it. Annealing has {beyond.LEVELS} temperatures and "
        f"{beyond.TRIES} tries for each edge."
    )
    return numbered("tab-distances", caption, grid(head, rows))


def _reached(found):
    for way in ("swapped", "annealed"):
        excess = 100 * found.excess(way)
        yield from (percent(found.share(way)), *(f"{e:.1f} %" for e in (excess.mean(), excess.max())))


def large():
    """What they reach on the start meshes of the thesis, beside the proved optimum."""
    head = (
        "Problem",
        "Swapped",
        f"Best of {beyond.ORDERS} orders",
        "Annealed, median",
        "least",
        "Proved optimum",
        "$L_2$ swapped",
        "annealed",
        "optimum",
    )
    rows = [_large(*case) for case in beyond.LARGE]
    caption = (
        f"Costs on the start meshes of the thesis, annealed with {len(beyond.SEEDS)} seeds by the "
        "default schedule, and $L_2$ errors of three of the meshes."
    )
    return numbered("tab-annealed", caption, grid(head, rows))


def _large(nodes, function, name, norm):
    found = beyond.large(nodes, function, name, norm)
    costs = found.swapped, found.orders, np.median(found.annealed), found.annealed.min(), found.best
    errors = found.error_swapped, found.error_annealed, found.error_best
    return (
        f"{function}, {nodes}, {beyond.title(name, norm)}",
        *(f"{cost:.2f}" for cost in costs),
        *(f"{error:.4f}" for error in errors),
    )
