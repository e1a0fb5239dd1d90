"""How far the printed numbers can be trusted: many edge orders, noise, limits, quadrature, optima.

Everything is seeded and computed when asked for; a study is computed once in a process.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Mesh, criteria, problems
from ...interpolation.interpolant import squared_errors
from ...optima.enumeration import enumerated
from ...optima.many_orders import LocalOptima, local_optima, order_of
from ...optima.proved import optimal
from ...support.random_numbers import Draws
from ..record import printed
from ..record.printed import texts
from .experiments import EXPERIMENTS, Swap, natural, run
from .measures import L2, Remembered, measured, measured_all

ORDERS = 10_000
SEED = 2001
TRIALS = 100
MAGNITUDES = tuple(10.0**k for k in range(-16, -5))
PROBE = 1e-9  # the noise by which cells are told apart
RARE = 0.01  # a share of trials below which a cell counts as unchanged
ANGLES = tuple(range(31))
ANGLE_ORDERS = 200
CRITERIA = ("jnd", "abn")
QUADRATURE_DEGREE, SETTLED, LEVELS = 10, 1e-6, 6
MIN_ERROR_DEGREE = 100  # tanh has poles near the cliff
SMALL_NODES, SMALL_SEED = 10, 0

SWAPS = tuple(key for key, e in EXPERIMENTS.items() if isinstance(e.operate, Swap))


# -- many orders ---------------------------------------------------------------------------


@dataclass(frozen=True)
class OrderStudy:
    """The local optima of an experiment that many edge orders lead to, and their measures.

    Attributes
    ----------
    optima : LocalOptima
    measures : dict
        (measure, statistic) -> (M,) array, a value for each optimum.
    """

    optima: LocalOptima
    measures: dict

    def values(self, which):
        """(n,) float64: a measure for each order."""
        return self.measures[which][self.optima.optimum]

    def share(self, which, text):
        """Share of the orders that give the printed digits."""
        fits = np.array([printed.matches(value, text) for value in self.measures[which]])
        return fits[self.optima.optimum].mean()

    def share_of_column(self, column):
        """Share of the orders that give all printed digits of a column at once."""
        fits = [[printed.matches(v, text) for v in self.measures[which]] for which, text in column.items()]
        return np.all(fits, axis=0)[self.optima.optimum].mean()


def orders(key, count=ORDERS):
    """An experiment under so many random edge orders, ties broken by the tolerance.

    Examples
    --------
    >>> study = orders("SR1-33-ABN-L2", 50)
    >>> print(len(study.optima), f'{study.share(("l2_error", ""), "0.0170"):.2f}')
    2 0.24
    """
    experiment = EXPERIMENTS[key]
    return _orders(experiment.nodes, experiment.function, experiment.operate, count)


@cache
def _orders(nodes, function, swap, count):
    mesh, u = problems.mesh(nodes), problems.functions[function]
    found = local_optima(
        mesh, u, swap.criterion, norm=swap.norm, orders=count, seed=SEED, min_angle=swap.min_angle
    )
    return OrderStudy(found, measured_all(map(found.mesh_of, range(len(found))), u))


# -- noise ---------------------------------------------------------------------------------


@cache
def noise(key, magnitude, tolerance=None, trials=TRIALS):
    """Share of trials in which noise of this size changes a number: (measure, statistic) -> share.

    Nodal values get normal variates times ``magnitude`` added; the order is the natural
    one.  Compared are the digits that the thesis prints, with those without noise.  The
    tolerance is that of swaps.
    """
    experiment, column = EXPERIMENTS[key], texts(key)
    function = Remembered(problems.functions[experiment.function]) if experiment.function else None
    start, order = problems.mesh(experiment.nodes), problems.order(experiment.nodes)
    values = function(*start.nodes.T) if function else np.zeros(start.n_nodes)

    def digits(values):
        found = measured(_adapted(experiment, start, values, order, tolerance), function)
        return np.array([printed.digits(found[which], text, 0) for which, text in column.items()])

    before = digits(values)
    normals = (np.random.default_rng([SEED, k]).standard_normal(len(values)) for k in range(trials))
    changed = [digits(values + magnitude * variates) != before for variates in normals]
    return dict(zip(column, np.mean(changed, axis=0), strict=True))


def _adapted(experiment, start, values, order, tolerance):
    if not isinstance(experiment.operate, Swap):
        return experiment.operate(start, values, order).mesh
    return experiment.operate.prepared(start, values, tolerance).swapped(order)


def depends_on(key):
    """What each printed number of an experiment depends on: (measure, statistic) -> words.

    ``"method"``: neither random orders nor noise of 1e-9 change its digits in more than
    one trial of a hundred; ``"order"`` or ``"noise"``: one of them does; ``"both"``.
    """
    by_noise = noise(key, PROBE)
    return {
        which: {
            (False, False): "method",
            (True, False): "order",
            (False, True): "noise",
            (True, True): "both",
        }[_varies(found, texts(key)[which]), bool(by_noise[which] > RARE)]
        for which, found in _by_order(key).items()
        if which in texts(key)
    }


def _by_order(key):
    """Measures under random orders of the edges: (measure, statistic) -> array."""
    experiment = EXPERIMENTS[key]
    if isinstance(experiment.operate, Swap):
        study = orders(key)
        return {which: study.values(which) for which in study.measures}
    start, function = problems.mesh(experiment.nodes), problems.functions.get(experiment.function)
    shuffled = (order_of(SEED, k, start.n_edges) for k in range(TRIALS))
    return measured_all((experiment.operate(start, function, order).mesh for order in shuffled), function)


def _varies(values, text):
    """Whether the digits of a number differ in more than one case of a hundred."""
    _, counts = np.unique([printed.digits(v, text, 0) for v in values], return_counts=True)
    return bool(1 - counts.max() / counts.sum() > RARE)


# -- the limit on angles ---------------------------------------------------------------------


@cache
def angle_limits(criterion, limits=ANGLES, count=ANGLE_ORDERS):
    """L2 errors of SR3 on 81 nodes for each limit on the smallest angle and each order.

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


