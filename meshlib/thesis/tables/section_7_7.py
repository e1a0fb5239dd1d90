"""The tables of section 7.7, every cell computed."""

import numpy as np

from ..studies import section_7_7a_limit as limit
from ..studies import section_7_7b_conditioning as conditioning
from ..studies.section_7_7b_conditioning import LEAST_ANGLE
from .numbered import grid, numbered


def efficiencies():
    """The constant of each function, and how near its limit the meshes come."""
    rows = [
        (
            name,
            f"{limit.limit(name):.4f}",
            *(f"{e:.2f}" for e in limit.efficiencies(name)[0]),
            f"{limit.efficiencies(name)[1][-1]:.1f}",
        )
        for name in limit.FUNCTIONS
    ]
    head = ("", "$B$", *(f"{n} nodes" for n in limit.NODES), f"lattice, {limit.NODES[-1]}")
    caption = (
        "Error times number of elements, in units of the limit $B$: meshes made for the function, and "
        "in the last column a lattice."
    )
    return numbered("tab-7-7-efficiency", caption, grid(head, rows))


def directed():
    """Functions of one direction: error over that of parallel strips."""
    rows = []
    for name, u in limit.DIRECTED.items():
        errors = np.array([limit.error(limit.made(name, n).mesh, u) for n in limit.DIRECTED_NODES])
        strips = np.array([limit.strip_error(u, n) for n in limit.DIRECTED_NODES])
        rows.append((name, f"{limit.strip_constant(u):.4f}", *(f"{r:.2f}" for r in errors / strips)))
    head = ("", "$K$", *(f"{n} nodes" for n in limit.DIRECTED_NODES))
    caption = "Error of the meshes made for SR1 and SR2 over that of parallel strips with as many nodes."
    return numbered("tab-7-7-strips", caption, grid(head, rows))


def terrain():
    """Terrain on a lattice and on the mesh made for it: differences at all samples."""
    ground, rows = limit.terrain(), []
    for title, surface in (("lattice", ground.regular), ("made for it", ground.made)):
        away = ground.differences(surface)
        rows.append(
            (title, surface.mesh.n_nodes, f"{np.sqrt((away**2).mean()):.1f}", f"{np.abs(away).max():.0f}")
        )
    head = ("Mesh", "Nodes", "Root mean square, m", "Largest, m")
    caption = (
        f"Heights from {ground.heights.min():.0f} to {ground.heights.max():.0f} m at "
        f"{ground.heights.size} samples: how far the surface is from them."
    )
    return numbered("tab-7-7-terrain", caption, grid(head, rows))


def min_angle():
    """What a least angle costs in error, and spares in the condition number, beside a lattice."""
    plain, rows = limit.lattice(limit.SHOWN), []
    for name, u in limit.FUNCTIONS.items():
        free, kept = (limit.made(name, min_angle=a).mesh for a in (None, LEAST_ANGLE))
        meshes = free, kept, plain
        rows.append(
            (
                name,
                *(f"{limit.error(mesh, u):.1e}" for mesh in meshes),
                kept.n_nodes,
                *(_rounded(conditioning.conditions(mesh)[0]) for mesh in meshes),
            )
        )
    kinds = f"{LEAST_ANGLE:g}°", "lattice"
    head = ("", "Error, no limit", *kinds, f"Nodes, {kinds[0]}", "Condition, no limit", *kinds)
    caption = (
        f"Meshes for {limit.SHOWN} nodes without a limit on angles and with min_angle = "
        f"{LEAST_ANGLE:g}, and a lattice: $L_2$ error, nodes of the second, and condition number of "
        "the stiffness matrix."
    )
    return numbered("tab-7-7-angle", caption, grid(head, rows))


def conditions():
    """Condition numbers on meshes of the report."""
    rows = [
        (family, _title(name), mesh.n_nodes, *_row(conditioning.measured()[family, name]))
        for family, meshes in conditioning.families().items()
        for name, mesh in meshes.items()
    ]
    head = ("From", "Mesh", "Nodes", "Smallest angle", "Condition", "scaled")
    caption = (
        "Condition number of the stiffness matrix of the Poisson problem, as it is and scaled by its "
        "diagonal."
    )
    return numbered("tab-7-7-conditions", caption, grid(head, rows))


def _title(name):
    return name.removeprefix("start-").replace("-", " ")


def _row(found):
    angle, *numbers = found
    return f"{angle:.2f}°", *(_rounded(c) for c in numbers)


def _rounded(number):
    """Two significant digits; the last bits of a matrix do not show."""
    return f"{float(f'{number:.2g}'):,.0f}"
