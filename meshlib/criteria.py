"""Criteria: a cost for each edge, element or node, and an order on cost vectors.

A criterion in the sense of section 2.2 is a cost function together with a norm.
The cost functions are kept here by name; the norm is chosen where they are used.

To write one's own, give a vectorised cost and where it lives:

>>> import numpy as np
>>> def kink(p, q, left, right):
...     "Jump of the gradient along x, for edges p-q between two elements."
...     g, h = plane_gradients(p, q, left), plane_gradients(q, p, right)
...     return np.abs(g[:, 0] - h[:, 0])
>>> _ = register(Criterion("kink", "edge", kink))
>>> "kink" in names("edge")
True
>>> unregister("kink")

Every argument of an edge cost is an (n, 3) array of points (x, y, u): the ends p, q
of n edges, and the opposite nodes of the elements to their left and right.  An
element cost gets its three nodes likewise, a node cost the `Interpolant`.  Costs
must be at least 0, and larger where the mesh is worse.
"""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import checks
from .costs import (
    angle_between_normals,
    deviations_from_linear_polynomials,
    distances_from_planes,
    element_errors,
    gradient_spread,
    jump_in_normal_derivatives,
    largest_angle,
    plane_gradients,
    smallest_angle,
)
from .errors import MeshError
from .interpolant import Interpolant
from .norms import precedes
from .topology import quadrilaterals

__all__ = ["Criterion", "costs", "get", "min_error", "names", "plane_gradients", "prefers",
           "register", "unregister"]

PLACES = ("edge", "element", "node")
ERROR_DEGREE = 6


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
        Number of the compiled form in `meshlib.kernels.lop`; none for one's own.
    geometric : bool
        Whether the cost depends on the nodes alone, so that `prefers` needs no values.

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

    def __post_init__(self):
        checks.choice(self.on, PLACES, "place")
        if not callable(self.cost):
            raise MeshError("type", f"the cost of {self.name!r} is {self.cost!r}; give a function")

    def costs(self, mesh, values):
        """The cost vector of a mesh: one cost for each edge, element or node."""
        return _EVALUATE[self.on](self.cost, Interpolant(mesh, values))

    def scale(self, mesh, values):
        """Size of a typical cost, for the absolute part of a tolerance."""
        extent = np.ptp(mesh.nodes, axis=0).max()
        return float(self.unit(extent, np.ptp(values)))


def costs(mesh, values, criterion="jnd"):
    """The cost vector H(T, u) of section 2.4.

    Parameters
    ----------
    mesh : Mesh
    values : (N,) array_like of float, or callable
    criterion : str or Criterion

    Returns
    -------
    (E,), (T,) or (N,) ndarray of float64
        One cost for each edge, element or node; 0 on boundary edges.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> mesh = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> costs(mesh, [0, 0, 1, 0], "jnd").round(6).tolist()
    [0.0, 1.414214, 0.0, 0.0, 0.0]
    """
    return get(criterion).costs(mesh, values)


def prefers(mesh_a, mesh_b, values=None, criterion="jnd", norm=2):
    """Whether the criterion prefers the first mesh to the second (section 2.2).

    Parameters
    ----------
    mesh_a, mesh_b : Mesh
    values : array_like, callable, or pair of these
        Nodal values of both meshes; a pair if their nodes differ.  Criteria that
        depend on geometry alone need none.
    criterion : str or Criterion
    norm : {1, 2, "max", "lexicographic"}

    Returns
    -------
    bool
        True if the cost vector of ``mesh_a`` comes strictly before that of ``mesh_b``.

    Examples
    --------
    >>> from meshlib import Mesh
    >>> nodes = [[0, 0], [1, 0], [2, 1], [0, 1]]
    >>> short, long = (Mesh(nodes, e) for e in ([[0, 1, 3], [1, 2, 3]], [[0, 1, 2], [0, 2, 3]]))
    >>> prefers(short, long, [0, 0, 0, 1], "jnd"), prefers(long, short, [0, 0, 0, 1], "jnd")
    (True, False)
    """
    criterion = get(criterion)
    if values is None and not criterion.geometric:
        raise MeshError("shape", f"criterion {criterion.name!r} depends on the data; give values")
    pair = values if isinstance(values, tuple) else (values, values)
    first, second = (criterion.costs(mesh, np.zeros(mesh.n_nodes) if v is None else v)
                     for mesh, v in zip((mesh_a, mesh_b), pair, strict=True))
    return precedes(first, second, norm)


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
    found = cost(*_points(u_h, u_h.mesh.elements))
    return checks.cost_vector(found, u_h.mesh.n_elements, "element")


