"""Mesh refinement: marking the worst elements and splitting them (section 3.2)."""

from dataclasses import dataclass, field
from functools import cached_property, reduce

import numpy as np

from .. import checks, criteria
from .._typing import ArrayLike, BoolArray, FloatArray, IntArray, Values
from ..criteria.criterion import Criterion
from ..errors import InvalidMeshError
from ..geometry.predicates import orientation
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from .marking import marked as marked_elements
from .splitting import SPLITS


@dataclass(frozen=True, repr=False, eq=False)
class Refinement(Record):
    """A refined mesh and how it came about.

    Attributes
    ----------
    mesh : Mesh
        Conforming; its first N nodes are those of the start mesh.
    values : (N',) ndarray of float64
        Values of the function at the nodes if one was given; else the old values, and
        at each new node the mean of the old values between which it lies.
    marked : (m,) ndarray of int
        Numbers of the elements of the start mesh that the criterion chose.
    parents : (T',) ndarray of int
        Number of the element of the start mesh of which each new element is a part; for
        a green pair put together again, the number of the first of the pair.
    """

    values: FloatArray
    marked: IntArray
    parents: IntArray
    _start: Mesh = field(repr=False)
    _start_values: FloatArray = field(repr=False)
    _criterion: Criterion = field(repr=False)
    _on_demand = ("cost_before", "cost_after")

    @cached_property
    def cost_before(self) -> float:
        """L2 norm of the cost vector of the start mesh."""
        return float(np.linalg.norm(self._criterion.costs(self._start, self._start_values)))

    @cached_property
    def cost_after(self) -> float:
        """L2 norm of the cost vector of the refined mesh, which may be larger."""
        return float(np.linalg.norm(self._criterion.costs(self.mesh, self.values)))


def refined(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    fraction: float = 0.2,
    mark: str = "element",
    split: str = "red-green",
    ties: str = "first",
    order: ArrayLike | None = None,
) -> Refinement:
    """The mesh with its worst elements split into smaller ones.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    values : (N,) array_like of float, or callable
        Values of u at the nodes, or a vectorised function u(x, y).
    criterion : str or Criterion
        For example ``"jnd"``; see `meshlib.criteria`.
    fraction : float
        Fraction of the elements to mark, from 0 to 1; rounded up to whole elements.
    mark : {"element", "edge", "node", "density"}
        ``"element"``: the elements with the largest mean cost; ``"edge"`` and ``"node"``:
        all elements at the edges or nodes with the largest costs; ``"density"``: the
        elements with the largest sum of costs per area.
    split : {"red-green", "centroid", "longest-edge"}
        Bisection of all edges with hanging nodes closed (section 3.2.4), insertion
        of a node at the centroid (3.2.5), bisection of the longest edge (3.2.6).
    ties : {"first", "all"}
        Whether elements that tie with the last one marked are left out or marked too;
        for ``mark="element"`` and ``mark="density"``.
    order : array_like of int, optional
        Numbers of the elements, edges or nodes: of those that tie, the first in this
        order are marked.  By default they are taken by their numbers.

    Returns
    -------
    Refinement

    Raises
    ------
    MeshError
        If the mesh is not valid, a value is not finite, a name is not known, the fraction
        is out of range, the order is not a permutation, or an element is too thin to split.

    See Also
    --------
    swapped, smoothed, combined : Other ways to lower the error.
    approximate : A mesh that meets a tolerance.

    Notes
    -----
    The mesh remembers its green pairs in ``mesh.green``; swapping, smoothing and the
    other splits keep the pairs that they do not change.  Red-green refinement first puts
    these pairs together again (section 3.2.4), so that angles do not deteriorate over
    repeated calls: every element is similar to one of the start mesh, or half of such
    an element.

    Examples
    --------
    >>> from meshlib import problems
    >>> u = problems.functions["SR1"]
    >>> refined(problems.mesh("81"), u, fraction=1, split="red-green").mesh.counts
    (289, 800, 512)
    >>> refined(problems.mesh("33"), u, fraction=1, split="centroid").mesh.counts
    (89, 256, 168)
    """
    checks.choice(split, tuple(SPLITS), "split")
    mesh, criterion = checks.a_mesh(mesh), criteria.get(criterion)
    old = checks.nodal_values(mesh, values)
    chosen = marked_elements(mesh, old, criterion, fraction=fraction, mark=mark, ties=ties, order=order)
    pieces, origin, corners, pairs = SPLITS[split](mesh, chosen)
    elements, parents, green = _by_parent(pieces, origin, pairs)
    nodes, whole = _with_means(mesh.nodes, corners), np.bincount(parents, minlength=mesh.n_elements) == 1
    _refuse_too_thin(nodes, elements, parents, ~whole)
    result = Mesh._trusted(nodes, elements, _kept_green(mesh, parents, whole) if green is None else green)
    new = checks.nodal_values(result, values) if callable(values) else _with_means(old, corners)
    return Refinement(result, new, chosen, parents, mesh, old, criterion)


def _by_parent(
    elements: IntArray, parents: IntArray, green: IntArray | None
) -> tuple[IntArray, IntArray, IntArray | None]:
    """Elements in the order of their parents, these parents, and the green pairs by their new numbers."""
    order = np.argsort(parents, kind="stable")
    if green is not None:
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        green = place[green]
    return elements.take(order, axis=0), parents.take(order).astype(np.intp), green


def _with_means(values: FloatArray, corners: IntArray) -> FloatArray:
    """Values at the nodes, followed by the means over each row of ``corners`` for the new nodes."""
    means = reduce(np.add, (values.take(column, axis=0) for column in corners.T)) / corners.shape[1]
    return np.concatenate([values, means])


def _kept_green(mesh: Mesh, parents: IntArray, whole: BoolArray) -> IntArray:
    """The green pairs of which neither half was split, by their new numbers."""
    return np.searchsorted(parents, mesh.green[whole[mesh.green].all(axis=1)])


def _refuse_too_thin(nodes: FloatArray, elements: IntArray, parents: IntArray, split: BoolArray) -> None:
    """Raise a MeshError that names elements so thin that rounding turns their parts over."""
    parts = np.flatnonzero(split[parents])
    turns = orientation(*(nodes.take(column, axis=0) for column in elements.take(parts, axis=0).T))
    bad = np.unique(parents[parts[turns <= 0]])
    if bad.size:
        raise InvalidMeshError(
            "degenerate", f"element {bad[0]} is too thin to be split; move one of its nodes", bad, bad.size
        )
