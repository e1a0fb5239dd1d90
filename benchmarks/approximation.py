"""Meshes made for functions, beside peers: ``python approximation.py Franke 100 400``.

Prints a JSON list with a line for each mesh.  Ours and the peers take turns, so that
a slow spell of the machine hits all of them.
"""

import json
import sys
import time

import numpy as np
from remeshing import STEP, delatin, mmg2d

from meshlib import MeshError, approximate, problems
from meshlib.interpolation.on_elements import squared_errors
from meshlib.thesis.studies import section_7_7a_limit as limit
from meshlib.thesis.studies.appendix_b import quartered

SEEDS = range(3)
FLOORS = tuple(
    10.0**-k for k in range(1, 7)
)  # smallest eigenvalues of MMG's metric, as fractions of the largest
STEPS = {"DD1": (3e-3, 1e-2)}  # steps of the differences: shorter ones hardly see the kinks
TRY_ALL = 1600  # largest number of nodes for which all floors are tried
NEIGHBOURS = 1  # floors tried on either side of the best one, for more nodes
MOST_BY_MAX = (
    6400  # largest number of nodes of meshes for the largest error, which take several times as long
)
WARM = 100  # nodes of the first mesh, which compiles everything
TOLERANCE_NODES = 400  # nodes of the mesh whose error is the tolerance
DIGITS = 6  # significant digits of stored numbers
FIRST_DEGREE = 12  # degree of the quadrature that confirms an error
LEVELS = 8  # how often it divides an element into four, at most
SETTLED = 1e-4  # change at which it stops, as a fraction of the mean part of an element
POINTS = 2_000_000  # points, in all, at which the largest error is looked for
FEWEST, MOST = 8, 100  # intervals between these points along the side of an element


def arc(x, y):
    """A front of width 1/60 along an arc that leaves the domain on two sides."""
    return np.tanh(60 * (np.hypot(x - 0.1, y + 0.1) - 0.75))


def mixture(x, y):
    """A hill, a saddle between two dips and two rises, and nearly flat parts."""
    hill = np.exp(-50 * ((x - 0.3) ** 2 + (y - 0.3) ** 2))
    s, t = x - 0.7, y - 0.7
    return hill + 20 * s * t * np.exp(-20 * (s * s + t * t)) + 1e-3 * (x * x + y * y)


FUNCTIONS = (
    limit.FUNCTIONS
    | limit.DIRECTED
    | {
        "x² + y²": problems.functions["convex"],
        "x² − y²": problems.functions["hyperbolic"],
        "arc": arc,
        "mixture": mixture,
    }
)


def bounds():
    """The constant B of every function that has one, and K of the others."""
    curved = [name for name in FUNCTIONS if name not in limit.DIRECTED]
    return {
        "B": {name: limit.constant(FUNCTIONS[name], limit.BOXES.get(name, limit.SQUARE)) for name in curved},
        "K": {name: limit.strip_constant(u) for name, u in limit.DIRECTED.items()},
    }


# -- errors --------------------------------------------------------------------------------------


def confirmed(mesh, function):
    """L2 error by an independent quadrature: elements are divided into four until the integral settles."""
    corners, values = mesh.corners, function(*mesh.nodes.T)[mesh.elements]
    coarse, done = squared_errors(corners, values, function, FIRST_DEGREE), 0.0
    for _ in range(LEVELS):
        corners, values = quartered(corners), quartered(values)
        fine = squared_errors(corners, values, function, FIRST_DEGREE)
        sums = fine.reshape(4, -1).sum(axis=0)
        settled = np.abs(sums - coarse) <= SETTLED * (done + sums.sum()) / mesh.n_elements
        done += sums[settled].sum()
        unsettled = np.tile(~settled, 4)
        corners, values, coarse = corners[unsettled], values[unsettled], fine[unsettled]
    return float(np.sqrt(done + coarse.sum()))


