"""Peers of `meshlib.approximate`: MMG's two-dimensional remesher led by a metric, and pydelatin."""
import sys
import time

import numpy as np

from meshlib import Interpolant, Mesh, approximate, delaunay, problems

PASSES = 10  # of remeshing, each on the mesh of the one before
STEP = 1e-4  # of differences for second derivatives
FLOORS = (1e-4, 1e-3, 1e-2, 1e-1)  # of the eigenvalues of the Hessian, relative to their largest
START = 10  # cells along a side of the first lattice
RASTER = 1025  # samples along a side for pydelatin
LONGEST, SHORTEST = 2.0, 1e-6  # of an edge


def hessians(function, x, y, h=STEP):
    """Second derivatives by differences inside the unit square, (n, 2, 2)."""
    x, y = x.clip(h, 1 - h), y.clip(h, 1 - h)
    at = {(i, j): function(x + i * h, y + j * h) for i in (-1, 0, 1) for j in (-1, 0, 1)}
    xx = at[1, 0] - 2 * at[0, 0] + at[-1, 0]
    yy = at[0, 1] - 2 * at[0, 0] + at[0, -1]
    xy = (at[1, 1] - at[1, -1] - at[-1, 1] + at[-1, -1]) / 4
    return np.stack([xx, xy, xy, yy], axis=1).reshape(-1, 2, 2) / h ** 2


def metrics(function, nodes, floor, scale):
    """The metric that is optimal for the L2 norm, |det H|^(-1/6) |H| times the scale, (n, 3)."""
    size, axes = np.linalg.eigh(hessians(function, *nodes.T.copy()))
    size = np.abs(size)
    size = np.maximum(size, floor * size.max())
    size = size * scale * size.prod(axis=1, keepdims=True) ** (-1 / 6)
    size = size.clip(LONGEST ** -2, SHORTEST ** -2)
    full = np.einsum("nij,nj,nkj->nik", axes, size, axes)
    return np.ascontiguousarray(full[:, [0, 0, 1], [0, 1, 1]])


def mmg2d(function, n_nodes, floor=FLOORS[1], passes=PASSES):
    """The mesh of about so many nodes that MMG makes in some passes."""
    import mmgpy
    lattice = np.stack(np.meshgrid(*2 * [np.linspace(0, 1, START + 1)]), axis=-1).reshape(-1, 2)
    mesh, scale = delaunay(lattice), float(n_nodes)
    for _ in range(passes):
        work = mmgpy.MmgMesh2D(mesh.nodes, mesh.elements)
        work.set_field("tensor", metrics(function, mesh.nodes, floor, scale))
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


def _line(name, make, function, *arguments):
    start = time.perf_counter()
    mesh = make(function, *arguments)
    seconds = time.perf_counter() - start
    error = Interpolant(mesh, function).l2_error(function, "exact", degree=12)
    print(f"{name:10} {mesh.n_nodes:7} nodes {seconds:7.2f} s   error {error:.4e}   "
          f"error * elements {error * mesh.n_elements:.4f}", flush=True)


def main(n_nodes=1600, *names):
    """Ours and the peers, one after the other, on functions of the report."""
    for name in names or ("franke", "SR1", "SR2", "SR3", "DD1"):
        function = problems.functions[name]
        print(name)
        _line("approximate", lambda f, n: approximate(f, n).mesh, function, n_nodes)
        for floor in FLOORS:
            _line(f"MMG {floor:g}", mmg2d, function, n_nodes, floor)
        _line("pydelatin", delatin, function, n_nodes)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1600, *sys.argv[2:])
