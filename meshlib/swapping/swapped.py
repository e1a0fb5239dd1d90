"""Edge swapping: the local optimisation procedure (section 3.1)."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np

from .. import checks, criteria
from .._typing import ArrayLike, FloatArray, IntArray, NDArray, Norm, Values
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..errors import Interrupted
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from ..support.progress import Watch
from .along_curve import AlongCurve
from .procedure import Limits, Procedure

LARGEST_MIN_ANGLE = 60.0  # degrees; no triangle has a larger smallest angle
JUST_MET = 1 - 1e-10  # fraction of a limit that meets it, so that rounding does not break it


@dataclass(frozen=True, repr=False, eq=False)
class Swapping(Record):
    """A swapped mesh and how it came about.

    Attributes
    ----------
    mesh : Mesh
        Locally optimal (Definition 3.1.3) under the limits set.
    values : (N,) ndarray of float64
        The nodal values given.
    swaps : int
        Number of accepted swaps.
    sweeps : int
        Number of sweeps over all edges, the last without a swap; 0 with a queue.
    tried : int
        Number of swaps tried.
    """

    values: FloatArray
    swaps: int
    sweeps: int
    tried: int
    _rerun: Callable[[], NDArray[np.void]] = field(repr=False)
    _cost: Callable[[Mesh], float] = field(repr=False)
    _start: Mesh = field(repr=False)
    _on_demand = ("cost_before", "cost_after", "history")

    @cached_property
    def cost_before(self) -> float:
        """Norm of the cost vector of the start mesh; for the lexicographic order its largest entry."""
        return self._cost(self._start)

    @cached_property
    def cost_after(self) -> float:
        """Norm of the cost vector of the swapped mesh; for the lexicographic order its largest entry."""
        return self._cost(self.mesh)

    @cached_property
    def history(self) -> NDArray[np.void]:
        """Every tried swap, a structured array with a row for each.

        Fields: ``sweep``; ``edge``, its number in the start mesh; the old edge ``a``-``b`` and
        the new edge ``c``-``d``; ``accepted``; and the local costs ``old`` and ``new`` as the
        norm compares them: squared for L2, the first that differ for the lexicographic order.
        The history is recorded on first use by a second run of the procedure, which is
        deterministic.
        """
        return self._rerun()[: self.tried]


def swapped(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    norm: Norm = "L2",
    order: ArrayLike | None = None,
    min_angle: float | None = None,
    min_area: float | None = None,
    min_gain: float | None = None,
    schedule: str = "sweep",
    progress: bool = False,
) -> Swapping:
    """The mesh after the local optimisation procedure (Algorithm 3.1.4).

    Edges are inspected in order, sweep by sweep; an edge whose quadrilateral is
    strictly convex is swapped for the other diagonal if that lowers the local cost.
    The procedure ends when no such edge is left.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    values : (N,) array_like of float, or callable
        Values of u at the nodes, or a vectorised function u(x, y).
    criterion : str or Criterion
        For example ``"jnd"`` or ``"abn"``; see `meshlib.criteria`.
    norm : {"L1", "L2", "max", "lexicographic"}
        Order on the local cost vectors; 1, 2 and infinity are other names of the first three.
    order : (E,) array_like of int, optional
        Edge numbers of the start mesh in the order of inspection; a swapped edge keeps its
        place.  With a queue it is the order of the first inspection.  By default a sweep
        follows ``mesh.edges``, and a queue a space-filling curve.
    min_angle : float, optional
        Swaps that create an angle below this many degrees are refused.
    min_area : float, optional
        Swaps that create an element below this area are refused.
    min_gain : float, optional
        Gain in the norm of the local cost below which no swap is made, in the unit of the
        costs; the notes explain the default.
    schedule : {"sweep", "queue"}
        ``"sweep"``, that of the thesis, goes through all edges again and again.
        ``"queue"`` inspects each edge once and then, first come, first served, those
        that a swap has touched; it is faster on large meshes, and another order leads
        to another local optimum.
    progress : bool
        Whether to show a progress bar, which counts the edges inspected in this sweep or
        those that no longer wait in the queue.

    Returns
    -------
    Swapping

    Raises
    ------
    Interrupted
        After an interrupt (Ctrl-C) while kernels run.  It is a KeyboardInterrupt, and its
        ``result`` is the Swapping so far, whose mesh is valid but not yet optimal.
    MeshError
        If the mesh is not valid, a value is not finite, a criterion or norm is not
        known, the order is not a permutation, or a limit is out of range.

    See Also
    --------
    annealed, local_optima, optimal : Meshes of lower cost, at a higher price.
    refined, smoothed, combined : Other ways to lower the error.

    Notes
    -----
    *It terminates.*  A swap changes the costs of the five edges of its quadrilateral
    (of its two elements; of four nodes) and of nothing else.  With L1 or L2 the sum
    of all costs, or of their squares, therefore falls at every swap; with ``"max"``
    and ``"lexicographic"`` the vector of all costs, sorted downwards, falls in
    lexicographic order.  So no mesh occurs twice, and a set of nodes has finitely
    many meshes.

    In floating point the same holds, for two reasons.  The cost of an edge is computed
    from its elements alone, in an order that does not depend on the swaps before, so
    that it is the same number whenever these elements occur.  And a swap is made only
    if ``new < old (1 - 1e-12) - a`` for the norms of the local costs: the gain must
    exceed the rounding error of a sum of five costs.  The absolute part ``a`` is
    ``min_gain``, by default 1e-11 of the size of a typical cost of such data.  It keeps
    an edge where old and new cost differ by noise alone, so that the result does not
    depend on the last bit.  The lexicographic order instead compares costs rounded to
    multiples of ``a``.

    Built-in edge and angle criteria, `criteria.pointwise` ones and the min-error
    criterion run in kernels.  Where numba is installed, kernels are compiled as soon as
    there is enough work to justify the time that loading numba takes.  The lexicographic
    order and user-defined vectorised costs run in Python, with NumPy.

    *The default schedule* is that of the thesis for every mesh, since the result must not
    follow another rule on large meshes than on small ones.  Choose ``"queue"`` for large
    meshes.  While it runs, nodes are numbered along a space-filling curve, so that
    neighbours are near in memory.

    Examples
    --------
    >>> from meshlib import problems
    >>> u = problems.functions["SR2"]
    >>> result = swapped(problems.mesh("81"), u, "jnd", order=problems.order("81"))
    >>> result.swaps, result.sweeps
    (56, 2)
    """
    checks.choice(schedule, ("sweep", "queue"), "schedule")
    procedure = prepared(mesh, values, criterion, norm, min_angle, min_area, min_gain)
    runner, edges = _runner(procedure, order, schedule)
    if procedure.criterion.is_user_defined:
        procedure.cost(procedure.mesh)  # refuses what is no cost, also where nothing will be swapped
    with Watch(progress, procedure.mesh.n_edges if progress else 0, "edge") as watch:
        done = runner.run(edges, False, schedule, watch)
    result = _swapped_mesh(procedure.mesh, done.elements) if done.swaps else procedure.mesh
    rerun = partial(_history, runner, edges, schedule)
    found = Swapping(
        result, procedure.values, done.swaps, done.sweeps, done.tried, rerun, procedure.cost, procedure.mesh
    )
    if watch.stopped:
        raise Interrupted(found)
    return found


def _runner(
    procedure: Procedure, order: ArrayLike | None, schedule: str
) -> tuple[Procedure | AlongCurve, IntArray]:
    """What runs the procedure, and the edges in their order; a queue without an order follows a curve."""
    edges = np.arange(procedure.mesh.n_edges)
    if order is not None:
        return procedure, checks.permutation(order, len(edges))
    return (AlongCurve(procedure) if schedule == "queue" else procedure), edges


def _history(runner: Procedure | AlongCurve, order: IntArray, schedule: str) -> NDArray[np.void]:
    """Every swap that the procedure tries."""
    return runner.run(order, True, schedule).trace


def prepared(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion,
    norm: Norm,
    min_angle: float | None = None,
    min_area: float | None = None,
    min_gain: float | None = None,
) -> Procedure:
    """The procedure with these arguments, checked as for `swapped`, for any edge order."""
    mesh = checks.a_mesh(mesh)
    at_nodes = checks.nodal_values(mesh, values)
    criterion, norm = criteria.get(criterion), norms.checked(norm)
    limits = _limits(min_angle, min_area)
    gain = _least_gain(min_gain, criterion.scale(mesh, at_nodes))
    return Procedure(mesh, at_nodes, criterion, norm, limits, gain)


def _swapped_mesh(mesh: Mesh, elements: IntArray) -> Mesh:
    """The new mesh, with the green pairs whose elements are still in their rows."""
    kept = (elements[mesh.green] == mesh.elements[mesh.green]).all(axis=(1, 2))
    return Mesh._trusted(mesh.nodes, elements, mesh.green[kept])


def _limits(min_angle: float | None, min_area: float | None) -> Limits:
    """The limits on the elements that a swap creates, each relaxed by rounding."""
    angle, area = (0 if limit is None else limit for limit in (min_angle, min_area))
    angle = checks.number(angle, "min_angle", 0, LARGEST_MIN_ANGLE, "degrees from 0 to below 60")
    area = checks.number(area, "min_area", 0, np.inf, "a finite area of at least 0")
    return Limits(np.radians(angle) * JUST_MET, area * JUST_MET)


def _least_gain(min_gain: float | None, scale: float) -> norms.Tolerance:
    """The gain of the norm that a swap must exceed; ``min_gain`` replaces its absolute part."""
    gain = norms.tolerance(scale)
    if min_gain is None:
        return gain
    least = checks.number(min_gain, "min_gain", 0, np.inf, "a finite gain of at least 0")
    return gain._replace(absolute=least)