def largest(mesh, function):
    """The largest error at a lattice of points in every element."""
    side = int(np.clip(np.sqrt(2 * POINTS / mesh.n_elements), FEWEST, MOST))
    i, j = (k.ravel() for k in np.mgrid[: side + 1, : side + 1])
    weights = np.column_stack([i, j, side - i - j])[i + j <= side] / side
    values, found = function(*mesh.nodes.T)[mesh.elements], 0.0
    for corners, three in zip(
        *(np.array_split(a, 1 + len(weights) * len(a) // POINTS) for a in (mesh.corners, values)), strict=True
    ):
        x, y = np.moveaxis(weights @ corners, -1, 0)
        found = max(found, float(np.abs(function(x, y) - three @ weights.T).max()))
    return found


# -- lines ---------------------------------------------------------------------------------------


def line(name, who, nodes, mesh, seconds, **more):
    """The numbers that are stored for a mesh."""
    numbers = {"error": confirmed(mesh, FUNCTIONS[name]), "seconds": seconds} | more
    return {
        "function": name,
        "who": who,
        "nodes": nodes,
        "found": mesh.n_nodes,
        "elements": mesh.n_elements,
    } | {key: _rounded(value) for key, value in numbers.items()}


def _rounded(value):
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def timed(call, *arguments, **options):
    """The result of a call, and its time in seconds."""
    start = time.perf_counter()
    found = call(*arguments, **options)
    return found, time.perf_counter() - start


def ours(name, nodes):
    """Our mesh for every seed."""
    for seed in SEEDS:
        found, seconds = timed(approximate, FUNCTIONS[name], nodes, seed=seed)
        yield line(
            name,
            "ours",
            nodes,
            found.mesh,
            seconds,
            seed=seed,
            claimed=found.error,
            largest=largest(found.mesh, FUNCTIONS[name]),
            valid=_valid(found.mesh),
        )


def _valid(mesh):
    try:
        mesh.validate()
    except MeshError:
        return False
    return bool((mesh.areas > 0).all())


def ours_by_max(name, nodes):
    """Our mesh for the largest error."""
    if nodes > MOST_BY_MAX:
        return
    found, seconds = timed(approximate, FUNCTIONS[name], nodes, norm="max")
    yield line(name, "ours, max", nodes, found.mesh, seconds, largest=largest(found.mesh, FUNCTIONS[name]))


def greedy(name, nodes):
    """The mesh of pydelatin."""
    mesh, seconds = timed(delatin, FUNCTIONS[name], nodes)
    yield line(name, "pydelatin", nodes, mesh, seconds, largest=largest(mesh, FUNCTIONS[name]))


def remeshed(name, nodes, floors):
    """The meshes of MMG for some floors of the eigenvalues, and steps of the differences."""
    for floor in floors:
        for step in STEPS.get(name, (STEP,)):
            mesh, seconds = timed(mmg2d, FUNCTIONS[name], nodes, floor, step)
            yield line(name, "mmg2d", nodes, mesh, seconds, floor=floor, step=step)


def floors_for(nodes, before):
    """Which floors to try, given the lines of MMG for fewer nodes."""
    if nodes <= TRY_ALL or not before:
        return FLOORS
    last = [row for row in before if row["nodes"] == before[-1]["nodes"]]
    best = FLOORS.index(min(last, key=lambda row: row["error"] * row["found"])["floor"])
    return FLOORS[max(best - NEIGHBOURS, 0) : best + NEIGHBOURS + 1]


def by_tolerance(name):
    """Number of nodes for a tolerance, and the smallest number that bisection finds for it."""
    u = FUNCTIONS[name]
    tolerance = approximate(u, nodes=TOLERANCE_NODES).error
    found, seconds = timed(approximate, u, tolerance=tolerance)
    low, high = TOLERANCE_NODES // 2, TOLERANCE_NODES
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if approximate(u, nodes=middle).error <= tolerance else (middle, high)
    yield line(name, "tolerance", TOLERANCE_NODES, found.mesh, seconds, tolerance=tolerance, bisected=high)


def measured(name, sizes):
    """All lines of one function."""
    approximate(FUNCTIONS[name], nodes=WARM)
    lines = list(by_tolerance(name)) if TOLERANCE_NODES in sizes else []
    for nodes in sizes:
        before = [row for row in lines if row["who"] == "mmg2d"]
        for rows in (
            ours(name, nodes),
            remeshed(name, nodes, floors_for(nodes, before)),
            greedy(name, nodes),
            ours_by_max(name, nodes),
        ):
            lines += rows
    return lines


if __name__ == "__main__":
    print(json.dumps(measured(sys.argv[1], [int(n) for n in sys.argv[2:]])))
