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

import numpy as np

from .. import checks, criteria
from ..errors import MeshError
from ..mesh.mesh import Mesh
from .empty_triangles import Candidates

MOST_NODES, SECONDS = 120, 60.0
LARGEST_COST = 1e6  # given to the solver, whose tolerances are absolute
SCALES = (1.0, 1e6, 1e9)  # of the largest cost, for the multipliers


@dataclass(frozen=True)
class Optimal:
    """The best mesh and the proof.

    Attributes
    ----------
    mesh : Mesh
    cost : float
        Norm of its cost vector.
    bound : float
        No mesh of these nodes on this domain costs less, to rounding.  It follows from
        multipliers of the constraints by weak duality and needs no trust in the solver;
        where it is below the cost, that nothing lies between rests on the solver.
    """

    mesh: Mesh
    cost: float
    bound: float


def optimal(mesh, values, criterion="jnd", norm=2, seconds=SECONDS):
    """The best mesh with the same nodes and the same domain (Definition 3.1.1).

    Parameters
    ----------
    mesh : Mesh
        Any mesh of the nodes, of at most 120; it fixes the domain.
    values : (N,) array_like of float, or callable
    criterion : str or Criterion
        On edges or elements, for example ``criteria.min_error(u)``.
    norm : {1, 2}
    seconds : float
        How long the solver may take.

    Returns
    -------
    Optimal

    Raises
    ------
    MeshError
        If there are too many nodes, the criterion or the norm is no sum over edges or
        elements, or the time is up.

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
    >>> print(f"{swapped(mesh, u, 'abn', 1).cost_after:.2f} {optimal(mesh, u, 'abn', 1).cost:.2f}")
    21.74 16.77
    """
    mesh, criterion = checks.a_mesh(mesh), criteria.get(criterion)
    values = checks.nodal_values(mesh, values)
    checks.choice(norm, (1, 2), "norm")
    if criterion.on == "node":
        raise MeshError("unknown", f"criterion {criterion.name!r} is on nodes; give one on edges or elements")
    if mesh.n_nodes > MOST_NODES:
        raise MeshError("range", f"the mesh has {mesh.n_nodes} nodes; give at most {MOST_NODES}")
    candidates = Candidates(mesh)
    costs, matrix, right = _model(candidates, values, criterion, norm)
    chosen = _solved(costs, matrix, right, seconds)[: len(candidates)]
    best = Mesh(mesh.nodes, candidates.triangles[chosen > 0.5]).validate()
    cost = float(np.linalg.norm(criterion.costs(best, values), norm))
    return Optimal(best, cost, min(cost, _bound(costs, matrix, right) ** (1 / norm)))


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
    """The optimal choice, rounded."""
    from scipy.optimize import Bounds, LinearConstraint, milp

    scale = LARGEST_COST / (costs.max() or 1.0)
    options = {"mip_rel_gap": 0, "time_limit": float(seconds)}
    found = milp(
        scale * costs,
        integrality=np.ones(len(costs)),
        bounds=Bounds(0, 1),
        options=options,
        constraints=LinearConstraint(matrix, right, right),
    )
    if not found.success:
        raise MeshError("solver", f"no proof within {seconds:g} seconds; give fewer nodes or more seconds")
    return np.rint(found.x)


def _bound(costs, matrix, right):
    """The best lower bound m . right + sum of min(0, costs - m A) over some multipliers m."""
    from scipy.optimize import linprog

    best, unit = 0.0, costs.max() or 1.0
    for scale in SCALES:
        relaxed = linprog(scale / unit * costs, A_eq=matrix, b_eq=right, bounds=(0, None))
        m = relaxed.eqlin.marginals * unit / scale
        best = max(best, right @ m + np.minimum(costs - matrix.T @ m, 0).sum())
    return best
