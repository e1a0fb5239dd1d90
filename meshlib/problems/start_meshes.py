"""Node sets and start meshes by name (sections 4.1 and 4.3)."""

from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

from .. import checks
from .._typing import FloatArray, IntArray, NDArray
from ..mesh.delaunay import delaunay
from ..mesh.mesh import Mesh
from .analytic_functions import functions


class Arrays(NamedTuple):
    """A mesh as the arrays of section 4.4, whose rows are in the order in which they came about."""

    nodes: FloatArray  # (N, 2)
    edges: IntArray  # (E, 2)
    elements: IntArray  # (T, 3)


SQUARE = Arrays(
    nodes=np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]),
    edges=np.array([(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)]),
    elements=np.array([(0, 1, 2), (0, 2, 3)]),
)

SR1, SR2, SR3, DD1 = (functions[name] for name in ("SR1", "SR2", "SR3", "DD1"))


def names() -> tuple[str, ...]:
    """Names of the node sets and start meshes.

    Returns
    -------
    tuple of str
        What `nodes`, `mesh` and `order` take.

    See Also
    --------
    meshlib.problems : what each of them is.

    Examples
    --------
    >>> names()
    ('33', '33-refined', '81', '33-franke')
    """
    return ("33", "33-refined", "81", "33-franke")


def nodes(name: str) -> FloatArray:
    """A node set by name.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}
        See `meshlib.problems` for what each of them is.

    Returns
    -------
    (N, 2) ndarray of float64
        Coordinates x and y of the nodes.

    Raises
    ------
    MeshError
        If there is no node set of that name.

    See Also
    --------
    mesh : the start mesh on these nodes.

    Examples
    --------
    >>> nodes("33")[:2].tolist()
    [[1.0, 1.0], [1.0, 0.0]]
    """
    return _arrays(checks.choice(name, names(), "node set"))[0]


@cache
def mesh(name: str) -> Mesh:
    """The start mesh on a node set.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}
        See `meshlib.problems` for what each of them is.

    Returns
    -------
    Mesh
        A Delaunay mesh, but for ``"33-refined"`` that of ``"33"`` with every element split
        in four.  On the nodes of Appendix A six quadrilaterals are cocircular, so that 64
        meshes are Delaunay; the stored one is that of the thesis, as its printed numbers show.

    Raises
    ------
    MeshError
        If there is no node set of that name.

    See Also
    --------
    nodes : the coordinates alone.
    order : an order of the edges for `swapped`.

    Examples
    --------
    >>> mesh("33").counts, mesh("81").counts
    ((33, 88, 56), (81, 208, 128))
    """
    found, _, elements = _arrays(checks.choice(name, names(), "node set"))
    return Mesh(found, elements).validate()


def order(name: str) -> IntArray:
    """An order of the edges of a start mesh, with which `swapped` reproduces the thesis.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}
        See `meshlib.problems` for what each of them is.

    Returns
    -------
    (E,) ndarray of int64
        Every edge number once.  For ``"81"`` and ``"33-refined"`` in the order in which
        refinement made the edges, for ``"33"`` element by element: natural orders that
        reproduce the numbers printed in the thesis, which does not tell its orders.  For
        ``"33-franke"`` in the order of ``Mesh.edges``.

    Raises
    ------
    MeshError
        If there is no node set of that name.

    See Also
    --------
    meshlib.swapped : takes such an order.

    Examples
    --------
    >>> mesh("81").edges[order("81")[:2]].tolist()
    [[0, 25], [9, 25]]
    """
    edges = _arrays(checks.choice(name, names(), "node set"))[1]
    return mesh(name).edge_numbers(edges)


@cache
def _arrays(name: str) -> Arrays:
    """Nodes, edges and elements of a start mesh."""
    return {"33": _stored, "33-refined": _stored_refined, "81": _lattice, "33-franke": _franke}[name]()


def _lattice(refinements: int = 3) -> Arrays:
    """A lattice of (2^refinements + 1)^2 nodes, from the square."""
    arrays = SQUARE
    for _ in range(refinements):
        arrays = split_in_four(*arrays)
    return arrays


def _stored() -> Arrays:
    """The start mesh of Appendix A, whose files count elements from 1."""
    nodes, elements = _table("nodes33.csv", float)[:, 1:], _table("elements33.csv", int) - 1
    return Arrays(nodes, edges_by_element(elements), elements)


def edges_by_element(elements: IntArray) -> IntArray:
    """The edges (a, b), (b, c), (c, a) of one element (a, b, c) after the other, each once.

    Parameters
    ----------
    elements : (T, 3) ndarray of int

    Returns
    -------
    (E, 2) ndarray of int

    Examples
    --------
    >>> edges_by_element(np.array([[0, 1, 2], [0, 2, 3]])).tolist()
    [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]
    """
    sides = np.stack([elements, np.roll(elements, -1, axis=1)], axis=2).reshape(-1, 2)
    _, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    return sides[np.sort(first)]


def _stored_refined() -> Arrays:
    """The start mesh of Appendix A with every element split in four."""
    nodes, _, elements = _stored()
    return split_in_four(nodes, Mesh(nodes, elements).edges, elements)


def _franke() -> Arrays:
    """The Delaunay mesh of the 33 nodes as Franke published them."""
    start = delaunay(_table("nodes33-franke.csv", float)[:, 1:])
    return Arrays(start.nodes, start.edges, start.elements)


def _table(file: str, dtype: type) -> NDArray[Any]:
    """The numbers of a file in `meshlib/data`."""
    with (files("meshlib") / "data" / file).open() as lines:
        return np.loadtxt(lines, delimiter=",", comments="#", dtype=dtype)


def split_in_four(nodes: FloatArray, edges: IntArray, elements: IntArray) -> Arrays:
    r"""The arrays of a mesh after every edge was bisected, in the order of the old ones.

    ::

              c                Edge e = (a, b) becomes (a, m), (m, b), m = N + e;
             / \               element (a, b, c) becomes (a, ab, ca), (b, bc, ab),
           ca---bc             (c, ca, bc), (ab, bc, ca) and adds the edges
           / \ / \             (ab, ca), (ab, bc), (bc, ca).
          a---ab--b

    Parameters
    ----------
    nodes : (N, 2) ndarray of float
    edges : (E, 2) ndarray of int
    elements : (T, 3) ndarray of int

    Returns
    -------
    Arrays
        N + E nodes, 2 E + 3 T edges and 4 T elements.

    Examples
    --------
    >>> [len(a) for a in split_in_four(*_arrays("33"))]
    [121, 344, 224]
    """
    middle = len(nodes) + np.arange(len(edges))
    number = {frozenset(edge): m for edge, m in zip(edges.tolist(), middle.tolist(), strict=True)}
    a, b, c = elements.T
    ab, bc, ca = (
        [number[frozenset(pair)] for pair in np.column_stack(ends).tolist()]
        for ends in ((a, b), (b, c), (c, a))
    )
    halves = np.stack([edges[:, 0], middle, middle, edges[:, 1]], axis=1).reshape(-1, 2)
    inner = np.stack([ab, ca, ab, bc, bc, ca], axis=1).reshape(-1, 2)
    children = np.stack([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca], axis=1).reshape(-1, 3)
    return Arrays(np.vstack([nodes, nodes[edges].mean(axis=1)]), np.vstack([halves, inner]), children)
