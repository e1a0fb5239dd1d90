"""Which elements to refine (sections 3.2.1 to 3.2.3 and 6.2)."""
import numpy as np

from . import checks, criteria

MARKS = ("element", "edge", "node", "density")
TIES = ("first", "all")
TIED = 1e-9  # costs this close, relative to the largest, count as equal
WHOLE = 1e-9  # 0.1 * 30 is 3, whatever binary fractions say


def marked(mesh, values, criterion="abn", fraction=0.2, mark="element", ties="first", order=None):
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
    >>> len(marked(problems.mesh("33"), u, "abn", 0.2, "edge"))
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
    here, there = _incidence(mesh, source, target)
    size = {"edge": mesh.n_edges, "element": mesh.n_elements, "node": mesh.n_nodes}[target]
    return np.bincount(there, costs[here], size) / np.bincount(there, minlength=size)


def _incidence(mesh, source, target):
    """Numbers of adjoining parts, pair by pair."""
    elements = np.repeat(np.arange(mesh.n_elements), 3)
    edges = np.repeat(np.arange(mesh.n_edges), 2)
    pairs = {("edge", "element"): (mesh.element_edges.ravel(), elements),
             ("node", "element"): (mesh.elements.ravel(), elements),
             ("node", "edge"): (mesh.edges.ravel(), edges)}
    return pairs[source, target] if (source, target) in pairs else pairs[target, source][::-1]


def _parts(place):
    """How many costs an element's cost is the mean of."""
    return 1 if place == "element" else 3


def _worst(costs, target, ties, order):
    ranked, group = _ranking(costs, order, "element")
    if ties == "all":
        target = np.searchsorted(group, group[target - 1], side="right")
    return np.sort(ranked[:target])


def _around(mesh, costs, mark, target, order):
    """Elements at the worst edges or nodes, as many of these as the target takes."""
    ranked, _ = _ranking(costs, order, mark)
    rank = np.empty(len(ranked), dtype=np.int64)
    rank[ranked] = np.arange(len(ranked))
    first = rank[mesh.element_edges if mark == "edge" else mesh.elements].min(axis=1)
    return np.flatnonzero(first <= np.sort(first)[target - 1])


def _ranking(costs, order, what):
    """Numbers by descending cost, equal costs in the given order, and their groups."""
    order = checks.permutation(order, len(costs), what)
    descending = order[np.argsort(-costs[order], kind="stable")]
    drops = -np.diff(costs[descending]) > TIED * np.abs(costs).max()
    group = np.concatenate([[0], np.cumsum(drops)])
    place = np.empty(len(costs), dtype=np.int64)
    place[order] = np.arange(len(order))
    ranked = descending[np.lexsort((place[descending], group))]
    return ranked, group
