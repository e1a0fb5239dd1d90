"""How far local optima are from the best mesh, by listing all meshes, and how near annealing comes."""
from dataclasses import dataclass
from functools import cache

import numpy as np

from .. import Mesh, annealed, criteria, optimal, problems, swapped
from ..enumeration import enumerated
from .measures import l2_error
from .studies import small_mesh

SETS, NODES = 20, 10
FUNCTIONS = "SR2", "franke"
L2_ERROR, DEGREE = "min-error", 20  # of the quadrature, for elements are large
CRITERIA = (*criteria.names("edge"), *criteria.names("element"), L2_ERROR)
NORMS = 1, 2
LEVELS, TRIES = 40, 10  # of annealing where there are few meshes
SAME = 1e-9  # relative difference of costs that are the same
LARGE = (("33", "SR1"), ("33", "SR2"), ("81", "SR3"), ("81", "franke"))
LARGE_CRITERIA = ("jnd", 2), ("abn", 1)
SEEDS = range(5)


@dataclass(frozen=True)
class Distances:
    """Costs of small sets of nodes, one entry for each set and function.

    Attributes
    ----------
    best, swapped, annealed : (n,) ndarray of float64
    """

    best: np.ndarray
    swapped: np.ndarray
    annealed: np.ndarray

    def ratios(self, way):
        """Cost over that of the best mesh, for ``"swapped"`` or ``"annealed"``."""
        return getattr(self, way) / self.best

    def share(self, way):
        """Share of the cases in which the best mesh is found."""
        return float((self.ratios(way) <= 1 + SAME).mean())


def criterion_of(name, function):
    """The criterion of that name for a function."""
    return criteria.min_error(function, DEGREE) if name == L2_ERROR else criteria.get(name)


@cache
def small_case(seed):
    """A Delaunay mesh of few random nodes, and all its meshes side by side."""
    start = small_mesh(NODES, seed)
    return start, side_by_side(start, enumerated(start))


def side_by_side(start, elements):
    """Many meshes of the same nodes as one of many parts."""
    count, n = len(elements), start.n_nodes
    rows = elements + n * np.arange(count, dtype=np.int32)[:, None, None]
    return Mesh._trusted(np.tile(start.nodes, (count, 1)), rows.reshape(-1, 3))


def costs_of_parts(start, every, values, criterion, norm):
    """Norm of the cost vector of each mesh of `side_by_side`.

    Examples
    --------
    >>> (start, every), values = small_case(0), np.arange(10.0) ** 2
    >>> costs = costs_of_parts(start, every, values, criteria.get("jnd"), 1)
    >>> bool(np.isclose(costs[0], criteria.costs(start, values).sum()))
    True
    """
    count = every.n_elements // start.n_elements
    vector = criterion.costs(every, np.tile(values, count))
    first = every.edges[:, 0] if criterion.on == "edge" else every.elements[:, 0]
    return np.bincount(first // start.n_nodes, vector ** norm, count) ** (1 / norm)


@cache
def distances(name, norm, sets=SETS):
    """What swapping and annealing reach on small sets of nodes, beside the best of all meshes.

    Parameters
    ----------
    name : str
        One of `CRITERIA`.
    norm : {1, 2}
    sets : int

    Returns
    -------
    Distances
    """
    rows = []
    for function in FUNCTIONS:
        u = problems.functions[function]
        criterion = criterion_of(name, u)
        for seed in range(sets):
            start, every = small_case(seed)
            best = costs_of_parts(start, every, u(*start.nodes.T), criterion, norm).min()
            found = annealed(start, u, criterion, norm, seed, LEVELS, TRIES)
            rows.append((best, found.cost_swapped, found.cost_after))
    return Distances(*np.transpose(rows))


@dataclass(frozen=True)
class Large:
    """A larger problem: costs, and L2 errors, of what swapping and annealing reach.

    Attributes
    ----------
    start, swapped, best : float
        Costs; the last is proved to be the least.
    annealed : (n,) ndarray of float64
        Costs, one for each seed.
    error_swapped, error_annealed : float
        L2 errors; the second of the mesh of the first seed of least cost.
    """

    start: float
    swapped: float
    annealed: np.ndarray
    best: float
    error_swapped: float
    error_annealed: float


@cache
def large(nodes, function, name, norm):
    """Swapping and annealing on a start mesh of the thesis."""
    mesh, u = problems.mesh(nodes), problems.functions[function]
    runs = [annealed(mesh, u, name, norm, seed) for seed in SEEDS]
    best = min(runs, key=lambda run: run.cost_after)
    errors = (l2_error(found.mesh, u) for found in (swapped(mesh, u, name, norm), best))
    return Large(best.cost_before, best.cost_swapped, np.array([run.cost_after for run in runs]),
                 optimal(mesh, u, name, norm).cost, *errors)