def _on_nodes(cost, u_h):
    return checks.cost_vector(cost(u_h), u_h.mesh.n_nodes, "node")


def _points(u_h, corners):
    """Points (x, y, u) at the corners, one array for each column of these."""
    points = np.column_stack([u_h.mesh.nodes, u_h.values])
    return [points.take(column, axis=0) for column in corners.T]


_EVALUATE = {"edge": _on_edges, "element": _on_elements, "node": _on_nodes}


def min_error(function, degree=ERROR_DEGREE):
    """The min-error criterion (section 2.4.1) for a known function u.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    degree : int
        Polynomial degree of (u - u_h)^2 that the quadrature integrates exactly.

    Returns
    -------
    Criterion
        On elements; with norm 2 the norm of its cost vector is the L2 error.

    Examples
    --------
    >>> from meshlib import Interpolant, delaunay
    >>> mesh, u = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), lambda x, y: x ** 2
    >>> cost = min_error(u).costs(mesh, u)
    >>> bool(np.isclose(np.hypot(*cost), Interpolant(mesh, u).l2_error(u, rule="exact")))
    True
    """
    def cost(a, b, c):
        return element_errors(a, b, c, function, degree)
    return Criterion("min-error", "element", cost, "L2 error",
                     unit=lambda extent, height: height * extent)


# -- the registry ------------------------------------------------------------------------

_registry = {}


def register(criterion):
    """File a criterion under its name, for widgets, `swapped` and `refined`; returns it."""
    if not isinstance(criterion, Criterion):
        raise MeshError("type", f"this is a {type(criterion).__name__}; register a Criterion")
    if criterion.name in _registry:
        raise MeshError("duplicate", f"a criterion {criterion.name!r} exists; choose another name")
    _registry[criterion.name] = criterion
    return criterion


def unregister(name):
    """Take a criterion out of the registry."""
    del _registry[checks.choice(name, names(), "criterion")]


def names(on=None):
    """Names of the registered criteria, of one place (edge, element, node) or of all.

    Examples
    --------
    >>> names("edge")
    ('jnd', 'abn', 'dlp', 'dfp')
    """
    return tuple(name for name, c in _registry.items() if on in (None, c.on))


def get(criterion):
    """The criterion of that name; a Criterion is returned as it is.

    Raises
    ------
    MeshError
        If the name is not registered; it proposes the nearest one.

    Examples
    --------
    >>> get("jnd").title
    'jump in normal derivatives'
    >>> get("jmd")
    Traceback (most recent call last):
        ...
    meshlib.errors.MeshError: unknown: criterion 'jmd' is not known; did you mean 'jnd'? (known: ...)
    """
    if isinstance(criterion, Criterion):
        return criterion
    if criterion == "min-error":
        raise MeshError("unknown", "'min-error' needs the function u; pass criteria.min_error(u)")
    return _registry[checks.choice(criterion, names(), "criterion")]


for _criterion in (
    Criterion("jnd", "edge", jump_in_normal_derivatives, "jump in normal derivatives",
              lambda extent, height: height / extent, code=0),
    Criterion("abn", "edge", angle_between_normals, "angle between normals",
              lambda extent, height: min(1.0, height / extent), code=1),
    Criterion("dlp", "edge", deviations_from_linear_polynomials, "deviations from linear polynomials",
              lambda extent, height: height, code=2),
    Criterion("dfp", "edge", distances_from_planes, "distances from planes",
              lambda extent, height: min(height, extent), code=3),
    Criterion("smallest-angle", "element", smallest_angle, "smallest angle",
              lambda extent, height: 1.0, code=4, geometric=True),
    Criterion("largest-angle", "element", largest_angle, "largest angle",
              lambda extent, height: 1.0, code=5, geometric=True),
    Criterion("gradient-spread", "node", gradient_spread, "spread of the gradients in the patch",
              lambda extent, height: height / extent),
):
    register(_criterion)
