"""Red-green refinement (section 3.2.4), on numbers of edges instead of pairs of nodes."""

from typing import Any, TypeAlias

import numpy as np

from .._typing import ArrayLike, BoolArray, IntArray, NDArray
from ..mesh.mesh import Mesh
from ..mesh.topology import HEADS, TAILS, unique

# (T', 3) elements, (T',) parents, (n, 2 or 3) nodes of which each new one is the mean, (G, 2) green pairs
Split: TypeAlias = tuple[IntArray, IntArray, IntArray, IntArray | None]
RED_PARTS = 4  # parts of an element that is refined red


def red_green(mesh: Mesh, marked: IntArray) -> Split:
    r"""Bisection of all edges, hanging nodes closed (section 3.2.4, Figures 3.5 to 3.7).

    ::

              c                     c
             / \                   /|\
           ca---bc    red         / | \     green: one hanging node m
           / \ / \               /  |  \    (m, c, a), (m, b, c)
          a---ab--b             a---m---b

    First, each green pair is put together again; the whole is refined red or stays
    whole.  An element with two or three hanging nodes is refined red.
    """
    forest = Forest(mesh)
    red = forest.roots(marked)
    while len(red):
        red = forest.cut(red)
    elements, parents, green = forest.closed()
    return elements, parents, np.concatenate(forest.bisected), green


class Table:
    """Columns of numbers that grow together; their room about doubles when it is full."""

    def __init__(self, **columns: NDArray[Any]) -> None:
        self.__dict__.update(columns)
        self.size = len(next(iter(columns.values())))

    def append(self, count: int, **columns: ArrayLike) -> NDArray[np.int32]:
        """Add ``count`` rows, filled with these numbers; returns the row numbers."""
        begin, self.size = self.size, self.size + count
        for name, rows in columns.items():
            column = getattr(self, name)
            if self.size > len(column):
                column = np.concatenate([column, np.empty((self.size, *column.shape[1:]), column.dtype)])
                setattr(self, name, column)
            column[begin : self.size] = rows
        return np.arange(begin, self.size, dtype=np.int32)


class _Leaves(Table):
    nodes: IntArray
    sides: IntArray
    parent: IntArray
    gone: BoolArray


class _Edges(Table):
    ends: IntArray
    middle: IntArray
    halves: IntArray
    beside: IntArray


