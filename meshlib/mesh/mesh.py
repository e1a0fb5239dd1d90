"""The mesh: two arrays, from which everything else is derived."""

from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Any

import numpy as np

from .. import checks
from ..support.drawing import drawn
from . import topology


def _derived(method):
    """A property computed once, whose arrays are read-only."""

    @wraps(method)
    def computed(self):
        found = method(self)
        for array in found if isinstance(found, tuple) else (found,):
            array.flags.writeable = False
        return found

    return cached_property(computed)


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
        self._store("nodes", checks.node_array(self.nodes))  # copies, as all checked arrays are
        self._store("elements", checks.element_array(self.elements))
        self._store("green", checks.green_array(self.green))

    def _store(self, name, array):
        array = np.ascontiguousarray(array)
        array.flags.writeable = False
        object.__setattr__(self, name, array)

    def __reduce__(self):
        return Mesh, (self.nodes, self.elements, self.green)  # a copy is frozen too

    def __repr__(self):
        return "Mesh({} nodes, {} edges, {} elements)".format(*self.counts)

    def equals(self, other):
        """Whether both have the same nodes and the same elements, in any order.

        Examples
        --------
        >>> nodes = [[0, 0], [1, 0], [0, 1]]
        >>> Mesh(nodes, [[0, 1, 2]]).equals(Mesh(nodes, [[2, 0, 1]]))
        True
        """
        return np.array_equal(self.nodes, other.nodes) and np.array_equal(
            self._canonical_elements, other._canonical_elements
        )

    @_derived
    def _canonical_elements(self):
        return topology.canonical(self.elements)

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

    @_derived
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

    @_derived
    def edge_elements(self):
        """(E, 2) int32: the two elements of an edge; a boundary edge has -1 second."""
        return topology.sides(self.elements, self.element_edges, self.n_edges)

    @_derived
    def neighbours(self):
        """(T, 3) int32: the element across the edge opposite node k, or -1."""
        return topology.neighbours(self.element_edges, self.edge_elements)

    @_derived
    def boundary(self):
        """(E,) bool: whether the edge lies on the boundary of the domain."""
        return self.edge_elements[:, 1] < 0

    @_derived
    def boundary_nodes(self):
        """(N,) bool: whether the node lies on the boundary of the domain."""
        mask = np.zeros(self.n_nodes, dtype=bool)
        mask[self.edges[self.boundary]] = True
        return mask

    @_derived
    def corners(self):
        """(T, 3, 2) float64: coordinates of the three nodes of each element."""
        self._refuse_bad_index()
        return self.nodes[self.elements]

    @_derived
    def areas(self):
        """(T,) float64: signed area of each element, positive if counter-clockwise."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        u, v = b - a, c - a
        return (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / 2

    @_derived
    def box(self):
        """(2,), (2,) float64: the lower left and the upper right corner of the bounding box."""
        x, y = self.nodes.T  # many times faster than along axis 0
        return np.array([x.min(), y.min()]), np.array([x.max(), y.max()])

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
        return topology.edge_numbers(self.edges, self.n_nodes, checks.node_pairs(pairs))

    def _refuse_bad_index(self):
        if getattr(self, "_valid", False):
            return
        from . import validation

        validation.require(validation.index_range, self)

    def validate(self):
        """Check every clause of Definitions 2.0.1 and 2.0.2 in exact arithmetic.

        Returns
        -------
        Mesh
            The mesh itself, so that calls can be chained.

        Raises
        ------
        MeshError
            Names the clause (``index range``, ``duplicate``, ``degenerate``,
            ``orientation``, ``unused node``, ``overlap``, ``hanging node``,
            ``green pair``), the offending item, and what to do.

        Examples
        --------
        >>> Mesh([[0, 0], [1, 0], [0, 1]], [[0, 2, 1]]).validate()
        Traceback (most recent call last):
            ...
        meshlib.errors.InvalidMeshError: orientation: element 0 with nodes (0, 2, 1) is clockwise; reverse its nodes
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
    def _trusted(cls, nodes, elements, green=None, *, connected_as=None):
        """A mesh made by an operation that keeps a valid mesh valid; it takes the arrays as they are.

        The edges of ``connected_as``, a mesh with these elements on other nodes, are not derived again.
        """
        mesh = object.__new__(cls)
        mesh._store("nodes", nodes)
        mesh._store("elements", np.asarray(elements, dtype=np.int32))
        mesh._store("green", checks.green_array(green))
        object.__setattr__(mesh, "_valid", True)
        if connected_as is not None:
            mesh.__dict__["_edge_table"] = connected_as._edge_table
        return mesh

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draw the mesh.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            By default the axes of a new figure.
        **options
            As for `meshlib.plotting.plot_mesh`, for example ``nodes=True``.

        Returns
        -------
        matplotlib.axes.Axes

        See Also
        --------
        meshlib.Interpolant.plot

        Examples
        --------
        >>> from matplotlib import pyplot
        >>> ax = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).plot(nodes=True, ticks=True)
        >>> len(ax.lines)
        1
        >>> pyplot.close(ax.figure)
        """
        return drawn("plot_mesh", self, ax, options)

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
        nodes, edges, elements : (N, 3), (E, 3) and (T, 3) array_like
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
        nodes, edges = (checks.marked(array, what) for array, what in ((nodes, "nodes"), (edges, "edges")))
        mesh = cls(nodes[:, :2], elements)
        numbers = mesh.edge_numbers(edges[:, :2])
        checks.each_edge_once(numbers, mesh.edges)
        checks.markers("edge", edges[:, 2], mesh.boundary[numbers])
        checks.markers("node", nodes[:, 2], mesh.boundary_nodes)
        return mesh