def settled_error(mesh, function):
    """The L2 error by quadrature on elements split in four until it settles.

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


def quartered(corners):
    """The three corners, or the values at them, of the four parts of each triangle."""
    a, b, c = np.moveaxis(corners, 1, 0)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.concatenate([np.stack(part, axis=1) for part in parts])


def quadrature(number, points=(101, 200, 201)):
    """The error behind a printed one by several trapezium rules, settled, and whether it was searched."""
    result = _result_behind(number)
    by_grid = [result.interpolant.l2_error(result.function, points=n, rule="trapezium") for n in points]
    return *by_grid, settled_error(result.mesh, result.function), EXPERIMENTS[number.experiment].certified


def _result_behind(number):
    """The mesh that a printed number belongs to: in natural order if that gives it."""
    plain = natural(number.experiment)
    if plain and printed.matches(plain.measures[number.measure, number.statistic], number.text):
        return plain
    return run(number.experiment)


# -- the best of all -----------------------------------------------------------------------

SMALL = tuple(key for key in SWAPS if EXPERIMENTS[key].nodes == "33")


@cache
def best(function, criterion, norm):
    """The proved optimum on the 33 nodes; criterion ``"l2"`` is the L2 error itself."""
    u = problems.functions[function]
    chosen = criteria.min_error(u, degree=MIN_ERROR_DEGREE) if criterion == "l2" else criterion
    return optimal(problems.mesh("33"), u, chosen, norm=norm)


@cache
def every_mesh():
    """All meshes of ten nodes for SR2 and ABN-L1, with their cost and L2 error, and where swapping ends.

    Returns
    -------
    costs, errors : (M,) ndarray of float64
    reached : (M,) ndarray of int64
        Number of random edge orders that end in each mesh.
    """
    start, function = small_mesh(), problems.functions["SR2"]
    meshes = [Mesh._trusted(start.nodes, elements) for elements in enumerated(start)]
    costs = np.array([np.linalg.norm(criteria.costs(m, function, "abn"), 1) for m in meshes])
    errors = measured_all(meshes, function)[L2]
    number = {mesh.elements.tobytes(): k for k, mesh in enumerate(meshes)}
    found = local_optima(start, function, "abn", norm=1, orders=ORDERS, seed=SEED)
    reached = np.zeros(len(meshes), dtype=np.int64)
    for elements, count in zip(found.elements, found.counts, strict=True):
        reached[number[elements.tobytes()]] += count
    return costs, errors, reached


def small_mesh(count=SMALL_NODES, seed=SMALL_SEED):
    """The corners of the square and random nodes, so many together."""
    from ... import delaunay

    inside = Draws(seed).uniform((count - 4, 2))
    return delaunay(np.vstack([[[0, 0], [1, 0], [1, 1], [0, 1]], inside]))