class Forest:
    """Elements, the parts into which they are cut repeatedly, and the edges that this bisects.

    Attributes
    ----------
    leaves : Table
        Elements, green pairs put together, and their parts: ``nodes``, ``sides``
        (the edge opposite each node), ``parent``, and whether they are ``gone``.
    edges : Table
        ``ends``, ``middle`` (a node or -1), ``halves`` (the edge from each end to the
        middle, or -1) and ``beside``, the two leaves of which the edge is a side or half
        a side.
    bisected : list of (n, 2) ndarray of int
        Ends of the edges that have been bisected, in the order of the new nodes.
    final : list of pairs of ndarray of int
        Nodes and parents of parts that are not among the leaves, since nothing cuts
        them again where there are no green pairs.
    """

    final: list[tuple[IntArray, IntArray]]

    def __init__(self, mesh: Mesh) -> None:
        numbers = np.arange(mesh.n_elements, dtype=np.int32)
        self.n_nodes, self.bisected, self.final = mesh.n_nodes, [mesh.edges[:0]], []
        self.leaves = _Leaves(
            nodes=mesh.elements,
            sides=mesh.element_edges,
            parent=numbers,
            gone=np.zeros(len(numbers), dtype=bool),
        )
        self.edges = _Edges(
            ends=mesh.edges, middle=np.full(mesh.n_edges, -1, dtype=np.int32), beside=mesh.edge_elements
        )
        self._owner, self._linked = numbers, len(mesh.green) > 0
        if self._linked:
            self._put_together(mesh, *mesh.green.T)

    def _put_together(self, mesh: Mesh, first: IntArray, second: IntArray) -> None:
        """Turn the first of each pair (m, c, a), (m, b, c) into (c, a, b), with m as the middle of a-b."""
        leaves, edges = self.leaves, self.edges
        edges.halves, edges.beside = np.full((mesh.n_edges, 2), -1, dtype=np.int32), edges.beside.copy()
        leaves.nodes, leaves.sides = leaves.nodes.copy(), leaves.sides.copy()
        self._owner = self._owner.copy()
        (m, c, a), b = mesh.elements[first].T, mesh.elements[second, 1]
        (ca, am, _), (bc, _, mb) = mesh.element_edges[first].T, mesh.element_edges[second].T
        ab = self._new_edges(np.column_stack([a, b]), -1)
        edges.middle[ab], edges.halves[ab] = m, np.column_stack([am, mb])
        _replace(edges.beside, mesh.element_edges[second], second, first)
        leaves.nodes[first], leaves.sides[first] = np.column_stack([c, a, b]), np.column_stack([ab, bc, ca])
        leaves.gone[second], self._owner[second] = True, first

    def roots(self, elements: IntArray) -> IntArray:
        """The leaves that contain these elements of the mesh."""
        return unique(self._owner[elements])

    def cut(self, red: IntArray) -> IntArray:
        """Cut leaves into four; returns the leaves that must be cut as a consequence."""
        leaves = self.leaves
        new = self._bisect(unique(leaves.sides.take(red, axis=0)))
        leaves.gone[red] = True
        parts = self._add_parts(red)
        touched = np.concatenate([self.edges.beside.take(new, axis=0).ravel(), parts])
        touched = unique(touched[touched >= 0])
        touched = touched[~leaves.gone[touched]]
        return touched[self._needs_red(leaves.sides.take(touched, axis=0))]

    def _bisect(self, numbers: IntArray) -> IntArray:
        """Bisect those edges that have no middle; returns them, in the order of their ends."""
        edges = self.edges
        new = numbers[edges.middle[numbers] < 0]
        low, high = edges.ends[new].T.astype(np.int64)
        new = new[np.argsort(low << 32 | high, kind="stable")]
        ends, middle = edges.ends[new], self.n_nodes + np.arange(len(new), dtype=np.int32)
        edges.middle[new] = middle
        self.n_nodes += len(new)
        self.bisected.append(ends)
        if self._linked:
            halves = self._new_edges(
                np.column_stack([ends.ravel(), np.repeat(middle, 2)]), np.repeat(edges.beside[new], 2, axis=0)
            )
            edges.halves[new] = halves.reshape(-1, 2)
        return new

    def _new_edges(self, ends: IntArray, beside: ArrayLike) -> NDArray[np.int32]:
        """Add edges that are not bisected; returns their numbers."""
        return self.edges.append(len(ends), ends=ends, middle=-1, halves=-1, beside=beside)

    def _add_parts(self, red: IntArray) -> IntArray:
        r"""Add four parts of each leaf; returns those that may have to be cut too.

        Part k lies at node k, with the middles m_k on the sides opposite::

                   2
                  /2\
                m1---m0
                /0\3/1\
               0---m2--1
        """
        nodes, middle = self.leaves.nodes.take(red, axis=0), self._middles(red)
        rows = _in_four(nodes, middle[:, HEADS], middle[:, TAILS], middle[:, HEADS])
        parent = np.repeat(self.leaves.parent[red], RED_PARTS)
        if not self._linked:
            self.final.append((rows, parent))
            return red[:0]
        sides = np.full(rows.shape, -1)
        parts = self.leaves.append(len(rows), nodes=rows, sides=sides, parent=parent, gone=False)
        self._link(red, nodes, middle, parts.reshape(-1, RED_PARTS))
        return parts

    def _middles(self, leaves: IntArray) -> IntArray:
        """The node in the middle of each side, or -1."""
        return self.edges.middle[self.leaves.sides.take(leaves, axis=0)]

    def _link(self, red: IntArray, nodes: IntArray, middle: IntArray, parts: IntArray) -> None:
        """Set the sides of the parts, and the parts beside each side."""
        sides, beside = self.leaves.sides[red], np.stack([parts[:, :3], parts[:, [3, 3, 3]]], axis=2)
        ends = np.stack([middle[:, TAILS], middle[:, HEADS]], axis=2)
        inner = self._new_edges(ends.reshape(-1, 2), beside.reshape(-1, 2)).reshape(-1, 3)
        left, right = self._half(sides[:, TAILS], nodes), self._half(sides[:, HEADS], nodes)
        self.leaves.sides[parts.ravel()] = _in_four(inner, left, right, inner[:, HEADS])
        _replace(self.edges.beside, np.column_stack([left, right]), red, np.tile(parts[:, :3], 2))

    def _half(self, edges: IntArray, nodes: IntArray) -> IntArray:
        """The half of each bisected edge that starts at the given one of its ends."""
        return self.edges.halves[edges, (self.edges.ends[edges, 1] == nodes).astype(np.int8)]

    def _needs_red(self, sides: IntArray) -> BoolArray:
        """Whether leaves with these sides have several hanging nodes, on different sides or on one."""
        middle = self.edges.middle
        several = (middle[sides] >= 0).sum(axis=1) > 1
        if not self._linked:
            return several
        halves = self.edges.halves[sides]
        return several | ((halves >= 0) & (middle[halves] >= 0)).any(axis=(1, 2))

    def closed(self) -> tuple[IntArray, IntArray, IntArray]:
        """Bisect leaves that have one hanging node; returns elements, parents and green pairs."""
        leaves, numbers = self.leaves, np.flatnonzero(~self.leaves.gone[: self.leaves.size])
        middle = self._middles(numbers)
        hanging = middle >= 0
        open_ = hanging[:, 0] | hanging[:, 1] | hanging[:, 2]
        whole, cut = numbers[~open_], numbers[open_]
        pairs = _bisected(leaves.nodes.take(cut, axis=0), middle.compress(open_, axis=0))
        rows = [leaves.nodes.take(whole, axis=0), *(rows for rows, _ in self.final), pairs]
        parents = [leaves.parent[whole], *(parent for _, parent in self.final), leaves.parent[cut].repeat(2)]
        elements = np.concatenate(rows)
        green = np.arange(len(elements) - len(pairs), len(elements)).reshape(-1, 2)
        return elements, np.concatenate(parents), green


def _bisected(nodes: IntArray, middle: IntArray) -> IntArray:
    """Two elements (m, c, a), (m, b, c) for each element (a, b, c), named so that a-b has the middle m."""
    row, k = np.arange(len(nodes)), (middle >= 0).argmax(axis=1)
    m, a, b, c = middle[row, k], nodes[row, np.take(TAILS, k)], nodes[row, np.take(HEADS, k)], nodes[row, k]
    return np.column_stack([m, c, a, m, b, c]).reshape(-1, 3)


def _in_four(own: IntArray, left: IntArray, right: IntArray, central: IntArray) -> IntArray:
    """Rows of the three parts at the nodes and of the one in the middle, element by element."""
    outer = np.stack([own, left, right], axis=2)
    return np.concatenate([outer, central[:, None]], axis=1).reshape(-1, 3)


def _replace(beside: IntArray, edges: IntArray, old: IntArray, new: IntArray) -> None:
    """Set new leaves beside edges in place of old ones; ``edges`` has a row for each old leaf."""
    row, column, side = np.nonzero(beside[edges] == old[:, None, None])
    beside[edges[row, column], side] = np.broadcast_to(new.reshape(len(old), -1), edges.shape)[row, column]
