"""The best of all meshes of given nodes, found by an integer program and proved by a linear one.

A mesh is a choice among the *empty* triangles of its nodes, those that contain no other
node.  With x_t = 1 for the elements chosen and y_lr = 1 for those that share an edge::

    minimise    sum of w_t x_t  +  sum of c_lr y_lr
    subject to  sum of x_t = 1              over the triangles at a boundary edge,
                sum of x_l = sum of x_r     left and right of any other edge,
                sum over r of y_lr = x_l,   sum over l of y_lr = x_r.

By the first two equations the elements cover the domain exactly once: they do so along the
boundary, and on both sides of any other edge equally often.
"""

from dataclasses import dataclass
from time import monotonic
from typing import Any

import numpy as np

from .. import checks, criteria
from .._typing import FloatArray, Norm, Values
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..errors import InvalidInputError, NotReachedError, UnknownNameError
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from .empty_triangles import Candidates

MOST_NODES = 120  # number of nodes, above which the number of empty triangles is too large


@dataclass(frozen=True, repr=False, eq=False)
class Optimal(Record):
    """The best mesh and the proof.

    Attributes
    ----------
    mesh : Mesh
        The best mesh; if not ``proved``, the best that was found within the time limit.
    values : (N,) ndarray of float64
        The nodal values given.
    cost_before, cost_after : float
        Norm of the cost vector of the mesh given and of the best mesh.
    bound : float
        Lower bound of the cost of all meshes with these nodes and this domain, up to rounding.
        It follows from multipliers of the constraints by weak duality, so that it does not
        depend on the solver being right.  If it is below ``cost_after``, it is the solver
        alone that says that no mesh costs less than ``mesh``.
    proved : bool
        Whether the solver ended before the time was up.

    See Also
    --------
    optimal : makes such records.
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
    seconds: float = 60.0,
) -> Optimal:
    """The best mesh with the same nodes and the same domain (Definition 3.1.1).

    Parameters
    ----------
    mesh : Mesh
        Any mesh of the nodes, of at most 120; it fixes the domain.
    values : (N,) array_like of float, or callable
        Nodal values, or a vectorised function u(x, y).
    criterion : str or Criterion
        A criterion on edges or elements, for example ``criteria.min_error(u)``.
    norm : {"L1", "L2"}
        Norm of the cost vector; also 1 and 2.
    seconds : float
        Time limit in seconds, for the search and again for the bound.  When the search is
        out of time, the best mesh so far is returned, with ``proved`` false.

    Returns
    -------
    Optimal

    Raises
    ------
    MeshError
        If there are too many nodes, the criterion is on nodes, the norm is another one, or
        the time is up before any mesh was found.

    See Also
    --------
    local_optima : the best of many local optima, for meshes of any size.
    meshlib.swapped, meshlib.annealed : good meshes fast, without a proof.

    Notes
    -----
    Finding the mesh of least sum is hard in general.  In every case of this report, however,
    the relaxation to fractions is tight, or nearly so, and 33 nodes take about a second.
    81 nodes take a few seconds if few meshes have equal costs, and may take very long if
    many have.  As in `swapped`, no element is flat to rounding.

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


def _model(
    candidates: Candidates, values: FloatArray, criterion: Criterion, power: int
) -> tuple[FloatArray, Any, FloatArray]:
    """Costs of all variables, to a power, and the sparse matrix and right-hand side of the equations."""
    points = np.column_stack([candidates.mesh.nodes, values])
    if criterion.on == "element":
        found = criterion.cost(*np.moveaxis(points[candidates.triangles], 1, 0))
        return checks.cost_vector(found, len(candidates), "empty triangle") ** power, *candidates.balance(0)
    edge, left, right = candidates.pairs
    p, q = candidates.edges[edge].T
    apex_left, apex_right = (candidates.apex(edge, t) for t in (left, right))
    found = criterion.cost(*(points[n] for n in (p, q, apex_left, apex_right)))
    costs = checks.cost_vector(found, len(edge), "pair of empty triangle") ** power
    return np.concatenate([np.zeros(len(candidates)), costs]), *candidates.balance(len(edge))


def _solved(
    costs: FloatArray, matrix: Any, right: FloatArray, seconds: float, largest: float = 1e6
) -> tuple[FloatArray, bool]:
    """The best choice found, rounded, and whether it is proved to be optimal.

    Costs are scaled so that the largest is ``largest``, since the tolerances of the solver
    are absolute.
    """
    from scipy.optimize import Bounds, LinearConstraint, milp

    scale = largest / (costs.max() or 1.0)
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


def _bound(
    costs: FloatArray,
    matrix: Any,
    right: FloatArray,
    seconds: float,
    scales: tuple[float, ...] = (1.0, 1e6, 1e9),
) -> float:
    """The best lower bound m . right + sum of min(0, costs - m A) over some multipliers m.

    The solver finds multipliers m for each of ``scales``, the largest cost that it is given.
    """
    from scipy.optimize import linprog

    best, unit, end = 0.0, costs.max() or 1.0, monotonic() + seconds
    for scale in scales:
        options = {"time_limit": max(end - monotonic(), 0.0)}
        relaxed = linprog(scale / unit * costs, A_eq=matrix, b_eq=right, bounds=(0, None), options=options)
        if relaxed.eqlin.marginals is None or not relaxed.success:
            break
        m = relaxed.eqlin.marginals * unit / scale
        best = max(best, right @ m + np.minimum(costs - matrix.T @ m, 0).sum())
    return best
