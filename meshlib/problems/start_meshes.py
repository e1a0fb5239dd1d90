"""Node sets and start meshes by name (sections 4.1 and 4.3)."""

from functools import cache
from importlib.resources import files

import numpy as np

from .. import checks
from .._typing import FloatArray, IntArray
from ..mesh.delaunay import delaunay
from ..mesh.mesh import Mesh
from .analytic_functions import TestFunction, functions

__all__ = ["DD1", "SR1", "SR2", "SR3", "TestFunction", "functions", "mesh", "names", "nodes", "order"]

SQUARE_NODES = [[0, 0], [1, 0], [1, 1], [0, 1]]
SQUARE_EDGES = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]]
SQUARE_ELEMENTS = [[0, 1, 2], [0, 2, 3]]
REFINEMENTS_TO_81 = 3

SR1, SR2, SR3, DD1 = (functions[name] for name in ("SR1", "SR2", "SR3", "DD1"))

NAMES = ("33", "33-refined", "81", "33-franke")


def names() -> tuple[str, ...]:
    """Names of the node sets and start meshes.

    Examples
    --------
    >>> names()
    ('33', '33-refined', '81', '33-franke')
    """
    return NAMES


def nodes(name: str) -> FloatArray:
    """A node set by name.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}

    Returns
    -------
    (N, 2) ndarray of float64

    Raises
    ------
    MeshError
        If there is no node set of that name.

    Examples
    --------
    >>> nodes("33")[:2].tolist()
    [[1.0, 1.0], [1.0, 0.0]]
    """
    return _arrays(checks.choice(name, NAMES, "node set"))[0]


@cache
def mesh(name: str) -> Mesh:
    """The start mesh on a node set.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}

    Returns
    -------
    Mesh
        Delaunay.  On the nodes of Appendix A six quadrilaterals are cocircular, so
        that 64 meshes are Delaunay; the stored one is that of the thesis, as its
        printed numbers show.

    Examples
    --------
    >>> mesh("33").counts, mesh("81").counts
    ((33, 88, 56), (81, 208, 128))
    """
    found, _, elements = _arrays(checks.choice(name, NAMES, "node set"))
    return Mesh(found, elements).validate()


def order(name: str) -> IntArray:
    """The order in which `swapped` inspects the edges of a start mesh.

    Parameters
    ----------
    name : {"33", "33-refined", "81", "33-franke"}

    Returns
    -------
    (E,) ndarray of int64
        For ``"81"`` and ``"33-refined"`` the order in which the edges came about by
        refinement, for ``"33"`` element by element: natural orders that reproduce what
        the thesis prints, which need not be its own.  For ``"33-franke"`` the order of
        ``Mesh.edges``.

    Examples
    --------
    >>> mesh("81").edges[order("81")[:2]].tolist()
    [[0, 25], [9, 25]]
    """
    edges = _arrays(checks.choice(name, NAMES, "node set"))[1]
    return mesh(name).edge_numbers(edges)


@cache
def _arrays(name):
    """Nodes, edges and elements, in the order in which they came about."""
    return {"33": _stored, "33-refined": _stored_refined, "81": _lattice, "33-franke": _franke}[name]()


def _lattice():
    arrays = (np.array(SQUARE_NODES, dtype=float), np.array(SQUARE_EDGES), np.array(SQUARE_ELEMENTS))
    for _ in range(REFINEMENTS_TO_81):
        arrays = split_in_four(*arrays)
    return arrays


def _stored():
    nodes, elements = _table("nodes33.csv", float)[:, 1:], _table("elements33.csv", int) - 1
    return nodes, edges_by_element(elements), elements


def edges_by_element(elements):
    """The edges (a, b), (b, c), (c, a) of one element (a, b, c) after the other, each once.

    Examples
    --------
    >>> edges_by_element(np.array([[0, 1, 2], [0, 2, 3]])).tolist()
    [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]]
    """
    sides = np.stack([elements, np.roll(elements, -1, axis=1)], axis=2).reshape(-1, 2)
    _, first = np.unique(np.sort(sides, axis=1), axis=0, return_index=True)
    return sides[np.sort(first)]


def _stored_refined():
    nodes, _, elements = _stored()
    return split_in_four(nodes, Mesh(nodes, elements).edges, elements)


def _franke():
    start = delaunay(_table("nodes33-franke.csv", float)[:, 1:])
    return start.nodes, start.edges, start.elements


def _table(file, dtype):
    with (files("meshlib") / "data" / file).open() as lines:
        return np.loadtxt(lines, delimiter=",", comments="#", dtype=dtype)


def split_in_four(nodes, edges, elements):
    r"""Bisect every edge of a mesh given by the arrays of section 4.4, keeping their order.

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
    nodes : (N + E, 2) ndarray, edges : (2 E + 3 T, 2) ndarray, elements : (4 T, 3) ndarray

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
    return np.vstack([nodes, nodes[edges].mean(axis=1)]), np.vstack([halves, inner]), children
