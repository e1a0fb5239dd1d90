"""Algorithm 7.5.1 (section 7.5): a mesh on which it cycles, and the errors that it reaches."""

from functools import cache

import numpy as np

from ... import Mesh, combined, delaunay, problems
from ...combination.combined import LEAST_GAIN, Combination
from ...errors import NotReachedError
from ...mesh.quality import angles

FUNCTIONS = ("SR1", "SR2", "SR3", "DD1")
START = "33"
WAYS = {"swapped": "swap", "moved": "move", "combined": ("swap", "move")}
LIMIT = 10.0  # degrees, the smallest angle that a step may make
POWERS = tuple(range(1, 7))  # k in least gains of 10^-k
MOST_TURNS = 20
FLAT = 0.01  # degrees, an angle below which an element counts as flat
CYCLE_NODES = ((0, 0), (6, 0), (6, 3), (0, 3), (4, 1), (5, 2))


def ridge(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The distance |x - y|, which has a kink along the diagonal x = y."""
    return np.abs(x - y)


def cycle(rim: bool = False) -> Combination:
    """The combined strategy on a mesh to which, as written, it comes back.

    With ``rim`` the costs on the rim of a patch count, and it does not.

    Examples
    --------
    >>> found = cycle()
    >>> found.period, found.indicator, found.history["indicator"].round(2).tolist()
    (1, 9.5, [7.68, 9.5])
    """
    return combined(delaunay(CYCLE_NODES), ridge, "jnd", rim=rim)


@cache
def adapted(
    function: str, name: str = "combined", limit: float | None = LIMIT, least_gain: float = LEAST_GAIN
) -> Combination:
    """The combined strategy, or one of its ways alone, on the 33 nodes by the L2 error.

    Parameters
    ----------
    function : str
        Name of u in `meshlib.problems`.
    name : {"swapped", "moved", "combined"}
    limit : float or None
        Smallest angle, in degrees, that a step may make.
    least_gain : float
        Gain that a step must have, relative to the indicator at the start.

    Returns
    -------
    Combination
    """
    u = problems.functions[function]
    return combined(problems.mesh(START), u, ways=WAYS[name], min_angle=limit, min_relative_gain=least_gain)


def in_turn(function: str) -> Mesh:
    """The mesh after swapping alone and moving alone by turns, until neither gains on any patch."""
    u, mesh = problems.functions[function], problems.mesh(START)
    for _ in range(MOST_TURNS):
        before = mesh
        for way in WAYS["combined"]:
            mesh = combined(mesh, u, ways=way, min_angle=LIMIT).mesh
        if mesh.equals(before):
            return mesh
    raise NotReachedError("turns", f"no end after {MOST_TURNS} turns")


def compared(function: str) -> tuple[Mesh, ...]:
    """Six meshes of 33 nodes: start, swapped, moved, in turn, combined, combined without a limit."""
    alone = (adapted(function, name).mesh for name in ("swapped", "moved"))
    free = adapted(function, limit=None).mesh
    return problems.mesh(START), *alone, in_turn(function), adapted(function).mesh, free


def flat_at_the_boundary(mesh: Mesh) -> tuple[int, int]:
    """Number of elements at the boundary with an angle below `FLAT`, and of all elements there."""
    there = mesh.boundary[mesh.element_edges].any(axis=1)
    flat = np.degrees(angles(mesh.corners).min(axis=1)) < FLAT
    return int(np.count_nonzero(there & flat)), int(np.count_nonzero(there))
