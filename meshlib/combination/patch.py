r"""The patch of elements around a node, its indicator of the error, and the two ways to change it.

::

          q---r                 The elements around p are the patch: its inner edges are
         / \ / \                the spokes p-q, p-r, ..., its rim is q-r, ...  The elements
        o---p---s               beyond the rim do not change, but costs of edges on the rim
         \ / \ /                depend on them.
          n---m
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..interpolation.interpolant import Interpolant
from ..mesh.mesh import Mesh
from ..mesh.quality import angles
from ..mesh.topology import canonical, quadrilaterals
from ..swapping.procedure import Limits, Procedure

FLAT = 1e-9  # radians, about: an element is refused if its smallest angle is below
COMPASS = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]) / 1.0
SAMPLES = np.array([(1, 1, 1), (4, 1, 1), (1, 4, 1), (1, 1, 4)])  # in each element, barycentric
FIRST_STEP, LAST_STEP = 0.25, 1e-4  # of the search for a position, relative to the extent of the patch
SHARING = {"edge": 2, "element": 3, "node": 1}  # nodes that an element has in common with a patch it affects


@dataclass(frozen=True)
class Objective:
    """What is to be made small: the sum of costs, or of their squares.

    Attributes
    ----------
    function : callable
        Vectorised u(x, y).
    criterion : Criterion
    norm : {1, 2}
    tolerance : tuple of float
        Relative and absolute part of the gain that a swap must exceed.
    limits : Limits
    rim : bool
        Whether what lies on the rim of a patch counts.
    """

    function: object
    criterion: object
    norm: int
    tolerance: tuple
    limits: Limits
    rim: bool

    def of(self, mesh):
        """The indicator of a whole mesh."""
        same = Mesh._trusted(mesh.nodes, canonical(mesh.elements))  # as in patches: costs round alike
        return float((self.criterion.costs(same, self.function(*mesh.nodes.T)) ** self.norm).sum())

    def patch(self, nodes, elements, values, centre):
        """The patch of a node of a mesh, given by its arrays."""
        inner = (elements == centre).any(axis=1)
        own = canonical(elements[inner])
        beyond = self._affected(elements, own, inner, len(nodes)) if self.rim else own[:0]
        used, rows = np.unique(np.concatenate([own, beyond]), return_inverse=True)
        return Patch(
            self,
            used,
            np.searchsorted(used, centre),
            len(own),
            np.flatnonzero(inner),
            nodes[used],
            values[used],
            rows.reshape(-1, 3),
        )

    def _affected(self, elements, own, inner, n_nodes):
        """The elements beyond the rim on which the costs of the patch depend."""
        here = np.zeros(n_nodes, dtype=bool)
        here[own] = True
        return canonical(elements[~inner & (here[elements].sum(axis=1) >= SHARING[self.criterion.on])])


@dataclass(frozen=True)
class Patch:
    """A patch with what lies around it, as a small mesh with numbers of its own.

    Attributes
    ----------
    objective : Objective
    used : (n,) ndarray of int
        Numbers of its nodes in the large mesh, in ascending order.
    centre, size : int
        The node in the middle, and the number of elements of the patch: the first ones.
    rows : (size,) ndarray of int
        Where these are in the large mesh.
    nodes, values, elements : (n, 2), (n,) and (m, 3) ndarray
    """

    objective: Objective
    used: np.ndarray
    centre: int
    size: int
    rows: np.ndarray
    nodes: np.ndarray
    values: np.ndarray
    elements: np.ndarray

    @property
    def own(self):
        """(size, 3): the elements of the patch, in the numbers of the large mesh."""
        return self.used[self.elements[: self.size]]

    @cached_property
    def mesh(self):
        """The patch as a mesh of its own nodes."""
        return Mesh._trusted(self.nodes, self.elements)

    @cached_property
    def error(self):
        """The indicator of the patch as it is, however flat its elements."""
        return float(self._sums(self.nodes[[self.centre]])[0])

    @cached_property
    def extent(self):
        """Largest distance of two nodes of the patch along x or y."""
        return np.ptp(self.nodes[self.elements[: self.size]].reshape(-1, 2), axis=0).max()

    # -- the indicator with the node in the middle at other positions ---------------------

    def errors(self, positions):
        """The indicator for each position, (m, 2); infinity where the mesh would tangle."""
        positions = np.asarray(positions, dtype=float)
        found, fits = np.full(len(positions), np.inf), self._fits(positions)
        if fits.any():
            found[fits] = self._sums(positions[fits])
        return found

    def _sums(self, positions):
        """The indicator for each position, whatever becomes of the mesh."""
        return (self._costs(*self._moved(positions)) ** self.objective.norm).sum(axis=1)

    def _moved(self, positions):
        """Nodes (m, n, 2) and values (m, n) with the centre at each of m positions."""
        nodes, values = (np.tile(a, (len(positions),) + (1,) * a.ndim) for a in (self.nodes, self.values))
        nodes[:, self.centre] = positions
        values[:, self.centre] = self.objective.function(*positions.T)
        return nodes, values

    def _fits(self, positions):
        """Where no element is turned over, flat, or sharper than the limit."""
        nodes = np.tile(self.nodes, (len(positions), 1, 1))
        nodes[:, self.centre] = positions
        corners = nodes[:, self.elements[: self.size]]
        u, v = corners[:, :, 1] - corners[:, :, 0], corners[:, :, 2] - corners[:, :, 0]
        upright = (u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0] > 0).all(axis=1)
        smallest = angles(corners.reshape(-1, 3, 2)).reshape(len(positions), -1).min(axis=1)
        return upright & (smallest >= max(FLAT, self.objective.limits.angle))

    def _costs(self, nodes, values):
        """All costs that count, a row for each of m positions."""
        criterion = self.objective.criterion
        if criterion.on == "node":
            return np.array([self._node_costs(*pair) for pair in zip(nodes, values, strict=True)])
        points = np.concatenate([nodes, values[..., None]], axis=2)[:, self._stencils]
        columns = np.moveaxis(points.reshape(-1, *points.shape[2:]), 1, 0)
        if not columns.size:
            return np.zeros((len(nodes), 0))
        return criterion.cost(*columns).reshape(len(nodes), -1)

    def _node_costs(self, nodes, values):
        cost = self.objective.criterion.cost(Interpolant(Mesh._trusted(nodes, self.elements), values))
        return cost[np.unique(self.elements[: self.size])]

    @cached_property
    def _stencils(self):
        """Nodes that each cost depends on, in the order in which a cost function wants them."""
        if self.objective.criterion.on == "element":
            return self.elements[: self.size]
        a, b, c, d = quadrilaterals(self.mesh, self._edges(any))[0].T
        return np.column_stack([b, c, a, d])

    def _edges(self, of):
        """Inner edges with any, or all, of their two elements in the patch."""
        sides = self.mesh.edge_elements
        mine = (sides >= 0) & (sides < self.size)
        return np.flatnonzero((sides[:, 1] >= 0) & (mine.any(axis=1) if of is any else mine.all(axis=1)))

    # -- the two ways -----------------------------------------------------------------------

    def swapped(self):
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

    def moved(self):
        """The patch with its middle node at the best position found.

        A few points in each element are tried first; from the best of them, compass
        steps lead downhill, halved where none does.
        """
        places = np.einsum(
            "sk,tkc->tsc",
            SAMPLES / SAMPLES.sum(axis=1, keepdims=True),
            self.nodes[self.elements[: self.size]],
        ).reshape(-1, 2)
        at, least = _best(self.nodes[self.centre], self.error, places, self.errors(places))
        step = FIRST_STEP
        while step > LAST_STEP:
            places = at + step * self.extent * COMPASS
            near, error = _best(at, least, places, self.errors(places))
            step = step if error < least else step / 2
            at, least = near, error
        nodes, values = self._moved(at[None])
        return replace(self, nodes=nodes[0], values=values[0])


def _best(at, least, places, errors):
    """The place with the least error, if that is below what there is."""
    k = errors.argmin()
    return (places[k], errors[k]) if errors[k] < least else (at, least)
