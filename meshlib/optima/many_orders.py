"""Many edge orders: which local optima the local optimisation procedure reaches."""

import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

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
from ..swapping.procedure import Procedure
from ..swapping.swapped import prepared

T = TypeVar("T")

ORDERS_AT_ONCE = 500  # largest number of orders in a part of the work


@dataclass(frozen=True, repr=False, eq=False)
class LocalOptima(Record):
    """The distinct meshes that many edge orders lead to, in the order they were found.

    Attributes
    ----------
    mesh : Mesh
        The optimum of least cost; of equal ones the one found first.
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
        Seed from which all orders were drawn.

    See Also
    --------
    local_optima : makes such records.
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
        """The optimum of this number, from 0 to ``len(self) - 1``, as a Mesh."""
        return Mesh._trusted(self.mesh.nodes, self.elements[number])


def order_of(seed: int, number: int, n_edges: int) -> IntArray:
    """One of the random edge orders of a seed, equal on every platform.

    Parameters
    ----------
    seed : int
        At least 0.
    number : int
        Number of the order, from 0.
    n_edges : int
        Number of edges of the mesh.

    Returns
    -------
    (n_edges,) ndarray of int64
        Every edge number once.

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
        Number of orders, at least 1.
    seed : int
        Seed of the orders, at least 0.
    workers : int, optional
        Number of processes that share the work, -1 for one on each core, not 0.  By default
        the number that ``joblib.parallel_config`` sets, else one.  The result does not depend
        on it.
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
    ImportError
        If there are several workers and joblib is not installed, or a bar and not tqdm (both
        in the extra ``studies``).

    See Also
    --------
    meshlib.swapped : one run, with a given edge order.
    meshlib.annealed : leaves local optima by swaps that raise the cost.
    meshlib.optimal : the best mesh of all.

    Notes
    -----
    The orders are distributed by joblib, on the cores of one machine or, with ``dask`` and
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
    parts = [(procedure, seed, numbers) for numbers in _parts(orders)]
    return _merged(procedure, seed, list(shared(_distinct, parts, workers, progress, total=len(parts))))


def _parts(orders: int, count: int = 64) -> list[range]:
    """Consecutive parts of the numbers of the orders; up to ``count``, so that all workers get some."""
    size = min(ORDERS_AT_ONCE, -(-orders // count))
    return [range(k, min(k + size, orders)) for k in range(0, orders, size)]


def _distinct(procedure: Procedure, seed: int, numbers: Iterable[int]) -> tuple[list[bytes], list[int]]:
    """Distinct results of some orders, each as its elements in bytes, and the result of each order."""
    known: dict[bytes, int] = {}
    optimum = []
    for number in numbers:
        done = procedure.run(order_of(seed, number, procedure.mesh.n_edges))
        key = canonical(done.elements).tobytes()
        optimum.append(known.setdefault(key, len(known)))
    return list(known), optimum


def _merged(procedure: Procedure, seed: int, parts: Iterable[tuple[list[bytes], list[int]]]) -> LocalOptima:
    """The results of all parts, numbered in the order in which they were found."""
    known: dict[bytes, int] = {}
    optimum = []
    for keys, local in parts:
        place = np.array([known.setdefault(key, len(known)) for key in keys])
        optimum.append(place[local])
    elements = np.frombuffer(b"".join(known), dtype=np.int32).reshape(len(known), -1, 3)
    meshes = (Mesh._trusted(procedure.mesh.nodes, found) for found in elements)
    costs = np.array([procedure.cost(mesh) for mesh in meshes])
    best = Mesh._trusted(procedure.mesh.nodes, elements[costs.argmin()])
    before, after = procedure.cost(procedure.mesh), float(costs.min())
    return LocalOptima(best, procedure.values, before, after, elements, costs, np.concatenate(optimum), seed)


def shared(
    function: Callable[..., T],
    parts: Iterable[Sequence[Any]],
    workers: int | None = None,
    progress: bool = False,
    unit: str = "part",
    total: int | None = None,
) -> Iterator[T]:
    """Results of ``function(*part)`` for each part, in order, from one worker or several.

    Closing the iterator cancels the work.  With ``progress`` a bar is shown; it counts in
    ``unit`` and has an end if ``total``, the number of parts, is given.
    """
    results = _in_turn(function, parts) if _is_one(workers) else _in_parallel(function, parts, workers)
    return bar(results, total=total, unit=unit) if progress else results


def _is_one(workers: int | None) -> bool:
    """Whether there is one worker; for None as joblib is configured, which must have been imported for it."""
    if workers is None and "joblib" in sys.modules:
        return bool(sys.modules["joblib"].effective_n_jobs(None) == 1)
    return workers in (None, 1)


def _in_turn(function: Callable[..., T], parts: Iterable[Sequence[Any]]) -> Iterator[T]:
    return (function(*part) for part in parts)


def _in_parallel(
    function: Callable[..., T], parts: Iterable[Sequence[Any]], workers: int | None
) -> Iterator[T]:
    joblib = _joblib()
    jobs = (joblib.delayed(function)(*part) for part in parts)
    results = joblib.Parallel(n_jobs=workers, return_as="generator")(jobs)
    try:
        for result in results:  # noqa: UP028 - "yield from" would close them before the warning is silenced
            yield result
    finally:
        with warnings.catch_warnings():  # joblib warns that some results were not used
            warnings.simplefilter("ignore")
            results.close()


def _joblib() -> Any:
    try:
        import joblib
    except ImportError:
        raise missing_extra("joblib", "studies") from None
    return joblib
