"""Many edge orders: which local optima the local optimisation procedure reaches."""

import sys
import warnings
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import FloatArray, IntArray, Norm, Values
from ..criteria.criterion import Criterion
from ..errors import missing_extra
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from ..mesh.topology import canonical
from ..support.progress import bar
from ..support.random_numbers import permutation
from ..swapping.swapped import prepared

ORDERS_AT_ONCE = 500  # how many a worker takes at most
PARTS = 64  # into which fewer orders are cut, so that every worker gets some


@dataclass(frozen=True, repr=False, eq=False)
class LocalOptima(Record):
    """The distinct meshes that many edge orders lead to, in the order they were found.

    Attributes
    ----------
    mesh : Mesh
        The optimum of least cost; of several the one found first.
    values : (N,) ndarray of float64
        The nodal values given.
    cost_before, cost_after : float
        Norm of the cost vector of the start mesh and of ``mesh``.
    elements : (M, T, 3) ndarray of int32
        Each optimum: elements with their smallest node first, in lexicographic order.
    costs : (M,) ndarray of float64
        Norm of the cost vector of each optimum.
    optimum : (n,) ndarray of int64
        For each order the number of the optimum it leads to.
    seed : int
        Order k is ``order_of(seed, k, n_edges)``.
    """

    cost_before: float
    cost_after: float
    elements: IntArray
    costs: FloatArray
    optimum: IntArray
    seed: int

    def __len__(self) -> int:
        """Number of distinct optima."""
        return len(self.elements)

    @property
    def counts(self) -> IntArray:
        """(M,) int64: number of orders that lead to each optimum."""
        return np.bincount(self.optimum, minlength=len(self))

    def mesh_of(self, number: int) -> Mesh:
        """The optimum of that number as a Mesh."""
        return Mesh._trusted(self.mesh.nodes, self.elements[number])


def order_of(seed, number, n_edges):
    """The random edge order of that number, the same on every platform.

    Parameters
    ----------
    seed, number, n_edges : int

    Returns
    -------
    (n_edges,) ndarray of int64

    Examples
    --------
    >>> order_of(0, 1, 5).tolist()
    [1, 4, 3, 0, 2]
    """
    return permutation([seed, number], n_edges)


def local_optima(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    norm: Norm = "L2",
    orders: int = 100,
    seed: int = 0,
    workers: int | None = None,
    progress: bool = False,
    **limits: float | None,
) -> LocalOptima:
    """Run the local optimisation procedure with many random edge orders (section 6.3).

    Parameters
    ----------
    mesh, values, criterion, norm
        As for `meshlib.swapped`.
    orders : int
        Number of orders.
    seed : int
        Seed of the orders, at least 0.
    workers : int, optional
        Number of processes that share the work, -1 for one on each core, not 0.  By default
        what ``joblib.parallel_config`` says, else one.  The result does not depend on it.
    progress : bool
        Whether to show a progress bar.
    **limits
        ``min_angle``, ``min_area`` and ``min_gain``, as for `meshlib.swapped`.

    Returns
    -------
    LocalOptima

    Raises
    ------
    MeshError
        As `meshlib.swapped`, or if ``orders``, ``seed`` or ``workers`` is out of range.

    Notes
    -----
    The orders are shared out by joblib, on the cores of one machine or, with ``dask`` and
    ``distributed`` installed here and meshlib on every machine, on a cluster::

        client = distributed.Client("scheduler:8786")  # or distributed.Client() for this machine
        with joblib.parallel_config(backend="dask"):
            found = local_optima(mesh, values, orders=100_000, progress=True)

    Examples
    --------
    The best of a hundred orders, and how many different meshes there were:

    >>> from meshlib import problems
    >>> found = local_optima(problems.mesh("33"), problems.SR2, "abn", norm="L1")
    >>> found.mesh
    Mesh(33 nodes, 88 edges, 56 elements)
    >>> print(f"{len(found)} optima cost {found.costs.min():.1f} to {found.costs.max():.1f}")
    38 optima cost 16.8 to 22.1
    """
    procedure = prepared(mesh, values, criterion, norm, **limits)
    orders, seed = checks.whole(orders, 1, "orders"), checks.whole(seed, 0, "seed")
    workers = None if workers is None else checks.workers(workers)
    size = min(ORDERS_AT_ONCE, -(-orders // PARTS))
    parts = [(procedure, seed, range(k, min(k + size, orders))) for k in range(0, orders, size)]
    return _merged(procedure, seed, list(shared(_distinct, parts, workers, progress, total=len(parts))))


def _distinct(procedure, seed, numbers):
    """Distinct results of some orders, and for each order which one."""
    known, optimum = {}, []
    for number in numbers:
        done = procedure.run(order_of(seed, number, procedure.mesh.n_edges))
        key = canonical(done.elements).tobytes()
        optimum.append(known.setdefault(key, len(known)))
    return list(known), optimum


def _merged(procedure, seed, parts):
    known, optimum = {}, []
    for keys, local in parts:
        place = np.array([known.setdefault(key, len(known)) for key in keys])
        optimum.append(place[local])
    elements = np.frombuffer(b"".join(known), dtype=np.int32).reshape(len(known), -1, 3)
    meshes = (Mesh._trusted(procedure.mesh.nodes, found) for found in elements)
    costs = np.array([procedure.cost(mesh) for mesh in meshes])
    best = Mesh._trusted(procedure.mesh.nodes, elements[costs.argmin()])
    ends = procedure.cost(procedure.mesh), float(costs.min())
    return LocalOptima(best, procedure.values, *ends, elements, costs, np.concatenate(optimum), seed)


def shared(function, parts, workers=None, progress=False, unit="part", total=None):
    """Results of ``function(*part)`` for each part, in order, from many workers.

    A generator; closing it cancels the work.  With ``progress`` a bar is shown,
    which knows the end if ``total`` is given.
    """
    results = _in_turn(function, parts) if _is_one(workers) else _in_parallel(function, parts, workers)
    return bar(results, total=total, unit=unit) if progress else results


def _is_one(workers):
    """Whether there is one worker; for None joblib tells, if it has been imported to be told of others."""
    if workers is None and "joblib" in sys.modules:
        return sys.modules["joblib"].effective_n_jobs(None) == 1
    return workers in (None, 1)


def _in_turn(function, parts):
    return (function(*part) for part in parts)


def _in_parallel(function, parts, workers):
    joblib = _joblib()
    jobs = (joblib.delayed(function)(*part) for part in parts)
    results = joblib.Parallel(n_jobs=workers, return_as="generator")(jobs)
    try:
        for result in results:  # noqa: UP028 - "yield from" would close them before the warning is silenced
            yield result
    finally:
        with warnings.catch_warnings():  # that some work was in vain
            warnings.simplefilter("ignore")
            results.close()


def _joblib():
    try:
        import joblib
    except ImportError:
        raise missing_extra("joblib", "studies") from None
    return joblib
