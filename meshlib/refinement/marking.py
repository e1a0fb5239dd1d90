"""Which elements to refine (sections 3.2.1 to 3.2.3 and 6.2)."""

import numpy as np

from .. import checks, criteria
from .._typing import ArrayLike, IntArray, Values
from ..criteria.criterion import Criterion
from ..mesh.mesh import Mesh

MARKS = ("element", "edge", "node", "density")
TIES = ("first", "all")
TIED = 1e-9  # costs this close, relative to the largest, count as equal
WHOLE = 1e-9  # 0.1 * 30 is 3, whatever binary fractions say


def marked(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    fraction: float = 0.2,
    mark: str = "element",
    ties: str = "first",
    order: ArrayLike | None = None,
) -> IntArray:
    """Numbers of the elements with the worst costs.

    Parameters
    ----------
    mesh : Mesh
    values : (N,) array_like of float, or callable
    criterion : str or Criterion
        A cost on other parts of the mesh than ``mark`` needs is averaged over them.
    fraction : float
        Share of the elements to mark, from 0 to 1.
    mark : {"element", "edge", "node", "density"}
        ``"element"``: the worst by mean cost (section 3.2.1); ``"edge"`` and
        ``"node"``: all elements at the worst edges or nodes, one edge or node after
        the other until the share is reached; ``"density"``: the worst by sum of
        costs per area (section 6.2).
    ties : {"first", "all"}
        Whether elements that tie with the last one are left out or marked too; for
        ``"element"`` and ``"density"``.
    order : array_like of int, optional
        Numbers of the elements, edges or nodes in the order that breaks ties.

    Returns
    -------
    (m,) ndarray of int64
        In ascending order.

    Raises
    ------
    MeshError
        If a name is not known, the fraction is out of range, or the order is no
        permutation.

    Examples
    --------
    >>> from meshlib import problems
    >>> u = problems.functions["SR1"]
    >>> len(marked(problems.mesh("33"), u, "abn", fraction=0.2, mark="edge"))
    13
    """
    mesh = checks.a_mesh(mesh)
    values = checks.nodal_values(mesh, values)
    criterion, share = criteria.get(criterion), checks.fraction(fraction)
    checks.choice(mark, MARKS, "mark")
    checks.choice(ties, TIES, "ties")
    target = int(np.ceil(share * mesh.n_elements - WHOLE))
    if not target:
        return np.empty(0, dtype=np.int64)
    costs = criterion.costs(mesh, values)
    if mark in ("edge", "node"):
        return _around(mesh, averaged(mesh, costs, criterion.on, mark), mark, target, order)
    costs = averaged(mesh, costs, criterion.on, "element")
    if mark == "density":
        costs = costs / mesh.areas * _parts(criterion.on)
    return _worst(costs, target, ties, order)


def averaged(mesh, costs, source, target):
    """Costs of one part of a mesh as means over the adjoining parts of another.

    Parameters
    ----------
    mesh : Mesh
    costs : ndarray of float
        One for each ``source``.
    source, target : {"edge", "element", "node"}

    Returns
    -------
    ndarray of float64
        One for each ``target``.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> mesh = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> averaged(mesh, np.array([0.0, 3.0, 0.0, 0.0, 0.0]), "edge", "element").tolist()
    [1.0, 1.0]
    """
    if source == target:
        return costs
    if target == "element":
        first, second, third = costs[_corners(mesh, source)].T
        return (first + second + third) / 3
    here, there = _incidence(mesh, source, target)
    size = {"edge": mesh.n_edges, "node": mesh.n_nodes}[target]
    return np.bincount(there, costs[here], size) / np.bincount(there, minlength=size)


def _corners(mesh, place):
    """The three edges or nodes of each element."""
    return mesh.element_edges if place == "edge" else mesh.elements


def _incidence(mesh, source, target):
    """Numbers of adjoining parts, pair by pair."""
    if source == "element":
        return np.repeat(np.arange(mesh.n_elements), 3), _corners(mesh, target).ravel()
    edges, nodes = np.repeat(np.arange(mesh.n_edges), 2), mesh.edges.ravel()
    return (edges, nodes) if source == "edge" else (nodes, edges)


def _parts(place):
    """How many costs an element's cost is the mean of."""
    return 1 if place == "element" else 3


def _worst(costs, target, ties, order):
    """Elements above the group that ties for the last place, and as many of that as the target takes."""
    order = order if order is None else checks.permutation(order, len(costs), "element")
    ascending = np.sort(costs)
    low, high = _tied(ascending, ascending[-target])
    if ties == "all":
        return np.flatnonzero(costs >= low)
    chosen = costs > high
    last = (costs >= low) & ~chosen
    ranked = np.flatnonzero(last) if order is None else order[last[order]]
    chosen[ranked[: target - np.count_nonzero(chosen)]] = True
    return np.flatnonzero(chosen)


def _around(mesh, costs, mark, target, order):
    """Elements at the worst edges or nodes, as many of these as the target takes."""
    order = checks.permutation(order, len(costs), mark)
    corners = _corners(mesh, mark)
    worst = costs[corners].T
    worst = np.maximum(np.maximum(worst[0], worst[1]), worst[2])
    low, high = _tied(np.sort(costs), np.sort(worst)[-target])
    chosen = worst > high
    last = np.flatnonzero((worst >= low) & ~chosen)
    place = np.where(costs < low, len(costs), _places(order))[corners[last]].min(axis=1)
    missing = target - np.count_nonzero(chosen)
    chosen[last[place <= np.partition(place, missing - 1)[missing - 1]]] = True
    return np.flatnonzero(chosen)


def _places(order):
    """Where each number stands in the order."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return place


def _tied(ascending, value):
    """Least and largest cost of the group that a cost belongs to, in which all gaps are rounding errors."""
    gaps = np.flatnonzero(np.diff(ascending) > TIED * np.abs(ascending[[0, -1]]).max())
    place = np.searchsorted(gaps, np.searchsorted(ascending, value))
    low = ascending[gaps[place - 1] + 1] if place else ascending[0]
    return low, ascending[gaps[place]] if place < len(gaps) else ascending[-1]
