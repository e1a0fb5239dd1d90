"""Which elements to refine (sections 3.2.1 to 3.2.3 and 6.2)."""

import numpy as np

from .. import checks, criteria
from .._typing import ArrayLike, FloatArray, IntArray, Values
from ..criteria.criterion import Criterion
from ..mesh.mesh import Mesh

MARKS = ("element", "edge", "node", "density")
TIES = ("first", "all")
TIED = 1e-9  # difference of costs that count as equal, as a fraction of the largest


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
        Values of u at the nodes, or a vectorised function u(x, y).
    criterion : str or Criterion
        Costs of other parts of the mesh than those that ``mark`` compares are averaged,
        see `averaged`.
    fraction : float
        Fraction of the elements to mark, from 0 to 1; rounded up to whole elements.
    mark : {"element", "edge", "node", "density"}
        ``"element"``: the elements with the largest mean cost (section 3.2.1);
        ``"edge"`` and ``"node"``: all elements at the edges or nodes with the largest
        costs, one edge or node after the other until the fraction is reached;
        ``"density"``: the elements with the largest sum of costs per area (section 6.2).
    ties : {"first", "all"}
        Whether elements that tie with the last one marked are left out or marked too;
        for ``mark="element"`` and ``mark="density"``.
    order : array_like of int, optional
        Numbers of the elements, edges or nodes: of those that tie, the first in this
        order are marked.  By default they are taken by their numbers.

    Returns
    -------
    (m,) ndarray of int64
        Numbers of the marked elements, in ascending order.

    Raises
    ------
    MeshError
        If the mesh is not valid, a value is not finite, a name is not known, the fraction
        is out of range, or the order is not a permutation.

    See Also
    --------
    meshlib.refined : Marks elements and splits them.

    Examples
    --------
    >>> from meshlib import problems
    >>> u = problems.functions["SR1"]
    >>> len(marked(problems.mesh("33"), u, "abn", fraction=0.2, mark="edge"))
    13
    """
    mesh = checks.a_mesh(mesh)
    at_nodes = checks.nodal_values(mesh, values)
    criterion, share = criteria.get(criterion), checks.fraction(fraction)
    checks.choice(mark, MARKS, "mark")
    checks.choice(ties, TIES, "ties")
    target = _rounded_up(share * mesh.n_elements)
    if not target:
        return np.empty(0, dtype=np.int64)
    costs = criterion.costs(mesh, at_nodes)
    place = "element" if mark == "density" else mark
    costs = averaged(mesh, costs, criterion.on, place)
    ranked = np.arange(len(costs)) if order is None else checks.permutation(order, len(costs), place)
    if mark in ("edge", "node"):
        return _around(mesh, costs, mark, target, ranked)
    if mark == "density":
        costs = costs / mesh.areas * _parts(criterion.on)
    return _worst(costs, target, ties, ranked)


def _rounded_up(number: float, rounding: float = 1e-9) -> int:
    """The least whole number that is not below, but for rounding: 0.1 * 30 gives 3."""
    return int(np.ceil(number - rounding))


def averaged(mesh: Mesh, costs: FloatArray, source: str, target: str) -> FloatArray:
    """Costs of one part of a mesh as means over the adjoining parts of another.

    Parameters
    ----------
    mesh : Mesh
    costs : (E,), (T,) or (N,) ndarray of float
        One for each ``source``.
    source, target : {"edge", "element", "node"}
        Parts of the mesh that have the costs, and that get the means.

    Returns
    -------
    (E,), (T,) or (N,) ndarray of float64
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


def _corners(mesh: Mesh, place: str) -> IntArray:
    """The three edges or nodes of each element."""
    return mesh.element_edges if place == "edge" else mesh.elements


def _incidence(mesh: Mesh, source: str, target: str) -> tuple[IntArray, IntArray]:
    """Numbers of a source and of a target that adjoin, for all such pairs."""
    if source == "element":
        return np.repeat(np.arange(mesh.n_elements), 3), _corners(mesh, target).ravel()
    edges, nodes = np.repeat(np.arange(mesh.n_edges), 2), mesh.edges.ravel()
    return (edges, nodes) if source == "edge" else (nodes, edges)


def _parts(place: str) -> int:
    """Number of costs of which the cost of an element is the mean."""
    return 1 if place == "element" else 3


def _worst(costs: FloatArray, target: int, ties: str, order: IntArray) -> IntArray:
    """The ``target`` elements with the largest costs, of those that tie the first in the order."""
    ascending = np.sort(costs)
    low, high = _tied(ascending, ascending[-target])
    if ties == "all":
        return np.flatnonzero(costs >= low)
    chosen = costs > high
    last = (costs >= low) & ~chosen
    ranked = order[last[order]]
    chosen[ranked[: target - np.count_nonzero(chosen)]] = True
    return np.flatnonzero(chosen)


def _around(mesh: Mesh, costs: FloatArray, mark: str, target: int, order: IntArray) -> IntArray:
    """Elements at the worst edges or nodes, of which just enough are taken to mark ``target`` elements."""
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


def _places(order: IntArray) -> IntArray:
    """The place of each number in the order."""
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return place


def _tied(ascending: FloatArray, value: float) -> tuple[float, float]:
    """Smallest and largest of the costs that count as equal to one of them, gap by gap."""
    gaps = np.flatnonzero(np.diff(ascending) > TIED * np.abs(ascending[[0, -1]]).max())
    place = np.searchsorted(gaps, np.searchsorted(ascending, value))
    low = ascending[gaps[place - 1] + 1] if place else ascending[0]
    return low, ascending[gaps[place]] if place < len(gaps) else ascending[-1]
