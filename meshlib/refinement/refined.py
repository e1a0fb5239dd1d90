"""Mesh refinement: marking the worst elements and splitting them (section 3.2)."""

from dataclasses import dataclass, field
from functools import cached_property, reduce

import numpy as np

from .. import checks, criteria
from .._typing import ArrayLike, FloatArray, IntArray, Values
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
        Nodal values: of the function if one was given, else with the means of the
        old values at the new nodes.
    marked : (m,) ndarray of int
        Elements of the start mesh that the criterion chose.
    parents : (T',) ndarray of int
        Element of the start mesh that each new element is a part of; for a green
        pair put together again, the first of the pair.
    """

    marked: IntArray
    parents: IntArray
    _start: Mesh = field(repr=False)
    _start_values: FloatArray = field(repr=False)
    _criterion: Criterion = field(repr=False)

    @cached_property
    def cost_before(self) -> float:
        """L2 norm of the cost vector of the start mesh."""
        return float(np.linalg.norm(self._criterion.costs(self._start, self._start_values)))

    @cached_property
    def cost_after(self) -> float:
        """L2 norm of the cost vector of the refined mesh, which may be larger."""
        return float(np.linalg.norm(self._criterion.costs(self.mesh, self.values)))

    def __getstate__(self) -> dict[str, object]:
        """All that can be asked for, computed, since a criterion need not be picklable."""
        lazy = {name: getattr(self, name) for name in ("cost_before", "cost_after")}
        hidden = ("_start", "_start_values", "_criterion")
        return {k: v for k, v in self.__dict__.items() if k not in hidden} | lazy


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
        Share of the elements to mark, from 0 to 1.
    mark : {"element", "edge", "node", "density"}
        How costs choose elements, see `meshlib.refinement.marking.marked`.
    split : {"red-green", "centroid", "longest-edge"}
        Bisection of all edges with hanging nodes closed (section 3.2.4), insertion
        of a node at the centroid (3.2.5), bisection of the longest edge (3.2.6).
    ties : {"first", "all"}
        Whether elements that tie with the last one are left out or marked too.
    order : array_like of int, optional
        Numbers of the elements, edges or nodes in the order that breaks ties.

    Returns
    -------
    Refinement

    Raises
    ------
    MeshError
        If the mesh is not valid, a value is not finite, a name is not known, or the
        fraction is out of range.

    Notes
    -----
    The mesh remembers its green pairs in ``mesh.green``; swapping, smoothing and the
    other splits keep those that they leave alone.  When it is refined again, they
    are put together first (section 3.2.4), so that angles do not deteriorate
    over repeated calls: every angle is one of the start mesh or of the bisection
    of an element similar to one of the start mesh.

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
    chosen = marked_elements(mesh, values, criterion, fraction=fraction, mark=mark, ties=ties, order=order)
    *parts, corners, green = SPLITS[split](mesh, chosen)
    elements, parents, green = _by_parent(*parts, green)
    nodes, whole = _with_means(mesh.nodes, corners), np.bincount(parents, minlength=mesh.n_elements) == 1
    _refuse_too_thin(nodes, elements, parents, ~whole)
    result = Mesh._trusted(nodes, elements, _kept_green(mesh, parents, whole) if green is None else green)
    old, new = _values(result, mesh, values, corners)
    return Refinement(result, new, chosen, parents, mesh, old, criterion)


def _by_parent(elements, parents, green):
    """The same in the order of the parents."""
    order = np.argsort(parents, kind="stable")
    if green is not None:
        place = np.empty_like(order)
        place[order] = np.arange(len(order))
        green = place[green]
    return elements.take(order, axis=0), parents.take(order).astype(np.intp), green


def _with_means(values, corners):
    """Values at the nodes, and at new nodes the means over their corners."""
    means = reduce(np.add, (values.take(column, axis=0) for column in corners.T)) / corners.shape[1]
    return np.concatenate([values, means])


def _kept_green(mesh, parents, whole):
    """The green pairs of which neither half was split, by their new numbers."""
    return np.searchsorted(parents, mesh.green[whole[mesh.green].all(axis=1)])


def _refuse_too_thin(nodes, elements, parents, split):
    """Midpoints are rounded: an element about as thin as that has no parts."""
    parts = np.flatnonzero(split[parents])
    turns = orientation(*(nodes.take(column, axis=0) for column in elements.take(parts, axis=0).T))
    bad = np.unique(parents[parts[turns <= 0]])
    if bad.size:
        raise InvalidMeshError(
            "degenerate", f"element {bad[0]} is too thin to be split; move one of its nodes", bad, bad.size
        )


def _values(result, mesh, values, corners):
    """Nodal values of the start mesh and of the result."""
    old = checks.nodal_values(mesh, values)
    return old, checks.nodal_values(result, values) if callable(values) else _with_means(old, corners)
