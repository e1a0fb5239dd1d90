"""The mesh: two arrays, from which everything else is derived."""
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from . import checks, topology
from .errors import MeshError


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """A triangulation of a polygonal domain (Definition 2.0.1 of the thesis).

    Parameters
    ----------
    nodes : (N, 2) array_like of float
        Coordinates of the nodes.
    elements : (T, 3) array_like of int
        Node numbers of each element, counter-clockwise, from 0.
    green : (G, 2) array_like of int, optional
        Pairs of elements that together close a hanging node ("green" refinement,
        section 3.2.4); set by `refined`, which takes them back before it refines
        again.

    Raises
    ------
    MeshError
        If an array has the wrong shape or dtype, or a coordinate is not finite.
        What the arrays mean is checked by `validate`.

    Notes
    -----
    A mesh never changes: its arrays are read-only copies, and every operation
    returns a new one.

    Examples
    --------
    >>> mesh = Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh
    Mesh(4 nodes, 5 edges, 2 elements)
    >>> mesh.neighbours.tolist()
    [[-1, 1, -1], [-1, -1, 0]]
    """

    nodes: np.ndarray
    elements: np.ndarray
    green: np.ndarray = field(default=None)

    def __post_init__(self):
        green = np.empty((0, 2)) if self.green is None else self.green
        self._store("nodes", checks.node_array(self.nodes))
        self._store("elements", checks.element_array(self.elements))
        self._store("green", np.array(green, dtype=np.int32).reshape(-1, 2))

    def _store(self, name, array):
        array = np.array(array, order="C")
        array.flags.writeable = False
        object.__setattr__(self, name, array)

    def __repr__(self):
        return f"Mesh({self.n_nodes} nodes, {self.n_edges} edges, {self.n_elements} elements)"

    def equals(self, other):
        """Whether both have the same nodes and the same elements, in any order.

        Examples
        --------
        >>> nodes = [[0, 0], [1, 0], [0, 1]]
        >>> Mesh(nodes, [[0, 1, 2]]).equals(Mesh(nodes, [[2, 0, 1]]))
        True
        """
        return (np.array_equal(self.nodes, other.nodes)
                and np.array_equal(self._canonical_elements, other._canonical_elements))

    @cached_property
    def _canonical_elements(self):
        turned = topology.from_smallest(self.elements)
        return turned[np.lexsort(turned.T[::-1])]

    # -- counts ---------------------------------------------------------------

    @property
    def n_nodes(self):
        """Number N of nodes."""
        return len(self.nodes)

    @property
    def n_edges(self):
        """Number E of edges; 3 (N - 1) - Nb + 3 h on a domain with h holes."""
        return len(self.edges)

    @property
    def n_elements(self):
        """Number T of elements; 2 (N - 1) - Nb + 2 h on a domain with h holes."""
        return len(self.elements)

    @property
    def counts(self):
        """(N, E, T), the counts of section 2.1."""
        return self.n_nodes, self.n_edges, self.n_elements

    # -- derived arrays ---------------------------------------------------------

    @cached_property
    def _edge_table(self):
        self._refuse_bad_index()
        return topology.edge_table(self.elements, self.n_nodes)

    @property
    def edges(self):
        """(E, 2) int32: node numbers, the smaller first, in lexicographic order."""
        return self._edge_table[0]

    @property
    def element_edges(self):
        """(T, 3) int32: the edge opposite node k of element t."""
        return self._edge_table[1]

    @cached_property
    def edge_elements(self):
        """(E, 2) int32: the two elements of an edge; a boundary edge has -1 second."""
        return topology.sides(self.elements, self.element_edges, self.n_edges)

    @cached_property
    def neighbours(self):
        """(T, 3) int32: the element across the edge opposite node k, or -1."""
        return topology.neighbours(self.element_edges, self.edge_elements)

    @cached_property
    def boundary(self):
        """(E,) bool: whether the edge lies on the boundary of the domain."""
        return self.edge_elements[:, 1] < 0

    @cached_property
    def boundary_nodes(self):
        """(N,) bool: whether the node lies on the boundary of the domain."""
        mask = np.zeros(self.n_nodes, dtype=bool)
        mask[self.edges[self.boundary]] = True
        return mask

    @cached_property
    def corners(self):
        """(T, 3, 2) float64: coordinates of the three nodes of each element."""
        self._refuse_bad_index()
        return self.nodes[self.elements]

    @cached_property
    def areas(self):
        """(T,) float64: signed area of each element, positive if counter-clockwise."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        u, v = b - a, c - a
        return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2

    @property
    def domain_area(self):
        """Area of the domain, the sum of the areas of its elements."""
        return float(self.areas.sum())

    def edge_numbers(self, pairs):
        """Numbers of the edges that join the given pairs of nodes.

        Parameters
        ----------
        pairs : (m, 2) array_like of int
            Node numbers, in either order.

        Returns
        -------
        (m,) ndarray of int64
            Row numbers in `edges`; this turns the edge array of section 4.4 into
            an ``order`` for `swapped`.

        Raises
        ------
        MeshError
            If a pair of nodes is not joined by an edge.

        Examples
        --------
        >>> mesh = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
        >>> mesh.edge_numbers([[2, 1], [0, 1]]).tolist()
        [2, 0]
        """
        pairs = np.sort(np.asarray(pairs, dtype=np.int64).reshape(-1, 2), axis=1)
        own = self.edges.astype(np.int64) @ [self.n_nodes, 1]
        keys = pairs @ [self.n_nodes, 1]
        place = np.searchsorted(own, keys).clip(max=len(own) - 1)
        missing = np.flatnonzero(own[place] != keys)
        if missing.size:
            i, j = pairs[missing[0]]
            raise MeshError("edge", f"nodes {i} and {j} are not joined by an edge", (i, j))
        return place

    def _refuse_bad_index(self):
        from . import validation
        validation.require(validation.index_range, self)

    # -- validity -----------------------------------------------------------------

    def validate(self):
        """Check every clause of Definitions 2.0.1 and 2.0.2 in exact arithmetic.

        Returns
        -------
        Mesh
            The mesh itself, so that calls can be chained.

        Raises
        ------
        MeshError
            Names the clause (``index range``, ``duplicate``, ``orientation``,
            ``degenerate``, ``unused node``, ``overlap``, ``hanging node``), the
            offending item, and what to do.

        Examples
        --------
        >>> Mesh([[0, 0], [1, 0], [0, 1]], [[0, 2, 1]]).validate()
        Traceback (most recent call last):
            ...
        meshlib.errors.MeshError: orientation: element 0 with nodes (0, 2, 1) is clockwise; reverse its nodes
        """
        from . import validation
        for clause in validation.CLAUSES:
            validation.require(clause, self)
        object.__setattr__(self, "_valid", True)
        return self

    def _checked(self):
        """The mesh, validated once in its life."""
        return self if getattr(self, "_valid", False) else self.validate()

    @classmethod
    def _trusted(cls, nodes, elements, green=None):
        """A mesh made by an operation that keeps a valid mesh valid."""
        mesh = cls(nodes, elements, green)
        object.__setattr__(mesh, "_valid", True)
        return mesh

    # -- the data structures of section 4.4 ------------------------------------------

    def to_arrays(self):
        """Nodal, edge and element array of section 4.4.

        Returns
        -------
        nodes : (N, 3) ndarray of float64
            x, y and the marker 1.0 on the boundary, 0.0 inside.
        edges : (E, 3) ndarray of int32
            The two node numbers and the marker 1 on the boundary, 0 inside.
        elements : (T, 3) ndarray of int32
            Node numbers, counter-clockwise.

        Examples
        --------
        >>> nodes, edges, elements = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).to_arrays()
        >>> edges.tolist()
        [[0, 1, 1], [0, 2, 1], [1, 2, 1]]
        """
        nodes = np.column_stack([self.nodes, self.boundary_nodes])
        edges = np.column_stack([self.edges, self.boundary.astype(np.int32)])
        return nodes, edges, self.elements.copy()

    @classmethod
    def from_arrays(cls, nodes, edges, elements):
        """Mesh from the three arrays of section 4.4, whose markers must agree.

        Parameters
        ----------
        nodes : (N, 3) array_like of float
        edges : (E, 3) array_like of int
        elements : (T, 3) array_like of int
            As returned by `to_arrays`; the edges may stand in any order.

        Raises
        ------
        MeshError
            If an edge is missing, not an edge of the elements, or wrongly marked.

        Examples
        --------
        >>> mesh = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
        >>> Mesh.from_arrays(*mesh.to_arrays()).equals(mesh)
        True
        """
        nodes, edges = np.asarray(nodes), np.asarray(edges)
        for array, what in ((nodes, "nodes"), (edges, "edges")):
            if array.ndim != 2 or array.shape[1] != 3:
                raise MeshError("shape", f"{what} have shape {array.shape}; give three columns, "
                                "the third the boundary marker")
        mesh = cls(nodes[:, :2], elements)
        numbers = mesh.edge_numbers(edges[:, :2])
        checks.permutation(numbers, mesh.n_edges)
        _refuse_wrong_marker("edge", edges[:, 2], mesh.boundary[numbers])
        _refuse_wrong_marker("node", nodes[:, 2], mesh.boundary_nodes)
        return mesh


def _refuse_wrong_marker(what, given, derived):
    wrong = np.flatnonzero((given != 0) != derived)
    if wrong.size:
        place = "on the boundary" if derived[wrong[0]] else "inside"
        raise MeshError("marker", f"{what} {wrong[0]} is marked {given[wrong[0]]:g} but lies {place}; "
                        "mark 1 on the boundary and 0 inside", wrong)
