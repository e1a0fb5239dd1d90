"""The best of all meshes of given nodes, proved by linear programming, or by listing them all.

A mesh is a choice among the *empty* triangles of its nodes, those that contain no other
node.  With x_t = 1 for the elements chosen and y_lr = 1 for those that share an edge::

    minimise    sum of w_t x_t  +  sum of c_lr y_lr
    subject to  sum of x_t = 1              over the triangles at a boundary edge,
                sum of x_l = sum of x_r     left and right of any other edge,
                sum over r of y_lr = x_l,   sum over l of y_lr = x_r.

The balance at an edge says that crossing it does not change how often a point is
covered, which is once at the boundary.
"""

from dataclasses import dataclass
from time import monotonic

import numpy as np

from .. import checks, criteria
from .._typing import Norm, Values
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..errors import InvalidInputError, NotReachedError, UnknownNameError
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from .empty_triangles import Candidates

MOST_NODES = 120
SECONDS = 60.0  # time limit of the solver
LARGEST_COST = 1e6  # given to the solver, whose tolerances are absolute
SCALES = (1.0, 1e6, 1e9)  # of the largest cost, for the multipliers


@dataclass(frozen=True, repr=False, eq=False)
class Optimal(Record):
    """The best mesh and the proof.

    Attributes
    ----------
    mesh : Mesh
        The best mesh; if not ``proved``, the best that was found in time.
    values : (N,) ndarray of float64
        The nodal values given.
    cost_before, cost_after : float
        Norm of the cost vector of the mesh given and of the best mesh.
    bound : float
        No mesh of these nodes on this domain costs less, to rounding.  It follows from
        multipliers of the constraints by weak duality and needs no trust in the solver;
        where it is below the cost, that nothing lies between rests on the solver.
    proved : bool
        Whether the solver ended before the time was up.
    """

    cost_before: float
    cost_after: float
    bound: float
    proved: bool


def optimal(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    norm: Norm = "L2",
    seconds: float = SECONDS,
) -> Optimal:
    """The best mesh with the same nodes and the same domain (Definition 3.1.1).

    Parameters
    ----------
    mesh : Mesh
        Any mesh of the nodes, of at most 120; it fixes the domain.
    values : (N,) array_like of float, or callable
    criterion : str or Criterion
        On edges or elements, for example ``criteria.min_error(u)``.
    norm : {"L1", "L2"}
        Also 1 and 2.
    seconds : float
        Time limit, in seconds, of the search and of the bound each.  When it is up, the
        best mesh so far is returned, with ``proved`` false.

    Returns
    -------
    Optimal

    Raises
    ------
    MeshError
        If there are too many nodes, the criterion or the norm is no sum over edges or
        elements, or the time is up before any mesh was found.

    Notes
    -----
    Finding the mesh of least sum is hard in general, but the relaxation to fractions is
    tight, or nearly so, in every case of this report, and 33 nodes take about a second.
    With 81 nodes it is a few seconds for data without ties, and may be very long for
    data with many.  Elements flat to rounding are left out, as `swapped` leaves them out.

    Examples
    --------
    Edge swapping stops above the best mesh:

    >>> from meshlib import problems, swapped
    >>> mesh, u = problems.mesh("33"), problems.SR2
    >>> found = [method(mesh, u, "abn", norm="L1").cost_after for method in (swapped, optimal)]
    >>> print("{:.2f} {:.2f}".format(*found))
    21.74 16.77
    """
    mesh, criterion = checks.a_mesh(mesh), criteria.get(criterion)
    values = checks.nodal_values(mesh, values)
    power = 1 if norms.checked(norm, (1, 2)) == 1 else 2
    seconds = checks.number(seconds, "seconds", 0, np.inf, "a finite number of seconds of at least 0")
    if criterion.on == "node":
        raise UnknownNameError(
            "unknown", f"criterion {criterion.name!r} is on nodes; give one on edges or elements"
        )
    if mesh.n_nodes > MOST_NODES:
        raise InvalidInputError("range", f"the mesh has {mesh.n_nodes} nodes; give at most {MOST_NODES}")
    candidates = Candidates(mesh)
    costs, matrix, right = _model(candidates, values, criterion, power)
    chosen, proved = _solved(costs, matrix, right, seconds)
    best = Mesh(mesh.nodes, candidates.triangles[chosen[: len(candidates)] > 0.5]).validate()
    before, cost = (float(np.linalg.norm(criterion.costs(m, values), power)) for m in (mesh, best))
    bound = min(cost, _bound(costs, matrix, right, seconds) ** (1 / power))
    return Optimal(best, values, before, cost, bound, proved)


def _model(candidates, values, criterion, norm):
    """Costs, matrix and right-hand side of the equations."""
    points = np.column_stack([candidates.mesh.nodes, values])
    if criterion.on == "element":
        found = criterion.cost(*np.moveaxis(points[candidates.triangles], 1, 0))
        return checks.cost_vector(found, len(candidates), "empty triangle") ** norm, *candidates.balance(0)
    edge, left, right = candidates.pairs
    p, q = candidates.edges[edge].T
    apex_left, apex_right = (candidates.apex(edge, t) for t in (left, right))
    found = criterion.cost(*(points[n] for n in (p, q, apex_left, apex_right)))
    costs = checks.cost_vector(found, len(edge), "pair of empty triangle") ** norm
    return np.concatenate([np.zeros(len(candidates)), costs]), *candidates.balance(len(edge))


def _solved(costs, matrix, right, seconds):
    """The best choice found, rounded, and whether it is proved to be optimal."""
    from scipy.optimize import Bounds, LinearConstraint, milp

    scale = LARGEST_COST / (costs.max() or 1.0)
    options = {"mip_rel_gap": 0, "time_limit": seconds}
    found = milp(
        scale * costs,
        integrality=np.ones(len(costs)),
        bounds=Bounds(0, 1),
        options=options,
        constraints=LinearConstraint(matrix, right, right),
    )
    if found.x is None:
        raise NotReachedError(
            "solver", f"no mesh found within {seconds:g} s; give fewer nodes or more seconds"
        )
    return np.rint(found.x), bool(found.success)


def _bound(costs, matrix, right, seconds):
    """The best lower bound m . right + sum of min(0, costs - m A) over some multipliers m."""
    from scipy.optimize import linprog

    best, unit, end = 0.0, costs.max() or 1.0, monotonic() + seconds
    for scale in SCALES:
        options = {"time_limit": max(end - monotonic(), 0.0)}
        relaxed = linprog(scale / unit * costs, A_eq=matrix, b_eq=right, bounds=(0, None), options=options)
        if relaxed.eqlin.marginals is None or not relaxed.success:
            break
        m = relaxed.eqlin.marginals * unit / scale
        best = max(best, right @ m + np.minimum(costs - matrix.T @ m, 0).sum())
    return best
