"""The data structures of section 4.4 of the thesis: nodal, edge and element array with markers."""

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from .. import checks
from .._typing import AnyMesh, ArrayLike, FloatArray, IntArray
from . import topology

M = TypeVar("M", bound=AnyMesh)


def to_arrays(mesh: AnyMesh) -> tuple[FloatArray, IntArray, IntArray]:
    """Nodal array, (N, 3), edge array, (E, 3), and element array, (T, 3); see `meshlib.Mesh.to_arrays`."""
    nodes = np.column_stack([mesh.nodes, mesh.boundary_nodes])
    edges = np.column_stack([mesh.edges, mesh.boundary.astype(np.int32)])
    return nodes, edges, mesh.elements.copy()


def from_arrays(
    made: Callable[[ArrayLike, ArrayLike], M], nodes: ArrayLike, edges: ArrayLike, elements: ArrayLike
) -> M:
    """Mesh that ``made`` makes of nodes and elements, once edges and markers have been compared with it.

    See `meshlib.Mesh.from_arrays`.
    """
    marked_nodes, marked_edges = checks.marked(nodes, "nodes"), checks.marked(edges, "edges")
    mesh = made(marked_nodes[:, :2], elements)
    numbers = topology.edge_numbers(mesh.edges, mesh.n_nodes, checks.node_pairs(marked_edges[:, :2]))
    checks.each_edge_once(numbers, mesh.edges)
    checks.markers("edge", marked_edges[:, 2], mesh.boundary[numbers])
    checks.markers("node", marked_nodes[:, 2], mesh.boundary_nodes)
    return mesh
