"""The data structures of section 4.4 of the thesis: nodal, edge and element array with markers."""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from .. import checks
from .._typing import AnyMesh, ArrayLike, BoolArray, FloatArray, IntArray, NDArray
from ..errors import InvalidInputError, InvalidMeshError
from . import topology

MeshT = TypeVar("MeshT", bound=AnyMesh)


def to_arrays(mesh: AnyMesh) -> tuple[FloatArray, IntArray, IntArray]:
    """Nodal array, (N, 3), edge array, (E, 3), and element array, (T, 3); see `meshlib.Mesh.to_arrays`."""
    nodes = np.column_stack([mesh.nodes, mesh.boundary_nodes])
    edges = np.column_stack([mesh.edges, mesh.boundary.astype(np.int32)])
    return nodes, edges, mesh.elements.copy()


def from_arrays(
    made: Callable[[ArrayLike, ArrayLike], MeshT], nodes: ArrayLike, edges: ArrayLike, elements: ArrayLike
) -> MeshT:
    """Mesh that ``made`` makes of nodes and elements, once edges and markers have been compared with it.

    See `meshlib.Mesh.from_arrays`.
    """
    marked_nodes, marked_edges = _marked(nodes, "nodes"), _marked(edges, "edges")
    mesh = made(marked_nodes[:, :2], elements)
    numbers = topology.edge_numbers(mesh.edges, mesh.n_nodes, checks.node_pairs(marked_edges[:, :2]))
    _require_each_edge_once(numbers, mesh.edges)
    _require_markers("edge", marked_edges[:, 2], mesh.boundary[numbers])
    _require_markers("node", marked_nodes[:, 2], mesh.boundary_nodes)
    return mesh


def _require_each_edge_once(numbers: IntArray, edges: IntArray) -> None:
    """Raise a MeshError that names an edge given twice or not at all.

    ``numbers`` are the rows of ``edges``, (E, 2), that have been given.
    """
    missing = np.setdiff1d(np.arange(len(edges)), numbers)
    order = np.argsort(numbers, kind="stable")
    again = np.flatnonzero(np.diff(numbers[order]) == 0)
    if again.size:
        (i, j), first, second = edges[numbers[order[again[0]]]], order[again[0]], order[again[0] + 1]
        raise InvalidMeshError(
            "edge",
            f"nodes {i} and {j} are given twice, in rows {first} and {second}; keep one of them",
            edges[numbers[order[again]]].ravel(),
            again.size,
        )
    if missing.size:
        i, j = edges[missing[0]]
        raise InvalidMeshError(
            "edge",
            f"nodes {i} and {j} are joined by an edge that is not given; add it",
            edges[missing].ravel(),
            missing.size,
        )


def _marked(array: ArrayLike, what: str) -> NDArray[Any]:
    """Three columns, the third a boundary marker, or a MeshError."""
    found = np.asarray(array)
    if found.ndim != 2 or found.shape[1] != 3:
        raise InvalidInputError(
            "shape", f"{what} have shape {found.shape}; give three columns, the third the boundary marker"
        )
    return found


def _require_markers(what: str, given: NDArray[Any], derived: BoolArray) -> None:
    """Raise a MeshError that names a marker which disagrees with the mesh."""
    wrong = np.flatnonzero((given != 0) != derived)
    if wrong.size:
        place = "on the boundary" if derived[wrong[0]] else "inside"
        raise InvalidMeshError(
            "marker",
            f"{what} {wrong[0]} is marked {given[wrong[0]]:g} but lies {place}; "
            "mark 1 on the boundary and 0 inside",
            wrong,
            wrong.size,
        )
