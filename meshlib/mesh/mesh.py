"""The mesh: nodes and elements, from which all but the memory of green refinement is derived."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import checks
from .._typing import ArrayLike, FloatArray, IntArray, NDArray
from ..support.drawing import drawn
from . import arrays, topology, validation
from .derived import Derived


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Mesh(Derived):
    """A triangulation of a polygonal domain (Definition 2.0.1 of the thesis).

    Parameters
    ----------
    nodes : (N, 2) array_like of float
        Coordinates of the nodes.
    elements : (T, 3) array_like of int
        Node numbers of each element, counter-clockwise, from 0.
    green : (G, 2) array_like of int, optional
        Pairs of elements that halve a larger one, so that no node hangs on its edge
        (section 3.2.4); none by default.

    Raises
    ------
    MeshError
        If an array has the wrong shape or dtype, or a coordinate is not finite.
        What the arrays mean is checked by `validate`.

    Notes
    -----
    A mesh never changes: its arrays are read-only copies, and every operation
    returns a new mesh.

    Nodes and elements alone make the triangulation.  The green pairs are a memory of
    red-green refinement: `refined` sets them, and joins each pair again before it refines
    the next time.  They cannot be derived, and they have no part in `equals`.

    See Also
    --------
    delaunay, refined, Interpolant

    Examples
    --------
    >>> mesh = Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh
    Mesh(4 nodes, 5 edges, 2 elements)
    >>> mesh.neighbours.tolist()
    [[-1, 1, -1], [-1, -1, 0]]
    """

    nodes: FloatArray
    elements: IntArray
    green: IntArray

    def __init__(self, nodes: ArrayLike, elements: ArrayLike, green: ArrayLike | None = None) -> None:
        self._store("nodes", checks.node_array(nodes))  # copies, as all checked arrays are
        self._store("elements", checks.element_array(elements))
        self._store("green", checks.green_array(green))

    def _store(self, name: str, array: NDArray[Any]) -> None:
        array = np.ascontiguousarray(array)
        array.flags.writeable = False
        object.__setattr__(self, name, array)

    def __reduce__(self) -> tuple[type[Mesh], tuple[FloatArray, IntArray, IntArray]]:
        return Mesh, (self.nodes, self.elements, self.green)  # a copy is frozen too

    def __repr__(self) -> str:
        return "Mesh({} nodes, {} edges, {} elements)".format(*self.counts)

    def equals(self, other: Mesh) -> bool:
        """Whether another mesh has the same nodes, in the same order, and the same elements, in any order.

        Parameters
        ----------
        other : Mesh

        Returns
        -------
        bool

        Examples
        --------
        >>> nodes = [[0, 0], [1, 0], [0, 1]]
        >>> Mesh(nodes, [[0, 1, 2]]).equals(Mesh(nodes, [[2, 0, 1]]))
        True
        """
        return np.array_equal(self.nodes, other.nodes) and np.array_equal(
            self._canonical_elements, other._canonical_elements
        )

    def edge_numbers(self, pairs: ArrayLike) -> IntArray:
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

    def validate(self) -> Mesh:
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
        """  # noqa: E501
        for clause in validation.CLAUSES:
            validation.require(clause, self)
        object.__setattr__(self, "_valid", True)
        return self

    def _checked(self) -> Mesh:
        """The mesh, validated unless it has been before."""
        return self if getattr(self, "_valid", False) else self.validate()

    @classmethod
    def _trusted(
        cls,
        nodes: FloatArray,
        elements: ArrayLike,
        green: ArrayLike | None = None,
        *,
        connected_as: Mesh | None = None,
    ) -> Mesh:
        """A mesh made by an operation that keeps a valid mesh valid: nothing is checked or copied.

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

    def to_arrays(self) -> tuple[FloatArray, IntArray, IntArray]:
        """Nodal, edge and element array of section 4.4.

        Returns
        -------
        nodes : (N, 3) ndarray of float64
            x, y and the marker 1.0 on the boundary, 0.0 inside.
        edges : (E, 3) ndarray of int32
            The two node numbers and the marker 1 on the boundary, 0 inside.
        elements : (T, 3) ndarray of int32
            Node numbers, counter-clockwise.

        See Also
        --------
        from_arrays, meshlib.io

        Examples
        --------
        >>> nodes, edges, elements = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]).to_arrays()
        >>> edges.tolist()
        [[0, 1, 1], [0, 2, 1], [1, 2, 1]]
        """
        return arrays.to_arrays(self)

    @classmethod
    def from_arrays(cls, nodes: ArrayLike, edges: ArrayLike, elements: ArrayLike) -> Mesh:
        """Mesh from the three arrays of section 4.4, whose markers must agree with it.

        Parameters
        ----------
        nodes, edges, elements : (N, 3), (E, 3) and (T, 3) array_like
            As returned by `to_arrays`; the edges may stand in any order.

        Returns
        -------
        Mesh

        Raises
        ------
        MeshError
            If an edge is missing, given twice, not an edge of the elements, or wrongly marked,
            or a node is wrongly marked.

        See Also
        --------
        to_arrays, meshlib.io

        Examples
        --------
        >>> mesh = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
        >>> Mesh.from_arrays(*mesh.to_arrays()).equals(mesh)
        True
        """
        return arrays.from_arrays(cls, nodes, edges, elements)
