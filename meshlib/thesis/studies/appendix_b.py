"""How far the printed numbers can be trusted: many edge orders, noise, limits, quadrature, optima.

Everything is seeded and computed when asked for; a study is computed once in a process.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Mesh, criteria, delaunay, problems
from ...interpolation.interpolant import squared_errors
from ...optima.enumeration import enumerated
from ...optima.many_orders import LocalOptima, local_optima, order_of
from ...optima.proved import Optimal, optimal
from ...support.random_numbers import Draws
from ..record import printed
from ..record.printed import texts
from .experiments import EXPERIMENTS, Experiment, Result, Swap, natural, run
from .measures import L2, Function, Remembered, l2_error, measured, measured_all

ORDERS = 10_000  # random edge orders of an experiment
SEED = 2001
TRIALS = 100  # trials with noise
MAGNITUDES = tuple(10.0**k for k in range(-16, -5))  # standard deviations of the noise
PROBE = 1e-9  # standard deviation of the noise that shows what depends on noise
RARE = 0.01  # share of the trials up to which a number counts as unchanged
ANGLES = tuple(range(31))  # degrees
ANGLE_ORDERS = 200  # random edge orders for each limit on the angles
CRITERIA = ("jnd", "abn")
QUADRATURE_DEGREE = 10
SETTLED, LEVELS = 1e-6, 6  # relative change of an error at which elements are split no more; most splits
MIN_ERROR_DEGREE = 100  # degree of a quadrature: tanh has poles near the cliff
SMALL_NODES, SMALL_SEED = 10, 0

SWAPS = tuple(key for key, e in EXPERIMENTS.items() if isinstance(e.operate, Swap))


def title(key: str) -> str:
    """Function, nodes and criterion of an experiment, for example ``SR2, 81, JND-L2``."""
    experiment = EXPERIMENTS[key]
    limit = f", {experiment.operate.min_angle:g}°" if experiment.operate.min_angle else ""
    shuffled = ", reordered" if experiment.shuffled else ""
    return f"{experiment.function}, {experiment.nodes}, {experiment.operate.title}{limit}{shuffled}"


# -- many orders ---------------------------------------------------------------------------


@dataclass(frozen=True)
class OrderStudy:
    """The local optima that many edge orders lead to, and their measures.

    Attributes
    ----------
    optima : LocalOptima
    measures : dict
        (measure, statistic) -> (M,) array, a value for each optimum.
    """

    optima: LocalOptima
    measures: dict[tuple[str, str], np.ndarray]

    def values(self, which: tuple[str, str]) -> np.ndarray:
        """(n,) float64: a measure for each order."""
        return self.measures[which][self.optima.optimum]

    def share(self, which: tuple[str, str], text: str) -> float:
        """Share of the orders that give the printed digits."""
        fits = np.array([printed.matches(value, text) for value in self.measures[which]])
        return fits[self.optima.optimum].mean()

    def share_of_column(self, column: dict[tuple[str, str], str]) -> float:
        """Share of the orders that give all printed digits of a column at once."""
        fits = [[printed.matches(v, text) for v in self.measures[which]] for which, text in column.items()]
        return np.all(fits, axis=0)[self.optima.optimum].mean()


def orders(key: str, count: int = ORDERS) -> OrderStudy:
    """An experiment with ``count`` random edge orders, ties broken by the tolerance of the library.

    Examples
    --------
    >>> study = orders("SR1-33-ABN-L2", 50)
    >>> print(len(study.optima), f'{study.share(("l2_error", ""), "0.0170"):.2f}')
    2 0.24
    """
    experiment = EXPERIMENTS[key]
    return _orders(experiment.nodes, experiment.function, experiment.operate, count)


@cache
def _orders(nodes: str, function: str, swap: Swap, count: int) -> OrderStudy:
    mesh, u = problems.mesh(nodes), problems.functions[function]
    found = local_optima(
        mesh, u, swap.criterion, norm=swap.norm, orders=count, seed=SEED, min_angle=swap.min_angle
    )
    return OrderStudy(found, measured_all(map(found.mesh_of, range(len(found))), u))


# -- noise ---------------------------------------------------------------------------------


@cache
def noise(
    key: str, magnitude: float, tolerance: float | None = None, trials: int = TRIALS
) -> dict[tuple[str, str], float]:
    """Share of trials in which noise changes a printed number: (measure, statistic) -> share.

    Normal variates with the standard deviation ``magnitude`` are added to the nodal values;
    the order is the natural one.  A number is changed if the digits that the thesis prints
    are not those without noise.  ``tolerance`` is the gain below which no swap is made.
    """
    experiment, column = EXPERIMENTS[key], texts(key)
    function = Remembered(problems.functions[experiment.function]) if experiment.function else None
    start, order = problems.mesh(experiment.nodes), problems.order(experiment.nodes)
    values = function(*start.nodes.T) if function else np.zeros(start.n_nodes)

    def digits(values: np.ndarray) -> np.ndarray:
        found = measured(_adapted(experiment, start, values, order, tolerance), function)
        return np.array([printed.digits(found[which], text, 0) for which, text in column.items()])

    before = digits(values)
    normals = (np.random.default_rng([SEED, k]).standard_normal(len(values)) for k in range(trials))
    changed = [digits(values + magnitude * variates) != before for variates in normals]
    return dict(zip(column, np.mean(changed, axis=0), strict=True))


def _adapted(
    experiment: Experiment, start: Mesh, values: np.ndarray, order: np.ndarray, tolerance: float | None
) -> Mesh:
    if not isinstance(experiment.operate, Swap):
        return experiment.operate(start, values, order).mesh
    return experiment.operate.prepared(start, values, tolerance).swapped(order)


WORDS = {  # by whether random orders and whether noise change a number
    (False, False): "method",
    (True, False): "order",
    (False, True): "noise",
    (True, True): "both",
}


def depends_on(key: str) -> dict[tuple[str, str], str]:
    """What each printed number of an experiment depends on: (measure, statistic) -> word.

    ``"method"``: neither random orders nor noise of 1e-9 change its digits in more than
    one trial of a hundred; ``"order"`` or ``"noise"``: one of them does; ``"both"``.
    """
    by_order, by_noise = _by_order(key), noise(key, PROBE)
    return {
        which: WORDS[_varies(by_order[which], text), bool(by_noise[which] > RARE)]
        for which, text in texts(key).items()
    }


def _by_order(key: str) -> dict[tuple[str, str], np.ndarray]:
    """Measures under random orders of the edges: (measure, statistic) -> array."""
    experiment = EXPERIMENTS[key]
    if isinstance(experiment.operate, Swap):
        study = orders(key)
        return {which: study.values(which) for which in study.measures}
    start, function = problems.mesh(experiment.nodes), problems.functions.get(experiment.function)
    shuffled = (order_of(SEED, k, start.n_edges) for k in range(TRIALS))
    return measured_all((experiment.operate(start, function, order).mesh for order in shuffled), function)


def _varies(values: np.ndarray, text: str) -> bool:
    """Whether the digits of a number differ in more than one case of a hundred."""
    _, counts = np.unique([printed.digits(v, text, 0) for v in values], return_counts=True)
    return bool(1 - counts.max() / counts.sum() > RARE)


# -- the limit on angles ---------------------------------------------------------------------


@cache
def angle_limits(criterion: str, limits: Iterable[int] = ANGLES, count: int = ANGLE_ORDERS) -> np.ndarray:
    """L2 errors of SR3 on 81 nodes for each limit on the smallest angle and each edge order.

    Returns
    -------
    (limits, count) ndarray of float64
    """
    mesh, function = problems.mesh("81"), problems.functions["SR3"]
    rows = []
    for limit in limits:
        found = local_optima(mesh, function, criterion, norm=2, orders=count, seed=SEED, min_angle=limit)
        errors = measured_all(map(found.mesh_of, range(len(found))), function)[L2]
        rows.append(errors[found.optimum])
    return np.array(rows)


# -- quadrature ----------------------------------------------------------------------------


def settled_error(mesh: Mesh, function: Function) -> float:
    """The L2 error by quadrature on elements, which are split in four until it settles.

    Examples
    --------
    >>> round(settled_error(problems.mesh("81"), problems.functions["convex"]), 10)
    0.0054625461
    """
    corners, values = mesh.corners, function(*mesh.nodes.T)[mesh.elements]
    last = 0.0
    for _ in range(LEVELS):
        found = np.sqrt(squared_errors(corners, values, function, QUADRATURE_DEGREE).sum())
        if abs(found - last) <= SETTLED * found:
            break
        corners, values, last = quartered(corners), quartered(values), found
    return float(found)


def quartered(corners: np.ndarray) -> np.ndarray:
    """The three corners of the four parts of each triangle, or the values of a linear function there."""
    a, b, c = np.moveaxis(corners, 1, 0)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.concatenate([np.stack(part, axis=1) for part in parts])


def quadrature(
    number: printed.Printed, points: Iterable[int] = (101, 200, 201)
) -> tuple[list[float], float, bool]:
    """A printed L2 error by other quadratures.

    Returns
    -------
    by_grid : list of float
        The error by trapezium rules with these numbers of points a side.
    settled : float
        The error by quadrature on the elements that has settled.
    fitted : bool
        Whether order or perturbation were chosen such that the error is the printed one.
    """
    result = _result_behind(number)
    u = problems.functions[result.experiment.function]
    by_grid = [result.interpolant.l2_error(u, points=n, rule="trapezium") for n in points]
    settled = settled_error(result.mesh, u)
    return by_grid, settled, EXPERIMENTS[number.experiment].certified


def _result_behind(number: printed.Printed) -> Result:
    """The result that gives a printed number: that in natural order if it does."""
    plain = natural(number.experiment)
    if plain and printed.matches(plain.measures[number.measure, number.statistic], number.text):
        return plain
    return run(number.experiment)


# -- the best of all -----------------------------------------------------------------------

SMALL = tuple(key for key in SWAPS if EXPERIMENTS[key].nodes == "33")


@cache
def best(function: str, criterion: str, norm: int) -> Optimal:
    """The proved optimum on the 33 nodes; the criterion ``"l2"`` is the L2 error itself."""
    u = problems.functions[function]
    chosen = criteria.min_error(u, degree=MIN_ERROR_DEGREE) if criterion == "l2" else criterion
    return optimal(problems.mesh("33"), u, chosen, norm=norm)


@cache
def every_mesh() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Cost by ABN-L1 and L2 error of all meshes of ten nodes for SR2, and where swapping ends.

    Returns
    -------
    costs, errors : (M,) ndarray of float64
    reached : (M,) ndarray of int64
        Number of random edge orders that end in each mesh.
    """
    start, function = small_mesh(), problems.functions["SR2"]
    meshes = [Mesh(start.nodes, elements) for elements in enumerated(start)]
    costs = np.array([np.linalg.norm(criteria.costs(m, function, "abn"), 1) for m in meshes])
    remembered = Remembered(function)
    errors = np.array([l2_error(mesh, remembered) for mesh in meshes])
    number = {mesh.elements.tobytes(): k for k, mesh in enumerate(meshes)}
    found = local_optima(start, function, "abn", norm=1, orders=ORDERS, seed=SEED)
    reached = np.zeros(len(meshes), dtype=np.int64)
    for elements, count in zip(found.elements, found.counts, strict=True):
        reached[number[elements.tobytes()]] += count
    return costs, errors, reached


def small_mesh(count: int = SMALL_NODES, seed: int = SMALL_SEED) -> Mesh:
    """The Delaunay mesh of the corners of the unit square and random nodes inside, ``count`` in all."""
    inside = Draws(seed).uniform((count - 4, 2))
    return delaunay(np.vstack([[[0, 0], [1, 0], [1, 1], [0, 1]], inside]))
