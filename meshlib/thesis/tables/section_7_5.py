"""The tables of section 7.5, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ... import problems
from ..studies import section_7_5_combining as combining
from ..studies.appendix_b import settled_error
from .markup import grid, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown


def cycle() -> Markdown:
    """Each step of the cycle, with the rim of the patches left out and counted."""
    head = ("Rim", "Step", "Gain of the patch", "$J$ of the mesh before", "after")
    caption = "Two steps on a mesh of six nodes, criterion JND-$L_2$."
    rows = [row for rim, title in ((False, "left out"), (True, "counted")) for row in _cycle(rim, title)]
    return numbered("tab-7-5-cycle", caption, grid(head, rows))


def _cycle(rim: bool, title: str) -> Iterator[tuple]:
    found = combining.cycle(rim)
    before = [found.indicator, *found.history["indicator"]]
    for k, step in enumerate(found.history):
        costs = (f"{cost:.2f}" for cost in (step["gain"], before[k], step["indicator"]))
        yield title * (k == 0), f"{step['way']} around node {step['node']}", *costs


def errors() -> Markdown:
    """L2 errors at the start, and after each way alone, in turn, and patch by patch."""
    head = ("", "Start", "Swapped", "Moved", "In turn", "Combined", "No limit", "Flat at the boundary")
    caption = (
        f"$L_2$ error on the 33 nodes with no new angle below {combining.LIMIT:g}°: by either way alone, by "
        "both in turn, and by the better of both on each patch; and the last without that limit, with "
        f"the number of elements at the boundary that have an angle below {combining.FLAT}°."
    )
    rows = [(function, *_errors(function)) for function in combining.FUNCTIONS]
    return numbered("tab-7-5-errors", caption, grid(head, rows))


def _errors(function: str) -> Iterator[str]:
    u, meshes = problems.functions[function], combining.compared(function)
    yield from (f"{settled_error(mesh, u):.4f}" for mesh in meshes)
    yield "{} of {}".format(*combining.flat_at_the_boundary(meshes[-1]))


def gains(function: str = "SR1") -> Markdown:
    """Steps and error against the gain that a step must have."""
    head = ("Least gain $\\delta/J_0$", "Steps", "Sweeps", "$L_2$ error")
    caption = (
        f"The combined strategy for {function}, without a limit on angles, by the gain that a step must have."
    )
    rows = [(f"$10^{{-{power}}}$", *_gains(function, power)) for power in combining.POWERS]
    return numbered("tab-7-5-gains", caption, grid(head, rows))


def _gains(function: str, power: int) -> tuple:
    found = combining.adapted(function, limit=None, least_gain=10.0**-power)
    error = settled_error(found.mesh, problems.functions[function])
    return len(found.history), found.sweeps, f"{error:.5f}"
