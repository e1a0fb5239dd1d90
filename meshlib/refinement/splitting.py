"""Splits of marked elements into smaller ones (sections 3.2.4 to 3.2.6)."""

from collections.abc import Callable

import numpy as np

from .._typing import BoolArray, IntArray
from ..mesh.mesh import Mesh
from ..mesh.topology import HEADS, TAILS, unique
from .redgreen import Split, red_green


def centroid(mesh: Mesh, marked: IntArray) -> Split:
    r"""Midpoint node insertion (section 3.2.5).

    ::

            c
           /|\
          / g \          (a, b, c) -> (a, b, g), (b, c, g), (c, a, g)
         / / \ \
        a-------b

    Returns, like the other splits, the elements in any order, their parents, the nodes
    of which each new node is the mean, and the green pairs, or None if it makes none.
    """
    corners = mesh.elements[marked]
    a, b, c = corners.T
    g = mesh.n_nodes + np.arange(len(marked), dtype=np.int32)
    children = np.column_stack([a, b, g, b, c, g, c, a, g]).reshape(-1, 3)
    whole = np.ones(mesh.n_elements, dtype=bool)
    whole[marked] = False
    elements = np.concatenate([mesh.elements.compress(whole, axis=0), children])
    return elements, np.concatenate([np.flatnonzero(whole), np.repeat(marked, 3)]), corners, None


def longest_edge(mesh: Mesh, marked: IntArray) -> Split:
    r"""Bisection of the longest edge (section 3.2.6), with Rivara's closure.

    An element of which any edge is bisected is first cut at its longest edge a-b::

            c                     c                c
           / \                   /|\              /|\
          /   \       --->      / | \     or     n | \      (n bisects c-a too)
         /     \               /  |  \          / \|  \
        a-------b             a---m---b        a---m---b
    """
    longest = _longest(mesh)
    split = _closed_under_longest(mesh, longest, marked)
    middle = np.full(mesh.n_edges, -1, dtype=np.int32)
    middle[split] = mesh.n_nodes + np.arange(np.count_nonzero(split))
    cut = split[_edge_opposite(mesh, longest)]
    halves, beyond = _halves(mesh, np.flatnonzero(cut), longest[cut], middle)
    parents = np.tile(np.flatnonzero(cut), 2)
    pieces, origin = _cut_again(halves, parents, beyond)
    elements = np.concatenate([mesh.elements.compress(~cut, axis=0), pieces])
    return elements, np.concatenate([np.flatnonzero(~cut), origin]), mesh.edges.compress(split, axis=0), None


SPLITS: dict[str, Callable[[Mesh, IntArray], Split]] = {
    "red-green": red_green,
    "centroid": centroid,
    "longest-edge": longest_edge,
}


def _longest(mesh: Mesh, rounding: float = 1e-12) -> IntArray:
    """Column of the node opposite the longest edge of each element; of equal edges, the least number.

    Squared lengths are equal if they differ by no more than ``rounding`` times the longest.
    """
    p, q = mesh.edges.T
    dx, dy = (v.take(q) - v.take(p) for v in np.ascontiguousarray(mesh.nodes.T))
    squared = dx**2 + dy**2
    first, second, third = (squared[column] for column in mesh.element_edges.T)
    least = np.maximum(np.maximum(first, second), third) * (1 - rounding)
    ranks = [
        np.where(long >= least, column, mesh.n_edges)
        for long, column in zip((first, second, third), mesh.element_edges.T, strict=True)
    ]
    return np.where(ranks[0] < np.minimum(ranks[1], ranks[2]), 0, np.where(ranks[1] < ranks[2], 1, 2))


def _edge_opposite(mesh: Mesh, k: IntArray, elements: IntArray | slice = slice(None)) -> IntArray:
    """The edge opposite node k of each element, with one k for each element of the mesh."""
    return np.take_along_axis(mesh.element_edges[elements], k[elements, None], axis=1)[:, 0]


def _closed_under_longest(mesh: Mesh, longest: IntArray, marked: IntArray) -> BoolArray:
    """Mask of the edges to bisect, among them the longest of every element that has one of them."""
    split = np.zeros(mesh.n_edges, dtype=bool)
    elements = marked
    while len(elements):
        edges = _edge_opposite(mesh, longest, elements)
        edges = unique(edges[~split[edges]])
        split[edges] = True
        elements = mesh.edge_elements.take(edges, axis=0).ravel()
        elements = elements[elements >= 0]
    return split


def _halves(mesh: Mesh, elements: IntArray, k: IntArray, middle: IntArray) -> tuple[IntArray, IntArray]:
    """Elements (c, a, m), then (b, c, m), and the middles of c-a, then b-c, or -1."""
    nodes, middles = mesh.elements.take(elements, axis=0), middle[mesh.element_edges.take(elements, axis=0)]
    row, after, before = np.arange(len(elements)), np.take(TAILS, k), np.take(HEADS, k)
    a, b, c, m = nodes[row, after], nodes[row, before], nodes[row, k], middles[row, k]
    halves = np.concatenate([np.column_stack([c, a, m]), np.column_stack([b, c, m])])
    return halves, np.concatenate([middles[row, before], middles[row, after]])


def _cut_again(halves: IntArray, parents: IntArray, n: IntArray) -> tuple[IntArray, IntArray]:
    """Elements (p, q, m) cut from m to the middle n of p-q where that is bisected."""
    cut = n >= 0
    (p, q, m), n = halves[cut].T, n[cut]
    pieces = [halves[~cut], np.column_stack([n, q, m]), np.column_stack([p, n, m])]
    return np.concatenate(pieces), np.concatenate([parents[~cut], parents[cut], parents[cut]])
