"""Delaunay meshes, the same on every platform (section 2.3.2)."""

import numpy as np

from .. import checks
from ..errors import InvalidInputError, InvalidMeshError
from ..geometry.predicates import incircle, nearly_flat, orientation
from ..support.independent import independent
from .mesh import Mesh
from .topology import canonical, quadrilaterals

EDGES_AT_ONCE = 16_384
NEW = (0, 3, 2), (3, 0, 1)  # (a, d, c) and (d, a, b) of a quadrilateral (a, b, c, d)


def delaunay(nodes):
    """The Delaunay mesh of a set of nodes.

    Among cocircular nodes, where several meshes are Delaunay, the diagonals from
    the node with the smallest number are taken, so that the result depends on
    nothing but the nodes.

    Parameters
    ----------
    nodes : (N, 2) array_like of float
        Distinct, not all collinear.

    Returns
    -------
    Mesh
        A conforming mesh of the convex hull of the nodes, without the slivers between
        hull and nodes that lie on it but for rounding.

    Raises
    ------
    MeshError
        Names coinciding nodes, collinear nodes, and coordinates that are not finite.

    Notes
    -----
    Qhull finds the mesh in floating point [barber1996]_; exact in-circle tests then
    swap what it decided by rounding.  The result is optimal for the max-min angle
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


def _refuse_collinear(nodes):
    far = np.abs(nodes - nodes[0]).max(axis=1).argmax()
    if not orientation(nodes[0], nodes[far], nodes).any():
        raise InvalidInputError(
            "collinear", f"all {len(nodes)} nodes lie on one line; add a node off the line"
        )


def _qhull(nodes):
    from scipy.spatial import Delaunay, QhullError

    centred = nodes - nodes.mean(axis=0)  # coordinates far from 0 cost digits
    try:
        return Delaunay(centred / np.abs(centred).max()).simplices
    except QhullError as error:
        raise _nearly_collinear() from error


def _without_flat(nodes, elements):
    """Elements that rounding laid flat or turned over, swapped away.

    Those with their longest side on the boundary are left out: there the hull is
    straight but for rounding.
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


def _longest_edges(mesh, some):
    sides = np.roll(mesh.corners[some], -1, axis=1) - np.roll(mesh.corners[some], 1, axis=1)
    return mesh.element_edges[some, (sides**2).sum(axis=2).argmax(axis=1)]


def _unfolded(mesh, edges):
    """Elements after a swap of those edges whose new elements are not flat."""
    quads, pairs = quadrilaterals(mesh, edges)
    good = ~np.any([nearly_flat(mesh.nodes[quads[:, new]]) for new in NEW], axis=0)
    if not good.any():
        raise _nearly_collinear()
    return _swapped(mesh, *_independent(quads[good], pairs[good], mesh.n_elements)).elements


def _nearly_collinear():
    return InvalidInputError(
        "collinear", "the nodes are too nearly on one line to be meshed; scale the flat direction up first"
    )


def _flipped_to_delaunay(nodes, elements):
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


def _swapped(mesh, quads, pairs):
    """The mesh with the diagonals b-c of the quadrilaterals swapped for a-d."""
    elements = mesh.elements.copy()
    for side, new in zip(pairs.T, NEW, strict=True):
        elements[side] = quads[:, new]
    return Mesh(mesh.nodes, elements)


def _worse(mesh, edges):
    """Those of the edges that are to be swapped, looked at in parts that stay in the processor's memory."""
    parts = (edges[k : k + EDGES_AT_ONCE] for k in range(0, len(edges), EDGES_AT_ONCE))
    return np.concatenate([part[_is_worse(mesh.nodes, *quadrilaterals(mesh, part)[0].T)] for part in parts])


def _is_worse(nodes, a, b, c, d):
    """Whether b-c is not Delaunay, or tied while a-d has the smallest node number."""
    side = incircle(*(nodes.take(n, axis=0) for n in (a, b, c, d)))
    tied = (side == 0) & (np.minimum(a, d) < np.minimum(b, c))
    return (side > 0) | tied


def _independent(quads, pairs, n_elements):
    """Quadrilaterals that share no element: each is the first at both its elements."""
    alike = np.zeros(len(pairs))
    free = independent(alike, np.repeat(np.arange(len(pairs)), 2), pairs.ravel(), n_elements)
    return quads[free], pairs[free]
