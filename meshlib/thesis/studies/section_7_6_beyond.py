"""How far local optima are from the best mesh, by listing all meshes, and how near annealing comes."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Mesh, annealed, criteria, local_optima, optimal, problems, swapped
from ...optima.enumeration import enumerated
from .appendix_b import small_mesh
from .measures import l2_error

SETS, NODES = 12, 10
FUNCTIONS = "SR2", "franke"
TWELVE = "franke", 5, 12  # function, seed and number of nodes: swapping misses the best for each of `LISTED`
L2_ERROR, DEGREE = "min-error", 12  # of the quadrature, for elements are large
NORMS = 1, 2
NC1, ANGLES = ("jnd", "abn", "dlp", "dfp"), ("smallest-angle", "largest-angle")
CASES = (*((name, norm) for name in (*NC1, *ANGLES) for norm in NORMS), (L2_ERROR, 2))
LISTED = ("jnd", 2), ("abn", 1), ("dlp", 1), ("dfp", 2)  # whose costs of all meshes are shown
LEVELS, TRIES = 20, 40  # of annealing where there are few meshes
SAME = 1e-9  # relative difference of costs that are the same
LARGE = ("33", "SR2", "jnd", 2), ("81", "SR3", "abn", 1), ("81", "franke", "abn", 1)  # proofs take seconds
SEEDS = range(5)
ORDERS = 1000


def title(name, norm):
    """A criterion for people, for example ``"JND-$L_2$"``."""
    if name == L2_ERROR:
        return "$L_2$ error"
    return f"{name.upper()}-$L_{norm}$" if name in NC1 else f"{name.replace('-', ' ')}, $L_{norm}$"


# -- all meshes of few nodes -------------------------------------------------------------------


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

    def excess(self, way):
        """How much ``"swapped"`` or ``"annealed"`` costs more than the best mesh, relative to that."""
        return np.maximum(getattr(self, way) / self.best - 1, 0)

    def share(self, way):
        """Share of the cases in which the best mesh is found."""
        return float((self.excess(way) <= SAME).mean())


def criterion_of(name, function):
    """The criterion of that name for a function."""
    return criteria.min_error(function, degree=DEGREE) if name == L2_ERROR else criteria.get(name)


@cache
def small_case(seed, nodes=NODES):
    """A Delaunay mesh of few random nodes, and all its meshes side by side."""
    start = small_mesh(nodes, seed)
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
    return np.bincount(first // start.n_nodes, vector**norm, count) ** (1 / norm)


@cache
def listed(name, norm, function, seed, nodes=NODES):
    """The costs of all meshes of a small set of nodes, the start mesh first, and what annealing makes of it.

    Returns
    -------
    costs : (M,) ndarray of float64
    run : Annealing
    """
    start, every = small_case(seed, nodes)
    u = problems.functions[function]
    criterion = criterion_of(name, u)
    costs = costs_of_parts(start, every, u(*start.nodes.T), criterion, norm)
    return costs, annealed(start, u, criterion, norm=norm, seed=seed, levels=LEVELS, tries=TRIES)


@cache
def distances(name, norm, sets=SETS):
    """What swapping and annealing reach on small sets of nodes, beside the best of all meshes.

    Parameters
    ----------
    name : str
        Of a criterion, or `L2_ERROR`.
    norm : {1, 2}
    sets : int

    Returns
    -------
    Distances
    """
    found = [listed(name, norm, function, seed) for function in FUNCTIONS for seed in range(sets)]
    rows = [(costs.min(), run.cost_swapped, run.cost_after) for costs, run in found]
    return Distances(*np.transpose(rows))


def numbers_of_meshes():
    """(sets,) int64: how many meshes each small set of nodes has."""
    return np.array([len(listed(*LISTED[0], FUNCTIONS[0], seed)[0]) for seed in range(SETS)])


# -- more nodes ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Large:
    """A larger problem: costs, and L2 errors, of what swapping and annealing reach.

    Attributes
    ----------
    swapped, orders, best : float
        Costs: after swapping in natural order, the least of `ORDERS` random orders, and
        the proved least of all meshes.
    annealed : (n,) ndarray of float64
        Costs, one for each seed.
    error_swapped, error_annealed, error_best : float
        L2 errors; the second of the mesh of the first seed of least cost.
    """

    swapped: float
    orders: float
    best: float
    annealed: np.ndarray
    error_swapped: float
    error_annealed: float
    error_best: float


@cache
def annealing(nodes, function, name, norm, seed):
    """Annealing on a start mesh of the thesis."""
    return annealed(problems.mesh(nodes), problems.functions[function], name, norm=norm, seed=seed)


def in_natural_order(nodes, function, name, norm):
    """The mesh that swapping alone leads to, where annealing starts."""
    return swapped(problems.mesh(nodes), problems.functions[function], name, norm=norm).mesh


@cache
def large(nodes, function, name, norm):
    """Swapping, annealing and proof on a start mesh of the thesis."""
    mesh, u = problems.mesh(nodes), problems.functions[function]
    runs = [annealing(nodes, function, name, norm, seed) for seed in SEEDS]
    least = min(runs, key=lambda run: run.cost_after)
    proved, many = optimal(mesh, u, name, norm=norm), local_optima(mesh, u, name, norm=norm, orders=ORDERS)
    meshes = in_natural_order(nodes, function, name, norm), least.mesh, proved.mesh
    return Large(
        least.cost_swapped,
        many.costs.min(),
        proved.cost_after,
        np.array([run.cost_after for run in runs]),
        *(l2_error(found, u) for found in meshes),
    )
