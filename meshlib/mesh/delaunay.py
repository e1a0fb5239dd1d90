"""Delaunay meshes, the same on every platform (section 2.3.2)."""

from __future__ import annotations

import numpy as np

from .. import checks
from .._typing import ArrayLike, BoolArray, FloatArray, IntArray
from ..errors import InvalidInputError, InvalidMeshError
from ..geometry.predicates import incircle, nearly_flat, orientation
from ..support.independent import independent
from .mesh import Mesh
from .topology import canonical, quadrilaterals

NEW = (
    (0, 3, 2),
    (3, 0, 1),
)  # corners of the new elements (a, d, c) and (d, a, b) in a quadrilateral (a, b, c, d)


def delaunay(nodes: ArrayLike) -> Mesh:
    """The Delaunay mesh of a set of nodes.

    Where four or more nodes lie on one circle, several meshes are Delaunay.  Of these
    the one with the diagonals from the node with the smallest number is taken, so that
    the result depends on nothing but the nodes.

    Parameters
    ----------
    nodes : (N, 2) array_like of float
        Coordinates of at least three distinct nodes, not all collinear.

    Returns
    -------
    Mesh
        A conforming mesh of the convex hull of the nodes.  Nodes that rounding has moved
        off a side of the hull, into the domain, are boundary nodes: the slivers between
        them and the side are left out.

    Raises
    ------
    MeshError
        If nodes coincide, are all collinear, are too close to others to be meshed, or have
        coordinates that are not finite.

    See Also
    --------
    Mesh, swapped

    Notes
    -----
    Qhull finds a mesh in floating point [barber1996]_; then each diagonal that fails the
    exact in-circle test is swapped.  The result is optimal for the max-min angle
    criterion [sibson1978]_.

    References
    ----------
    .. [barber1996] C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull algorithm
       for convex hulls, ACM Trans. Math. Softw. 22 (1996).
    .. [sibson1978] R. Sibson, Locally equiangular triangulations, Comput. J. 21 (1978).

    Examples
    --------
    >>> delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]).elements.tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    nodes = checks.node_array(nodes)
    checks.distinct_nodes(nodes)
    _refuse_collinear(nodes)
    elements = _flipped_to_delaunay(nodes, _without_flat(nodes, _qhull(nodes)))
    unused = checks.unnamed(elements, len(nodes))
    if unused.size:
        raise InvalidMeshError(
            "unused node",
            f"node {unused[0]} is too close to others to be meshed; remove it or move it",
            unused,
            unused.size,
        )
    return Mesh._trusted(nodes, canonical(elements))


def _refuse_collinear(nodes: FloatArray) -> None:
    """Raise a MeshError if all nodes lie on one line."""
    far = np.abs(nodes - nodes[0]).max(axis=1).argmax()
    if not orientation(nodes[0], nodes[far], nodes).any():
        raise InvalidInputError(
            "collinear", f"all {len(nodes)} nodes lie on one line; add a node off the line"
        )


def _qhull(nodes: FloatArray) -> IntArray:
    """Elements of the Delaunay mesh as Qhull finds them."""
    from scipy.spatial import Delaunay, QhullError

    centred = nodes - nodes.mean(axis=0)  # coordinates far from 0 would lose digits
    try:
        return np.asarray(Delaunay(centred / np.abs(centred).max()).simplices)
    except QhullError as error:
        raise _nearly_collinear() from error


def _without_flat(nodes: FloatArray, elements: IntArray) -> IntArray:
    """Elements without those that rounding laid flat or turned over.

    A flat element goes by a swap of its longest edge.  If this edge is on the boundary, the
    element is left out: only by rounding is the hull not straight there.
    """
    flat = nearly_flat(nodes[elements])
    while flat.any():
        mesh = Mesh(nodes, elements)
        longest = _longest_edges(mesh, flat)
        outer = mesh.edge_elements[longest[mesh.boundary[longest]], 0]
        elements = np.delete(elements, outer, axis=0) if outer.size else _unfolded(mesh, np.unique(longest))
        if not len(elements):
            raise _nearly_collinear()
        flat = nearly_flat(nodes[elements])
    return elements


def _longest_edges(mesh: Mesh, some: BoolArray) -> IntArray:
    """Number of the longest edge of each of some elements."""
    sides = np.roll(mesh.corners[some], -1, axis=1) - np.roll(mesh.corners[some], 1, axis=1)
    return mesh.element_edges[some, (sides**2).sum(axis=2).argmax(axis=1)]


def _unfolded(mesh: Mesh, edges: IntArray) -> IntArray:
    """Elements after a swap of the edges whose new elements are not flat."""
    quads, pairs = quadrilaterals(mesh, edges)
    good = ~np.any([nearly_flat(mesh.nodes[quads[:, new]]) for new in NEW], axis=0)
    if not good.any():
        raise _nearly_collinear()
    return _swapped(mesh, *_independent(quads[good], pairs[good], mesh.n_elements)).elements


def _nearly_collinear() -> InvalidInputError:
    return InvalidInputError(
        "collinear", "the nodes are too nearly on one line to be meshed; scale the flat direction up first"
    )


def _flipped_to_delaunay(nodes: FloatArray, elements: IntArray) -> IntArray:
    r"""Swap every diagonal that is not Delaunay, many at once, until none is left.

    ::

            c                 c
           /|\               / \
          / | \             / t \
         a t|s d    --->   a-----d      t = (a, b, c) -> (a, d, c)
          \ | /             \ s /       s = (d, c, b) -> (d, a, b)
           \|/               \ /
            b                 b
    """
    mesh = Mesh(nodes, elements)
    edges = np.flatnonzero(~mesh.boundary)
    while edges.size:
        wrong = _worse(mesh, edges)
        if not wrong.size:
            break
        quads, pairs = _independent(*quadrilaterals(mesh, wrong), mesh.n_elements)
        mesh = _swapped(mesh, quads, pairs)
        changed = np.zeros(mesh.n_elements, dtype=bool)
        changed[pairs] = True
        edges = np.flatnonzero(~mesh.boundary & changed[mesh.edge_elements].any(axis=1))
    return mesh.elements


def _swapped(mesh: Mesh, quads: IntArray, pairs: IntArray) -> Mesh:
    """The mesh with the diagonals b-c of the quadrilaterals swapped for a-d."""
    elements = mesh.elements.copy()
    for side, new in zip(pairs.T, NEW, strict=True):
        elements[side] = quads[:, new]
    return Mesh(mesh.nodes, elements)


def _worse(mesh: Mesh, edges: IntArray, at_once: int = 16_384) -> IntArray:
    """Edges to be swapped; ``at_once`` are tested together, since their nodes fit a processor's memory."""
    parts = (edges[k : k + at_once] for k in range(0, len(edges), at_once))
    return np.concatenate([part[_is_worse(mesh.nodes, *quadrilaterals(mesh, part)[0].T)] for part in parts])


def _is_worse(nodes: FloatArray, a: IntArray, b: IntArray, c: IntArray, d: IntArray) -> BoolArray:
    """Whether b-c is not Delaunay, or both diagonals are and a-d has the smallest node number."""
    side = incircle(*(nodes.take(n, axis=0) for n in (a, b, c, d)))
    tied = (side == 0) & (np.minimum(a, d) < np.minimum(b, c))
    return np.asarray((side > 0) | tied)


def _independent(quads: IntArray, pairs: IntArray, n_elements: int) -> tuple[IntArray, IntArray]:
    """Quadrilaterals that share no element, and their pairs of elements; of two that share one, the first."""
    alike = np.zeros(len(pairs))
    free = independent(alike, np.repeat(np.arange(len(pairs)), 2), pairs.ravel(), n_elements)
    return quads[free], pairs[free]
