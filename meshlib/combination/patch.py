r"""The patch of elements around a node, its indicator of the error, and the two ways to change it.

::

          q---r                 The elements around p are the patch: its inner edges are
         / \ / \                the spokes p-q, p-r, ..., its rim is q-r, ...  The elements
        o---p---s               beyond the rim do not change, but costs of edges on the rim
         \ / \ /                depend on them.
          n---m
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from .._typing import ArrayLike, BoolArray, FloatArray, Function, IntArray
from ..criteria.criterion import Criterion
from ..criteria.norms import Tolerance
from ..interpolation.interpolant import Interpolant
from ..mesh.mesh import Mesh
from ..mesh.quality import angles
from ..mesh.topology import canonical, quadrilaterals
from ..swapping.procedure import Limits, Procedure

SHARING = {"edge": 2, "element": 3, "node": 1}  # number of nodes of a patch in an element that affects it


class Search(NamedTuple):
    """How a better position of a node is searched for.

    Attributes
    ----------
    samples : tuple of tuple of int
        Weights of the corners of an element, for each position in it that is tried first.
    directions : tuple of tuple of int
        Steps along x and along y, in lengths of a step.
    first, last : float
        Length of the first steps, and length below which the search ends, as fractions of
        the extent of the patch.
    """

    samples: tuple[tuple[int, ...], ...] = ((1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4))
    directions: tuple[tuple[int, ...], ...] = (
        *((1, 0), (1, 1), (0, 1), (-1, 1)),
        *((-1, 0), (-1, -1), (0, -1), (1, -1)),
    )
    first: float = 0.25
    last: float = 1e-4

    def places(self, corners: FloatArray) -> FloatArray:
        """The first positions in elements with these corners, (t, 3, 2), as an (n, 2) array."""
        samples = np.array(self.samples)
        weights = samples / samples.sum(axis=1, keepdims=True)
        return np.einsum("sk,tkc->tsc", weights, corners).reshape(-1, 2)

    def around(self, at: FloatArray, length: float) -> FloatArray:
        """The positions one step of this length away from a position, (8, 2)."""
        return at + length * np.array(self.directions, dtype=float)


SEARCH = Search()


@dataclass(frozen=True)
class Objective:
    """The indicator that the combined strategy lowers: the sum of costs, or of their squares.

    Attributes
    ----------
    function : callable
        Vectorised u(x, y).
    criterion : Criterion
    norm : {1, 2}
        Power of the costs in the sum.
    tolerance : Tolerance
        Relative and absolute part of the gain that a swap must exceed.
    limits : Limits
        Limits on the elements that a step creates.
    rim : bool
        Whether the costs on the rim of a patch count.
    """

    function: Function
    criterion: Criterion
    norm: int
    tolerance: Tolerance
    limits: Limits
    rim: bool

    def of(self, mesh: Mesh) -> float:
        """The indicator of a whole mesh."""
        same = Mesh._trusted(mesh.nodes, canonical(mesh.elements))  # as in patches, so that costs round alike
        return float((self.criterion.costs(same, self.function(*mesh.nodes.T)) ** self.norm).sum())

    def patch(self, nodes: FloatArray, elements: IntArray, values: FloatArray, centre: int) -> "Patch":
        """The patch around the node ``centre`` of a mesh, which is given by its arrays."""
        inner = (elements == centre).any(axis=1)
        own = canonical(elements[inner])
        beyond = self._affected(elements, own, inner, len(nodes)) if self.rim else own[:0]
        used, rows = np.unique(np.concatenate([own, beyond]), return_inverse=True)
        return Patch(
            self,
            used,
            int(np.searchsorted(used, centre)),
            len(own),
            np.flatnonzero(inner),
            nodes[used],
            values[used],
            rows.reshape(-1, 3),
        )

    def _affected(self, elements: IntArray, own: IntArray, inner: BoolArray, n_nodes: int) -> IntArray:
        """The elements beyond the rim whose costs a step changes or on which costs of the rim depend."""
        here = np.zeros(n_nodes, dtype=bool)
        here[own] = True
        return canonical(elements[~inner & (here[elements].sum(axis=1) >= SHARING[self.criterion.on])])


@dataclass(frozen=True)
class Patch:
    """A patch and the elements around it as a small mesh, whose nodes are numbered from 0.

    Attributes
    ----------
    objective : Objective
    used : (n,) ndarray of int
        Numbers of the nodes in the large mesh, in ascending order.
    centre : int
        Number of the node in the middle, in the small mesh.
    size : int
        Number of elements of the patch; they come first in ``elements``.
    rows : (size,) ndarray of int
        Numbers of the elements of the patch in the large mesh.
    nodes, values, elements : (n, 2), (n,) and (m, 3) ndarray
        The small mesh.
    """

    objective: Objective
    used: IntArray
    centre: int
    size: int
    rows: IntArray
    nodes: FloatArray
    values: FloatArray
    elements: IntArray

    @property
    def own(self) -> IntArray:
        """(size, 3): the elements of the patch, with the node numbers of the large mesh."""
        return self.used[self.elements[: self.size]]

    @cached_property
    def mesh(self) -> Mesh:
        """The patch and the elements around it as a Mesh."""
        return Mesh._trusted(self.nodes, self.elements)

    @cached_property
    def error(self) -> float:
        """The indicator of the patch as it is, even if its elements are flat."""
        return float(self._sums(self.nodes[[self.centre]])[0])

    @cached_property
    def extent(self) -> float:
        """Largest distance of two nodes of the patch along x or y."""
        return float(np.ptp(self.nodes[self.elements[: self.size]].reshape(-1, 2), axis=0).max())

    # -- the indicator with the node in the middle at other positions ---------------------

    def errors(self, positions: ArrayLike) -> FloatArray:
        """The indicator, (m,), for each position, (m, 2); infinity where an element would be refused."""
        positions = np.asarray(positions, dtype=float)
        found, fits = np.full(len(positions), np.inf), self._fits(positions)
        if fits.any():
            found[fits] = self._sums(positions[fits])
        return found

    def _sums(self, positions: FloatArray) -> FloatArray:
        """The indicator, (m,), for each position, (m, 2), even if elements overlap there."""
        return (self._costs(*self._moved(positions)) ** self.objective.norm).sum(axis=1)

    def _moved(self, positions: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Nodes (m, n, 2) and values (m, n) with the centre at each of m positions."""
        nodes, values = (np.tile(a, (len(positions),) + (1,) * a.ndim) for a in (self.nodes, self.values))
        nodes[:, self.centre] = positions
        values[:, self.centre] = self.objective.function(*positions.T)
        return nodes, values

    def _fits(self, positions: FloatArray, flat: float = 1e-9) -> BoolArray:
        """For each position whether no element would be turned over, flat, or sharper than the limit.

        Elements are flat if an angle is below ``flat`` radians.
        """
        nodes = np.tile(self.nodes, (len(positions), 1, 1))
        nodes[:, self.centre] = positions
        corners = nodes[:, self.elements[: self.size]]
        u, v = corners[:, :, 1] - corners[:, :, 0], corners[:, :, 2] - corners[:, :, 0]
        upright = (u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0] > 0).all(axis=1)
        smallest = angles(corners.reshape(-1, 3, 2)).reshape(len(positions), -1).min(axis=1)
        return upright & (smallest >= max(flat, self.objective.limits.angle))

    def _costs(self, nodes: FloatArray, values: FloatArray) -> FloatArray:
        """The costs in the sum, a row for each of m positions; nodes (m, n, 2) and values (m, n)."""
        criterion = self.objective.criterion
        if criterion.on == "node":
            return np.array([self._node_costs(*pair) for pair in zip(nodes, values, strict=True)])
        points = np.concatenate([nodes, values[..., None]], axis=2)[:, self._stencils]
        columns = np.moveaxis(points.reshape(-1, *points.shape[2:]), 1, 0)
        if not columns.size:
            return np.zeros((len(nodes), 0))
        return np.asarray(criterion.cost(*columns)).reshape(len(nodes), -1)

    def _node_costs(self, nodes: FloatArray, values: FloatArray) -> FloatArray:
        """Costs of the nodes of the patch, for a criterion on nodes."""
        interpolant = Interpolant(Mesh._trusted(nodes, self.elements), values)
        return np.asarray(self.objective.criterion.cost(interpolant))[np.unique(self.elements[: self.size])]

    @cached_property
    def _stencils(self) -> IntArray:
        """The nodes on which each cost depends, in the order of the arguments of the cost function."""
        if self.objective.criterion.on == "element":
            return self.elements[: self.size]
        a, b, c, d = quadrilaterals(self.mesh, self._edges(any))[0].T
        return np.column_stack([b, c, a, d])

    def _edges(self, of: Callable[..., bool]) -> IntArray:
        """Numbers of the inner edges with any, or all, of their two elements in the patch."""
        sides = self.mesh.edge_elements
        mine = (sides >= 0) & (sides < self.size)
        return np.flatnonzero((sides[:, 1] >= 0) & (mine.any(axis=1) if of is any else mine.all(axis=1)))

    # -- the two ways -----------------------------------------------------------------------

    def swapped(self) -> "Patch":
        """The patch after the local optimisation procedure on its inner edges."""
        objective = self.objective
        procedure = Procedure(
            self.mesh,
            self.values,
            objective.criterion,
            objective.norm,
            objective.limits,
            objective.tolerance,
            once=True,
        )
        done = procedure.run(self._edges(all))
        own, beyond = np.split(done.elements, [self.size])
        return replace(self, elements=np.concatenate([canonical(own), beyond])) if done.swaps else self

    def moved(self) -> "Patch":
        """The patch with its middle node at the best position found.

        A few points in each element are tried first.  From the best of them the search goes
        on in steps to the best of the positions around, halved whenever none is better.
        """
        places = SEARCH.places(self.nodes[self.elements[: self.size]])
        at, least = _best(self.nodes[self.centre], self.error, places, self.errors(places))
        step = SEARCH.first
        while step > SEARCH.last:
            places = SEARCH.around(at, step * self.extent)
            near, error = _best(at, least, places, self.errors(places))
            step = step if error < least else step / 2
            at, least = near, error
        nodes, values = self._moved(at[None])
        return replace(self, nodes=nodes[0], values=values[0])


def _best(at: FloatArray, least: float, places: FloatArray, errors: FloatArray) -> tuple[FloatArray, float]:
    """The place of least error and that error; what was given if no error is below ``least``."""
    k = errors.argmin()
    return (places[k], float(errors[k])) if errors[k] < least else (at, least)
