"""Algorithm 7.5.1 (section 7.5): a mesh on which it cycles, that it ends, and what it reaches."""

from functools import cache

import numpy as np

from ... import combined, delaunay, problems
from ...combination.combined import LEAST_GAIN
from ...errors import NotReachedError
from ...mesh.quality import angles
from ..tables.numbered import grid, numbered
from .appendix_b import settled_error

FUNCTIONS = ("SR1", "SR2", "SR3", "DD1")
START = "33"
WAYS = {"swapped": "swap", "moved": "move", "combined": ("swap", "move")}
LIMIT = 10.0  # degrees
POWERS = tuple(range(1, 7))  # of the least gain
MOST_TURNS = 20
FLAT = 0.01  # degrees
CYCLE_NODES = ((0, 0), (6, 0), (6, 3), (0, 3), (4, 1), (5, 2))


def ridge(x, y):
    """Its kink is the diagonal x = y."""
    return np.abs(x - y)


def cycle(rim=False):
    """The combined strategy on the mesh on which, as written, it comes back to where it was.

    Examples
    --------
    >>> found = cycle()
    >>> found.period, found.indicator, found.history["indicator"].round(2).tolist()
    (1, 9.5, [7.68, 9.5])
    """
    return combined(delaunay(CYCLE_NODES), ridge, "jnd", rim=rim)


def table_cycle():
    """Each step of it, with the rim of the patches left out and counted."""
    rows = []
    for rim, title in ((False, "left out"), (True, "counted")):
        found = cycle(rim)
        before = [found.indicator, *found.history["indicator"]]
        rows += [
            (
                title * (k == 0),
                f"{step['way']} around node {step['node']}",
                f"{step['gain']:.2f}",
                f"{before[k]:.2f}",
                f"{step['indicator']:.2f}",
            )
            for k, step in enumerate(found.history)
        ]
    head = ("Rim", "Step", "Gain of the patch", "$J$ of the mesh before", "after")
    caption = "Two steps on a mesh of six nodes, criterion JND-$L_2$."
    return numbered("tab-7-5-cycle", caption, grid(head, rows))


@cache
def adapted(function, name="combined", limit=LIMIT, least_gain=LEAST_GAIN):
    """The combined strategy, or one of its ways alone, on the 33 nodes by the L2 error.

    Parameters
    ----------
    function : str
        Name of u in `meshlib.problems`.
    name : {"swapped", "moved", "combined"}
    limit : float or None
        Smallest angle, in degrees, that a step may make.
    least_gain : float

    Returns
    -------
    Combination
    """
    u = problems.functions[function]
    return combined(problems.mesh(START), u, ways=WAYS[name], min_angle=limit, min_relative_gain=least_gain)


def in_turn(function):
    """The mesh after swapping alone until no patch gains, then moving alone, and so on."""
    u, mesh = problems.functions[function], problems.mesh(START)
    for _ in range(MOST_TURNS):
        before = mesh
        for way in WAYS["combined"]:
            mesh = combined(mesh, u, ways=way, min_angle=LIMIT).mesh
        if mesh.equals(before):
            return mesh
    raise NotReachedError("turns", f"no end after {MOST_TURNS} turns")


def table_errors():
    """L2 errors at the start, and after each way alone, in turn, and patch by patch."""
    rows = []
    for function in FUNCTIONS:
        meshes = [
            problems.mesh(START),
            *(adapted(function, name).mesh for name in ("swapped", "moved")),
            in_turn(function),
            adapted(function).mesh,
            adapted(function, limit=None).mesh,
        ]
        u = problems.functions[function]
        errors = (f"{settled_error(mesh, u):.4f}" for mesh in meshes)
        rows.append((function, *errors, _flat_at_the_boundary(meshes[-1])))
    head = ("", "Start", "Swapped", "Moved", "In turn", "Combined", "No limit", "Flat at the boundary")
    caption = (
        f"$L_2$ error on the 33 nodes with no new angle below {LIMIT:g}°: by either way alone, by "
        "both in turn, and by the better of both on each patch; and the last without that limit, with "
        f"the number of elements at the boundary that have an angle below {FLAT}°."
    )
    return numbered("tab-7-5-errors", caption, grid(head, rows))


def _flat_at_the_boundary(mesh):
    """How many of the elements with an edge on the boundary are slivers, in words."""
    there = mesh.boundary[mesh.element_edges].any(axis=1)
    flat = np.degrees(angles(mesh.corners).min(axis=1)) < FLAT
    return f"{np.count_nonzero(there & flat)} of {np.count_nonzero(there)}"


def table_gains(function="SR1"):
    """Steps and error against the gain that a step must have."""
    u, rows = problems.functions[function], []
    for power in POWERS:
        found = adapted(function, limit=None, least_gain=10.0**-power)
        error = f"{settled_error(found.mesh, u):.5f}"
        rows.append((f"$10^{{-{power}}}$", len(found.history), found.sweeps, error))
    head = ("Least gain $\\delta/J_0$", "Steps", "Sweeps", "$L_2$ error")
    caption = (
        f"The combined strategy for {function}, without a limit on angles, by the gain that a step must have."
    )
    return numbered("tab-7-5-gains", caption, grid(head, rows))
