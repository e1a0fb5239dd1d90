"""The tables of section 7.2, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ... import Mesh, uniformity, valence
from ..studies import section_7_2_boundaries as boundaries
from ..studies.section_7_5_combining import LIMIT
from .markup import grid, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown

BETWEEN_NEIGHBOURS = "The same between neighbours"
COUNTS = tuple(f"$n = {n}$" for n in boundaries.NODES)


def measures() -> Markdown:
    """Uniformity and valence of meshes for SR1."""
    head = ("Mesh", "Nodes", "Elements", "Uniformity, mean", "max", "Valence, mean", "max")
    caption = (
        f"Uniformity and valence for {boundaries.FUNCTION}: the start mesh, the same nodes swapped, "
        f"smoothed and combined (no angle below {LIMIT:g}°), and every element split once."
    )
    rows = [(name, *_measures(mesh)) for name, mesh in boundaries.meshes().items()]
    return numbered("tab-7-2-measures", caption, grid(head, rows))


def _measures(mesh: Mesh) -> tuple:
    un, val = uniformity(mesh), valence(mesh)
    areas = f"{un.mean():.2f}", f"{un.max():.1f}"
    return mesh.n_nodes, mesh.n_elements, *areas, f"{val.mean():.3f}", val.max()


def lost() -> Markdown:
    """n^2 times the area lost, and its limit."""
    head = ("", BETWEEN_NEIGHBOURS, *COUNTS, "$n \\to \\infty$")
    caption = (
        "$n^2$ times the area between the curve and the polygon with $n$ nodes, and the limit by theory."
    )
    rows = [
        (name if density == "curvature" else "", title, *_lost(name, density))
        for name in boundaries.CURVES
        for density, title in boundaries.DENSITIES.items()
    ]
    return numbered("tab-7-2-lost", caption, grid(head, rows))


def _lost(name: str, density: str) -> Iterator[str]:
    found = *boundaries.lost(name, density), boundaries.limits(name)[density]
    return (f"{value:.2f}" for value in found)


def missed(name: str = "trefoil", function: str = "SR1") -> Markdown:
    """n^2 times the error along the boundary, by the data and by arc length."""
    head = (BETWEEN_NEIGHBOURS, *COUNTS, "$n \\to \\infty$")
    caption = (
        f"$n^2$ times the $L_2$ error of linear interpolation of {function} along the boundary of the "
        f"{name} between $n$ nodes."
    )
    limit = f"{boundaries.missed_limit(name, function):.3f}"
    cases = (r"$\lvert u_{ss}\rvert^{2/5}$", True, limit), ("arc length", False, "")
    rows = [
        (title, *(f"{value:.3f}" for value in boundaries.missed(name, function, by_data)), last)
        for title, by_data, last in cases
    ]
    return numbered("tab-7-2-data", caption, grid(head, rows))
