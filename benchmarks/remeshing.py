"""Peers of `meshlib.approximate`: MMG's two-dimensional remesher with a metric, and pydelatin."""

import numpy as np

from meshlib import Mesh
from meshlib.thesis.studies.section_7_7a_limit import hessians, lattice

PASSES = 10  # remeshing passes, each on the mesh of the previous pass
STEP = 1e-4  # step of the differences for second derivatives
START = 121  # nodes of the first lattice
RASTER = 1025  # samples along a side for pydelatin
LONGEST, SHORTEST = 2.0, 1e-6  # lengths of an edge


def metrics(function, nodes, floor, step, scale):
    """The metric that is optimal for the L2 norm, |det H|^(-1/6) |H| times the scale, (n, 3).

    Eigenvalues of the Hessian are raised to the floor, a fraction of the largest eigenvalue.
    """
    size, axes = np.linalg.eigh(hessians(function, *nodes.T.clip(step, 1 - step), step))
    size = np.abs(size)
    size = np.maximum(size, floor * size.max())
    size = size * scale * size.prod(axis=1, keepdims=True) ** (-1 / 6)
    size = size.clip(LONGEST**-2, SHORTEST**-2)
    full = np.einsum("nij,nj,nkj->nik", axes, size, axes)
    return np.ascontiguousarray(full[:, [0, 0, 1], [0, 1, 1]])


def mmg2d(function, n_nodes, floor, step=STEP, passes=PASSES):
    """A mesh of about `n_nodes` nodes by MMG; after each pass the metric is scaled to that number."""
    import mmgpy

    mesh, scale = lattice(START), float(n_nodes)
    for _ in range(passes):
        work = mmgpy.MmgMesh2D(mesh.nodes, mesh.elements)
        work.set_field("tensor", metrics(function, mesh.nodes, floor, step, scale))
        work.remesh(hgrad=-1.0, verbose=-1)
        mesh = Mesh(work.get_vertices(), work.get_triangles())
        scale *= n_nodes / mesh.n_nodes
    return mesh


def delatin(function, n_nodes):
    """The greedy Delaunay mesh of pydelatin on a raster of samples, scaled to the unit square."""
    import pydelatin

    ticks = np.linspace(0, 1, RASTER)
    samples = function(*np.meshgrid(ticks, ticks)).astype(np.float32)
    found = pydelatin.Delatin(samples, max_error=0, max_points=n_nodes)
    nodes = np.asarray(found.vertices, dtype=float)[:, :2] / (RASTER - 1)
    nodes[:, 1] = 1 - nodes[:, 1]
    return Mesh(nodes, np.asarray(found.triangles)[:, ::-1])
