"""How far local optima are from the best mesh, and how near annealing comes (section 7.6)."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Mesh, annealed, criteria, local_optima, optimal, problems, swapped
from ...mesh.topology import from_smallest, quadrilaterals
from ...optima.enumeration import enumerated
from ...swapping.annealing import Annealing
from .appendix_b import small_mesh
from .measures import Function, l2_error

SETS, NODES = 12, 10  # small sets of nodes; nodes in each
FUNCTIONS = "SR2", "franke"
TWELVE = "franke", 5, 12  # function, seed and number of nodes: swapping misses the best for each of `LISTED`
L2_ERROR = "min-error"
DEGREE = 12  # degree of the quadrature for the L2 error, high because the elements are large
NORMS = 1, 2
NC1, ANGLES = ("jnd", "abn", "dlp", "dfp"), ("smallest-angle", "largest-angle")
CASES = (*((name, norm) for name in (*NC1, *ANGLES) for norm in NORMS), (L2_ERROR, 2))
LISTED = ("jnd", 2), ("abn", 1), ("dlp", 1), ("dfp", 2)  # whose costs of all meshes are shown
LEVELS, TRIES = 20, 40  # temperatures, and tries for each edge in each, where there are few meshes
SAME = 1e-9  # relative difference up to which costs count as equal
LARGE = ("33", "SR2", "jnd", 2), ("81", "SR3", "abn", 1), ("81", "franke", "abn", 1)  # proofs take seconds
SEEDS = range(5)
ORDERS = 1000  # random edge orders


def title(name: str, norm: int) -> str:
    """Criterion and norm as a page shows them, for example ``"JND-$L_2$"``."""
    if name == L2_ERROR:
        return "$L_2$ error"
    return f"{name.upper()}-$L_{norm}$" if name in NC1 else f"{name.replace('-', ' ')}, $L_{norm}$"


# -- all meshes of few nodes -------------------------------------------------------------------


@dataclass(frozen=True)
class Distances:
    """Costs of meshes of small sets of nodes, one entry for each set and function.

    Attributes
    ----------
    best, swapped, annealed : (n,) ndarray of float64
        Cost of the best of all meshes, and of those that swapping and annealing reach.
    """

    best: np.ndarray
    swapped: np.ndarray
    annealed: np.ndarray

    def excess(self, way: str) -> np.ndarray:
        """Cost above that of the best mesh, relative to it, for ``"swapped"`` or ``"annealed"``."""
        return np.maximum(getattr(self, way) / self.best - 1, 0)

    def share(self, way: str) -> float:
        """Share of the cases in which the best mesh is found."""
        return float((self.excess(way) <= SAME).mean())


def criterion_of(name: str, function: Function) -> criteria.Criterion:
    """The criterion with a name; the L2 error is that of the function."""
    return criteria.min_error(function, degree=DEGREE) if name == L2_ERROR else criteria.get(name)


@cache
def small_case(seed: int, nodes: int = NODES) -> tuple[Mesh, Mesh]:
    """A Delaunay mesh of few random nodes, and all meshes of these nodes as one of many parts."""
    start = small_mesh(nodes, seed)
    return start, side_by_side(start, enumerated(start))


def side_by_side(start: Mesh, elements: np.ndarray) -> Mesh:
    """Many meshes of the nodes of a start mesh as one mesh of many parts, all in the same place.

    Parameters
    ----------
    start : Mesh
    elements : (M, T, 3) ndarray of int32
        The elements of each mesh.

    Returns
    -------
    Mesh
        It has its nodes M times and is not valid, since the parts overlap.
    """
    count, n = len(elements), start.n_nodes
    rows = elements + n * np.arange(count, dtype=np.int32)[:, None, None]
    return Mesh(np.tile(start.nodes, (count, 1)), rows.reshape(-1, 3))


def costs_of_parts(
    start: Mesh, every: Mesh, values: np.ndarray, criterion: criteria.Criterion, norm: int
) -> np.ndarray:
    """Norm of the cost vector of each part of a mesh made by `side_by_side`.

    Examples
    --------
    >>> (start, every), values = small_case(0), np.arange(10.0) ** 2
    >>> costs = costs_of_parts(start, every, values, criteria.get("jnd"), 1)
    >>> bool(np.isclose(costs[0], criteria.costs(start, values).sum()))
    True
    """
    count = every.n_elements // start.n_elements
    if criterion.on == "edge":
        corners = quadrilaterals(every, np.flatnonzero(~every.boundary))[0][:, [1, 2, 0, 3]]
    else:
        corners = from_smallest(every.elements)
    points = np.column_stack([every.nodes, np.tile(values, count)])
    costs = np.asarray(criterion.cost(*points[corners.T]), dtype=float)
    return np.bincount(corners[:, 0] // start.n_nodes, costs**norm, count) ** (1 / norm)


@cache
def listed(
    name: str, norm: int, function: str, seed: int, nodes: int = NODES
) -> tuple[np.ndarray, Annealing]:
    """The costs of all meshes of a small set of nodes, the start mesh first, and annealing from there.

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
def distances(name: str, norm: int, sets: int = SETS) -> Distances:
    """Costs that swapping and annealing reach on small sets of nodes, and those of the best meshes.

    Parameters
    ----------
    name : str
        Name of a criterion, or `L2_ERROR`.
    norm : {1, 2}
    sets : int
        Number of sets of nodes.

    Returns
    -------
    Distances
    """
    found = [listed(name, norm, function, seed) for function in FUNCTIONS for seed in range(sets)]
    rows = [(costs.min(), run.cost_swapped, run.cost_after) for costs, run in found]
    return Distances(*np.transpose(rows))


def numbers_of_meshes() -> np.ndarray:
    """(sets,) int64: the number of meshes of each small set of nodes."""
    return np.array([len(listed(*LISTED[0], FUNCTIONS[0], seed)[0]) for seed in range(SETS)])


# -- more nodes ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Large:
    """Costs and L2 errors of meshes of a larger problem.

    Attributes
    ----------
    swapped, orders, best : float
        Cost after swapping in natural order, the least after `ORDERS` random orders, and
        the proved least of all meshes.
    annealed : (n,) ndarray of float64
        Cost after annealing with each seed.
    error_swapped, error_annealed, error_best : float
        L2 errors after swapping in natural order, of the cheapest annealed mesh (the first of
        equally cheap ones), and of the proved optimum.
    """

    swapped: float
    orders: float
    best: float
    annealed: np.ndarray
    error_swapped: float
    error_annealed: float
    error_best: float


@cache
def annealing(nodes: str, function: str, name: str, norm: int, seed: int) -> Annealing:
    """Annealing on a start mesh of the thesis."""
    return annealed(problems.mesh(nodes), problems.functions[function], name, norm=norm, seed=seed)


def in_natural_order(nodes: str, function: str, name: str, norm: int) -> Mesh:
    """The mesh that swapping in natural order leads to, where annealing starts."""
    return swapped(problems.mesh(nodes), problems.functions[function], name, norm=norm).mesh


@cache
def large(nodes: str, function: str, name: str, norm: int) -> Large:
    """Swapping, annealing and the proved optimum on a start mesh of the thesis."""
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
