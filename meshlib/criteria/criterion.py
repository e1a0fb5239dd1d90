"""What a criterion is: a cost for each edge, element or node, evaluated over a mesh."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import ArrayLike, FloatArray, IntArray, Values
from ..errors import InvalidInputError
from ..interpolation.interpolant import Interpolant
from ..kernels import user_costs
from ..mesh.mesh import Mesh
from ..mesh.topology import from_smallest, quadrilaterals

PLACES = ("edge", "element", "node")  # what may have costs


def no_unit(extent: float, height: float) -> float:
    """Size of a typical cost that is not known: only relative differences count."""
    return 0.0


@dataclass(frozen=True)
class Criterion:
    """A cost function for the edges, elements or nodes of a mesh.

    Parameters
    ----------
    name : str
        Name in the registry, see `register`.
    on : {"edge", "element", "node"}
        Part of the mesh that has a cost.
    cost : callable
        Vectorised function of points or of an `meshlib.Interpolant`, as the docstring of
        `meshlib.criteria` describes it.
    title : str, optional
        Name in menus and legends.
    unit : callable, optional
        ``unit(extent, height)``: the size of a typical cost on data of this height
        over a domain of this extent.  Differences below 1e-11 units are taken for
        rounding noise; by default only relative differences count.
    code : int, optional
        Number of the compiled form in `meshlib.kernels.codes`; none for a user-defined cost.
    geometric : bool
        Whether the cost depends on the nodes alone, so that `prefers` needs no values.
    pointwise : callable, optional
        Hashable function without arguments, called when the procedure first needs what it
        returns: the cost of one edge or element as a function of numbers.  The function
        `meshlib.criteria.pointwise` sets it.

    Raises
    ------
    MeshError
        If ``on`` is not one of the three places, or the cost is not a function.

    See Also
    --------
    meshlib.criteria.register : Make a criterion available by its name.
    meshlib.criteria.pointwise : A criterion from the cost of a single edge or element.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> area = Criterion("area", "element", lambda a, b, c: np.abs(np.cross(b - a, c - a)[:, 2]) / 2)
    >>> area.costs(delaunay([[0, 0], [2, 0], [2, 1], [0, 1]]), [0, 0, 0, 0]).tolist()
    [1.0, 1.0]
    """

    name: str
    on: str
    cost: Callable[..., ArrayLike]
    title: str = ""
    unit: Callable[[float, float], float] = no_unit
    code: int = -1
    geometric: bool = False
    pointwise: Callable[[], Callable[..., float]] | None = None

    def __post_init__(self) -> None:
        checks.choice(self.on, PLACES, "place")
        if not callable(self.cost):
            raise InvalidInputError("type", f"the cost of {self.name!r} is {self.cost!r}; give a function")

    def costs(self, mesh: Mesh, values: Values) -> FloatArray:
        """The cost vector of a mesh, one cost for each edge, element or node; see `criteria.costs`."""
        evaluated = {"edge": _on_edges, "element": _on_elements, "node": _on_nodes}[self.on]
        return evaluated(self.cost, Interpolant(mesh, values))

    @property
    def pointer(self) -> Callable[..., float] | None:
        """The function that kernels call for the cost of one edge or element, if it is user-defined."""
        if self.pointwise is None:
            return None
        return user_costs.pointer(self.pointwise, self.on)

    @property
    def is_user_defined(self) -> bool:
        """Whether a user wrote the cost, so that it may return a negative number or NaN."""
        return self.code < 0 or self.pointwise is not None

    @property
    def is_compiled(self) -> bool:
        """Whether kernels can compute the cost; if not, the procedure calls the vectorised function."""
        return self.code >= 0 and (self.pointwise is None or self.pointer is not None)

    def scale(self, mesh: Mesh, values: FloatArray) -> float:
        """Size of a typical cost; the absolute part of a tolerance is a fraction of it."""
        low, high = mesh.box
        return float(self.unit((high - low).max(), np.ptp(values)))


# -- evaluation over a mesh ---------------------------------------------------------


def _on_edges(cost: Callable[..., ArrayLike], u_h: Interpolant) -> FloatArray:
    """Costs of all edges, 0 on the boundary."""
    mesh = u_h.mesh
    inner = np.flatnonzero(~mesh.boundary)
    left, p, q, right = _points(u_h, quadrilaterals(mesh, inner)[0])
    found = cost(p, q, left, right)
    vector = np.zeros(mesh.n_edges)
    vector[inner] = checks.cost_vector(found, len(inner), "inner edge")
    return vector


def _on_elements(cost: Callable[..., ArrayLike], u_h: Interpolant) -> FloatArray:
    """Costs of all elements, from their corners in an order that swaps made before cannot change."""
    found = cost(*_points(u_h, from_smallest(u_h.mesh.elements)))
    return checks.cost_vector(found, u_h.mesh.n_elements, "element")


def _on_nodes(cost: Callable[..., ArrayLike], u_h: Interpolant) -> FloatArray:
    return checks.cost_vector(cost(u_h), u_h.mesh.n_nodes, "node")


def _points(u_h: Interpolant, corners: IntArray) -> list[FloatArray]:
    """Points (x, y, u) at nodes: an (n, 3) array for each column of an (n, m) array of node numbers."""
    points = np.column_stack([u_h.mesh.nodes, u_h.values])
    return [points.take(column, axis=0) for column in corners.T]
