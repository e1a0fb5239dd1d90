"""Meshes and nodal values in and out of files, through meshio."""

from os import PathLike
from types import ModuleType
from typing import Any

import numpy as np

from . import checks
from ._typing import NDArray, Values
from .errors import InvalidInputError, missing_extra
from .mesh.mesh import Mesh

__all__ = ["read", "write"]


def write(path: str | PathLike[str], mesh: Mesh, values: Values | None = None) -> None:
    """Write a mesh, and nodal values if given, in the format of the file name.

    Parameters
    ----------
    path : str or path
        For example ``"mesh.vtu"``; any format that meshio writes.  An existing file is replaced.
    mesh : Mesh
        Written with a third coordinate of 0.
    values : (N,) array_like of float, or callable, optional
        Nodal values, or a vectorised function u(x, y); written as the point data ``u``.

    Raises
    ------
    MeshError
        If the values are not one finite number for each node.
    ImportError
        If meshio is not installed (extra ``io``).

    See Also
    --------
    read : the way back.

    Examples
    --------
    >>> import tempfile
    >>> from meshlib import problems
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write(f"{folder}/start.vtu", problems.mesh("33"), problems.functions["SR1"])
    ...     mesh, data = read(f"{folder}/start.vtu")
    >>> mesh.equals(problems.mesh("33")), list(data)
    (True, ['u'])
    """
    data = {} if values is None else {"u": checks.nodal_values(mesh, values)}
    points = np.column_stack([mesh.nodes, np.zeros(mesh.n_nodes)])
    _meshio().Mesh(points, [("triangle", mesh.elements)], point_data=data).write(path)


def read(path: str | PathLike[str]) -> tuple[Mesh, dict[str, NDArray[Any]]]:
    """Read a mesh of triangles, and the data at its nodes.

    Parameters
    ----------
    path : str or path
        A file in any format that meshio reads.

    Returns
    -------
    mesh : Mesh
        Validated; a third coordinate is ignored.
    data : dict of str to ndarray
        The point data of the file by name, arrays of N rows.

    Raises
    ------
    MeshError
        If the file holds no triangles, or they do not make a conforming mesh.
    ImportError
        If meshio is not installed (extra ``io``).

    See Also
    --------
    write : writes such a file.

    Examples
    --------
    >>> import tempfile
    >>> from meshlib import delaunay
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write(f"{folder}/square.vtk", delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), [0, 1, 2, 1])
    ...     mesh, data = read(f"{folder}/square.vtk")
    >>> mesh.counts, data["u"].tolist()
    ((4, 5, 2), [0.0, 1.0, 2.0, 1.0])
    """
    found = _meshio().read(path)
    triangles = found.cells_dict.get("triangle")
    if triangles is None:
        raise InvalidInputError("shape", f"{path} holds no triangles; export a triangular mesh")
    return Mesh(found.points[:, :2], triangles).validate(), dict(found.point_data)


def _meshio() -> ModuleType:
    try:
        import meshio
    except ImportError:
        raise missing_extra("meshio", "io") from None
    return meshio
