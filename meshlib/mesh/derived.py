"""What follows from the nodes and elements of a mesh: counts, edges, neighbours, areas."""

from collections.abc import Callable
from functools import cached_property, wraps
from typing import Any, TypeVar

import numpy as np

from .._typing import BoolArray, FloatArray, IntArray
from . import topology, validation

ArrayT = TypeVar("ArrayT")  # an array, or a tuple of arrays


def _derived(method: Callable[[Any], ArrayT]) -> cached_property[ArrayT]:
    """A property computed once, whose arrays are read-only."""

    @wraps(method)
    def computed(self: Any) -> ArrayT:
        found = method(self)
        arrays: tuple[Any, ...] = found if isinstance(found, tuple) else (found,)
        for array in arrays:
            array.flags.writeable = False
        return found

    return cached_property(computed)


class Derived:
    """Properties that are derived from the arrays of a mesh when they are first asked for."""

    nodes: FloatArray
    elements: IntArray
    green: IntArray

    @_derived
    def _canonical_elements(self) -> IntArray:
        return topology.canonical(self.elements)

    @property
    def n_nodes(self) -> int:
        """Number N of nodes."""
        return len(self.nodes)

    @property
    def n_edges(self) -> int:
        """Number E of edges; 3 (N - 1) - Nb + 3 h on a domain with h holes."""
        return len(self.edges)

    @property
    def n_elements(self) -> int:
        """Number T of elements; 2 (N - 1) - Nb + 2 h on a domain with h holes."""
        return len(self.elements)

    @property
    def counts(self) -> tuple[int, int, int]:
        """(N, E, T), the numbers of nodes, edges and elements (section 2.1)."""
        return self.n_nodes, self.n_edges, self.n_elements

    @_derived
    def _edge_table(self) -> tuple[IntArray, IntArray]:
        self._refuse_bad_index()
        return topology.edge_table(self.elements, self.n_nodes)

    @property
    def edges(self) -> IntArray:
        """(E, 2) int32: node numbers, the smaller first, in lexicographic order."""
        return self._edge_table[0]

    @property
    def element_edges(self) -> IntArray:
        """(T, 3) int32: the edge opposite node k of element t."""
        return self._edge_table[1]

    @_derived
    def edge_elements(self) -> IntArray:
        """(E, 2) int32: the two elements of an edge; a boundary edge has -1 second."""
        return topology.sides(self.elements, self.element_edges, self.n_edges)

    @_derived
    def neighbours(self) -> IntArray:
        """(T, 3) int32: the element across the edge opposite node k, or -1."""
        return topology.neighbours(self.element_edges, self.edge_elements)

    @_derived
    def boundary(self) -> BoolArray:
        """(E,) bool: whether the edge lies on the boundary of the domain."""
        return self.edge_elements[:, 1] < 0

    @_derived
    def boundary_nodes(self) -> BoolArray:
        """(N,) bool: whether the node lies on the boundary of the domain."""
        mask = np.zeros(self.n_nodes, dtype=bool)
        mask[self.edges[self.boundary]] = True
        return mask

    @_derived
    def corners(self) -> FloatArray:
        """(T, 3, 2) float64: coordinates of the three nodes of each element."""
        self._refuse_bad_index()
        return self.nodes[self.elements]

    @_derived
    def areas(self) -> FloatArray:
        """(T,) float64: signed area of each element, positive if counter-clockwise, in squared units."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        u, v = b - a, c - a
        return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2

    @_derived
    def box(self) -> tuple[FloatArray, FloatArray]:
        """(2,), (2,) float64: the lower left and the upper right corner of the bounding box."""
        x, y = self.nodes.T  # many times faster than along axis 0
        return np.array([x.min(), y.min()]), np.array([x.max(), y.max()])

    @property
    def domain_area(self) -> float:
        """Area of the domain, the sum of the areas of its elements, in squared units of the coordinates."""
        return float(self.areas.sum())

    def _refuse_bad_index(self) -> None:
        if not getattr(self, "_valid", False):
            validation.require(validation.index_range, self)
