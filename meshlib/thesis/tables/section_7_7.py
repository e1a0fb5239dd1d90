"""The tables of section 7.7, every cell computed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import Interpolant
from ..studies import section_7_7a_limit as limit
from ..studies import section_7_7b_conditioning as conditioning
from ..studies.section_7_7b_conditioning import LEAST_ANGLE
from .markup import grid, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown


def efficiencies() -> Markdown:
    """The constant of each function, and how near its limit the meshes come."""
    head = ("", "$B$", *(f"{n} nodes" for n in limit.NODES), f"lattice, {limit.NODES[-1]}")
    caption = (
        "Error times number of elements, in units of the limit $B$: meshes made for the function, and "
        "in the last column a lattice."
    )
    rows = [(name, f"{limit.limit(name):.4f}", *_efficiencies(name)) for name in limit.FUNCTIONS]
    return numbered("tab-7-7-efficiency", caption, grid(head, rows))


def _efficiencies(name: str) -> tuple[str, ...]:
    made, lattice = limit.efficiencies(name)
    return *(f"{efficiency:.2f}" for efficiency in made), f"{lattice[-1]:.1f}"


def directed() -> Markdown:
    """Functions of one direction: error over that of parallel strips."""
    head = ("", "$K$", *(f"{n} nodes" for n in limit.DIRECTED_NODES))
    caption = "Error of the meshes made for SR1 and SR2 over that of parallel strips with as many nodes."
    rows = [
        (name, f"{limit.strip_constant(u):.4f}", *(f"{r:.2f}" for r in limit.over_strips(name)))
        for name, u in limit.DIRECTED.items()
    ]
    return numbered("tab-7-7-strips", caption, grid(head, rows))


def terrain() -> Markdown:
    """Terrain on a lattice and on the mesh made for it: differences at all samples."""
    ground = limit.terrain()
    head = ("Mesh", "Nodes", "Root mean square, m", "Largest, m")
    caption = (
        f"Heights from {ground.heights.min():.0f} to {ground.heights.max():.0f} m at "
        f"{ground.heights.size} samples: how far the surface is from them."
    )
    surfaces = {"lattice": ground.regular, "made for it": ground.made}
    rows = [(title, *_differences(ground, surface)) for title, surface in surfaces.items()]
    return numbered("tab-7-7-terrain", caption, grid(head, rows))


def _differences(ground: limit.Terrain, surface: Interpolant) -> tuple:
    away = ground.differences(surface)
    return surface.mesh.n_nodes, f"{np.sqrt((away**2).mean()):.1f}", f"{np.abs(away).max():.0f}"


def min_angle() -> Markdown:
    """What a least angle costs in error, and spares in the condition number, beside a lattice."""
    kinds = f"{LEAST_ANGLE:g}°", "lattice"
    head = ("", "Error, no limit", *kinds, f"Nodes, {kinds[0]}", "Condition, no limit", *kinds)
    caption = (
        f"Meshes for {limit.SHOWN} nodes without a limit on angles and with min_angle = "
        f"{LEAST_ANGLE:g}, and a lattice: $L_2$ error, nodes of the second, and condition number of "
        "the stiffness matrix."
    )
    rows = [(name, *_min_angle(name)) for name in limit.FUNCTIONS]
    return numbered("tab-7-7-angle", caption, grid(head, rows))


def _min_angle(name: str) -> tuple:
    free, kept = (limit.made(name, min_angle=a).mesh for a in (None, LEAST_ANGLE))
    meshes = free, kept, limit.lattice(limit.SHOWN)
    errors = (f"{limit.error(mesh, limit.FUNCTIONS[name]):.1e}" for mesh in meshes)
    return *errors, kept.n_nodes, *(_rounded(conditioning.conditions(mesh)[0]) for mesh in meshes)


def conditions() -> Markdown:
    """Condition numbers on meshes of the report."""
    head = ("From", "Mesh", "Nodes", "Smallest angle", "Condition", "scaled")
    caption = (
        "Condition number of the stiffness matrix of the Poisson problem, as it is and scaled by its "
        "diagonal."
    )
    rows = [
        (family, _title(name), mesh.n_nodes, *_row(*conditioning.measured()[family, name]))
        for family, meshes in conditioning.families().items()
        for name, mesh in meshes.items()
    ]
    return numbered("tab-7-7-conditions", caption, grid(head, rows))


def _title(name: str) -> str:
    return name.removeprefix("start-").replace("-", " ")


def _row(angle: float, plain: float, scaled: float) -> tuple[str, ...]:
    return f"{angle:.2f}°", _rounded(plain), _rounded(scaled)


def _rounded(number: float) -> str:
    """The number with two significant digits, so that the last bits of a matrix do not show."""
    return f"{float(f'{number:.2g}'):,.0f}"
