"""Criteria by name."""

import numpy as np

from .. import checks
from .._typing import FloatArray, Norm, Values
from ..errors import InvalidInputError, UnknownNameError
from ..kernels import codes
from ..mesh.mesh import Mesh
from .cost_functions import (
    angle_between_normals,
    deviations_from_linear_polynomials,
    distances_from_planes,
    gradient_spread,
    jump_in_normal_derivatives,
    largest_angle,
    plane_gradients,
    smallest_angle,
)
from .criterion import Criterion
from .from_functions import min_error, pointwise
from .norms import precedes

__all__ = [
    "Criterion",
    "costs",
    "get",
    "min_error",
    "names",
    "plane_gradients",
    "pointwise",
    "prefers",
    "register",
    "unregister",
]


def costs(mesh: Mesh, values: Values, criterion: str | Criterion = "jnd") -> FloatArray:
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


def prefers(
    mesh_a: Mesh,
    mesh_b: Mesh,
    values: Values | tuple[Values, Values] | None = None,
    criterion: str | Criterion = "jnd",
    *,
    norm: Norm = "L2",
) -> bool:
    """Whether the criterion prefers the first mesh to the second (section 2.2).

    Parameters
    ----------
    mesh_a, mesh_b : Mesh
    values : array_like, callable, or pair of these
        Nodal values of both meshes; a pair if their nodes differ.  Criteria that
        depend on geometry alone need none.
    criterion : str or Criterion
    norm : {"L1", "L2", "max", "lexicographic"}
        1, 2 and infinity are other names of the first three.

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
        raise InvalidInputError("shape", f"criterion {criterion.name!r} depends on the data; give values")
    pair = values if isinstance(values, tuple) else (values, values)
    first, second = (
        criterion.costs(mesh, np.zeros(mesh.n_nodes) if v is None else v)
        for mesh, v in zip((mesh_a, mesh_b), pair, strict=True)
    )
    return precedes(first, second, norm)


# -- the registry ------------------------------------------------------------------------

_registry: dict[str, Criterion] = {}


def register(criterion: Criterion) -> Criterion:
    """File a criterion under its name, for widgets, `swapped` and `refined`; returns it."""
    if not isinstance(criterion, Criterion):
        raise InvalidInputError("type", f"this is a {type(criterion).__name__}; register a Criterion")
    if criterion.name in _registry:
        raise InvalidInputError("duplicate", f"a criterion {criterion.name!r} exists; choose another name")
    _registry[criterion.name] = criterion
    return criterion


def unregister(name: str) -> None:
    """Take a criterion out of the registry."""
    del _registry[checks.choice(name, names(), "criterion")]


def names(on: str | None = None) -> tuple[str, ...]:
    """Names of the registered criteria, of one place (edge, element, node) or of all.

    Examples
    --------
    >>> names("edge")
    ('jnd', 'abn', 'dlp', 'dfp')
    """
    return tuple(name for name, c in _registry.items() if on in (None, c.on))


def get(criterion: str | Criterion) -> Criterion:
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
    meshlib.errors.UnknownNameError: unknown: criterion 'jmd' is not known; did you mean 'jnd'? (known: ...)
    """
    if isinstance(criterion, Criterion):
        return criterion
    if criterion == "min-error" and criterion not in _registry:
        raise UnknownNameError("unknown", "'min-error' needs the function u; pass criteria.min_error(u)")
    return _registry[checks.choice(criterion, names(), "criterion")]


for _criterion in (
    Criterion(
        "jnd",
        "edge",
        jump_in_normal_derivatives,
        "jump in normal derivatives",
        lambda extent, height: height / extent,
        code=codes.JND,
    ),
    Criterion(
        "abn",
        "edge",
        angle_between_normals,
        "angle between normals",
        lambda extent, height: min(1.0, height / extent),
        code=codes.ABN,
    ),
    Criterion(
        "dlp",
        "edge",
        deviations_from_linear_polynomials,
        "deviations from linear polynomials",
        lambda extent, height: height,
        code=codes.DLP,
    ),
    Criterion(
        "dfp",
        "edge",
        distances_from_planes,
        "distances from planes",
        lambda extent, height: min(height, extent),
        code=codes.DFP,
    ),
    Criterion(
        "smallest-angle",
        "element",
        smallest_angle,
        "smallest angle",
        lambda extent, height: 1.0,
        code=codes.SMALLEST_ANGLE,
        geometric=True,
    ),
    Criterion(
        "largest-angle",
        "element",
        largest_angle,
        "largest angle",
        lambda extent, height: 1.0,
        code=codes.LARGEST_ANGLE,
        geometric=True,
    ),
    Criterion(
        "gradient-spread",
        "node",
        gradient_spread,
        "spread of the gradients in the patch",
        lambda extent, height: height / extent,
    ),
):
    register(_criterion)
