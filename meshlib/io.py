"""Meshes and nodal values in and out of files, through meshio."""

from os import PathLike
from types import ModuleType
from typing import Any

import numpy as np

from . import checks
from ._typing import NDArray, Values
from .errors import InvalidInputError, missing_extra
from .mesh.mesh import Mesh


def write(path: str | PathLike[str], mesh: Mesh, values: Values | None = None) -> None:
    """Write a mesh, and nodal values if given, in the format of the file name.

    Parameters
    ----------
    path : str or path
        For example ``"mesh.vtu"``; any format that meshio writes.
    mesh : Mesh
    values : (N,) array_like of float, or callable, optional
        Written as the point data ``u``.

    Raises
    ------
    ImportError
        If meshio is not installed (extra ``io``).

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
    """Read a mesh of triangles.

    Parameters
    ----------
    path : str or path

    Returns
    -------
    mesh : Mesh
        Validated; the third coordinate, if any, is left out.
    data : dict of str to ndarray
        The point data of the file.

    Raises
    ------
    MeshError
        If the file holds no triangles, or they do not make a conforming mesh.
    ImportError
        If meshio is not installed (extra ``io``).
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
