"""The matrix of the Poisson problem on a mesh, and its condition number (section 7.7)."""

from functools import cache

import numpy as np

from ... import Mesh
from ...errors import missing_extra
from ...mesh.quality import angles
from .experiments import run
from .section_7_5_combining import adapted
from .section_7_7a_limit import FUNCTIONS, LEAST_ANGLE, made

START = ("start-33", "start-81", "start-33-refined")
THESIS = {
    "5": (
        "SR1-33-ABN-L1",
        "SR1-33-ABN-L2",
        "SR2-33-ABN-L1",
        "SR2-81-JND-L2",
        "SR3-81-JND-L2",
        "DD1-33-refined-ABN-L2",
        "SR1-33-by-edge",
        "SR1-81-by-edge",
    ),
    "6": ("SR3-81-8-degrees", "DD1-33-refined-reordered", "SR1-33-density"),
}
COMBINED = ("SR1", "SR2", "SR3", "DD1")


def stiffness(mesh: Mesh) -> np.ndarray:
    """Stiffness matrix of the Poisson problem with linear elements, assembled by scikit-fem.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (n, n) ndarray of float64
        Rows and columns of the inner nodes; on the boundary the solution is prescribed.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> stiffness(delaunay([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])).round(12).tolist()
    [[4.0]]
    """
    try:
        from skfem import Basis, ElementTriP1, MeshTri
        from skfem.models.poisson import laplace
    except ImportError as error:
        raise missing_extra("scikit-fem", "fem") from error
    arrays = (np.ascontiguousarray(a.T) for a in (mesh.nodes, mesh.elements.astype(np.int64)))
    matrix = laplace.assemble(Basis(MeshTri(*arrays), ElementTriP1()))
    inner = np.flatnonzero(~mesh.boundary_nodes)
    return matrix.tocsr()[inner][:, inner].toarray()


def conditions(mesh: Mesh) -> tuple[float, float]:
    """Condition numbers of the stiffness matrix K, as it is and scaled by its diagonal D.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    plain, scaled : float
        Condition numbers in the 2-norm of K and of D^(-1/2) K D^(-1/2).

    Examples
    --------
    >>> from meshlib import problems
    >>> [round(c, 6) for c in conditions(problems.mesh("81"))], round(float(np.tan(np.pi / 16) ** -2), 6)
    ([25.274142, 25.274142], 25.274142)
    """
    matrix = stiffness(mesh)
    root = np.sqrt(np.diag(matrix))
    return float(np.linalg.cond(matrix)), float(np.linalg.cond(matrix / root / root[:, None]))


@cache
def families() -> dict[str, dict[str, Mesh]]:
    """Meshes of the report: where they come from -> name -> mesh."""
    free = {name: made(name).mesh for name in FUNCTIONS}
    limited = {name: made(name, min_angle=LEAST_ANGLE).mesh for name in FUNCTIONS}
    chapters = {f"chapter {number}": {key: run(key).mesh for key in keys} for number, keys in THESIS.items()}
    return (
        {"start": {key: run(key).mesh for key in START}}
        | chapters
        | {"section 7.5": {name: adapted(name).mesh for name in COMBINED}}
        | {"approximate": free, f"approximate, {LEAST_ANGLE:g}°": limited}
    )


@cache
def measured() -> dict[tuple[str, str], tuple[float, float, float]]:
    """(family, name) -> smallest angle in degrees and the two condition numbers."""
    return {
        (family, name): (float(np.degrees(angles(mesh.corners).min())), *conditions(mesh))
        for family, meshes in families().items()
        for name, mesh in meshes.items()
    }
