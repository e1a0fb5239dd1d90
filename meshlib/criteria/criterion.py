"""What a criterion is: a cost for each edge, element or node, evaluated over a mesh."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from ..errors import InvalidInputError
from ..interpolation.interpolant import Interpolant
from ..kernels import user_costs
from ..mesh.topology import from_smallest, quadrilaterals

PLACES = ("edge", "element", "node")


@dataclass(frozen=True)
class Criterion:
    """A cost function for the edges, elements or nodes of a mesh.

    Parameters
    ----------
    name : str
        Under which `register` files it.
    on : {"edge", "element", "node"}
    cost : callable
        Vectorised, see the head of `meshlib.criteria`.
    title : str, optional
        For people to read.
    unit : callable, optional
        ``unit(extent, height)``: the size of a typical cost on data of this height
        over a domain of this extent.  Differences below 1e-11 units are taken for
        rounding noise; by default only relative differences count.
    code : int, optional
        Number of the compiled form in `meshlib.kernels.codes`; none for a user-defined cost.
    geometric : bool
        Whether the cost depends on the nodes alone, so that `prefers` needs no values.
    pointwise : callable, optional
        Hashable; returns the same cost of one edge or element as a function of numbers,
        when the procedure first needs it.  See `meshlib.criteria.pointwise`.

    Raises
    ------
    MeshError
        If ``on`` is not one of the three places, or the cost not a function.
    """

    name: str
    on: str
    cost: Callable
    title: str = ""
    unit: Callable = lambda extent, height: 0.0
    code: int = -1
    geometric: bool = False
    pointwise: Callable = None

    def __post_init__(self):
        checks.choice(self.on, PLACES, "place")
        if not callable(self.cost):
            raise InvalidInputError("type", f"the cost of {self.name!r} is {self.cost!r}; give a function")

    def costs(self, mesh, values):
        """The cost vector of a mesh: one cost for each edge, element or node."""
        return _EVALUATE[self.on](self.cost, Interpolant(mesh, values))

    @property
    def pointer(self):
        """The function that kernels call for the cost of one edge or element, if it is user-defined."""
        if self.pointwise is None:
            return None
        return user_costs.pointer(self.pointwise, self.on)

    @property
    def is_user_defined(self):
        """Whether a user wrote the cost, so that it may return what is not one."""
        return self.code < 0 or self.pointwise is not None

    @property
    def is_compiled(self):
        """Whether kernels know the cost; if not, the procedure runs on the vectorised one."""
        return self.code >= 0 and (self.pointwise is None or self.pointer is not None)

    def scale(self, mesh, values):
        """Size of a typical cost, for the absolute part of a tolerance."""
        low, high = mesh.box
        return float(self.unit((high - low).max(), np.ptp(values)))


# -- evaluation over a mesh ---------------------------------------------------------


def _on_edges(cost, u_h):
    mesh = u_h.mesh
    inner = np.flatnonzero(~mesh.boundary)
    left, p, q, right = _points(u_h, quadrilaterals(mesh, inner)[0])
    found = cost(p, q, left, right)
    vector = np.zeros(mesh.n_edges)
    vector[inner] = checks.cost_vector(found, len(inner), "inner edge")
    return vector


def _on_elements(cost, u_h):
    found = cost(*_points(u_h, from_smallest(u_h.mesh.elements)))  # so that no cost depends on swaps before
    return checks.cost_vector(found, u_h.mesh.n_elements, "element")


def _on_nodes(cost, u_h):
    return checks.cost_vector(cost(u_h), u_h.mesh.n_nodes, "node")


def _points(u_h, corners):
    """Points (x, y, u) at the corners, one array for each column of these."""
    points = np.column_stack([u_h.mesh.nodes, u_h.values])
    return [points.take(column, axis=0) for column in corners.T]


_EVALUATE = {"edge": _on_edges, "element": _on_elements, "node": _on_nodes}
