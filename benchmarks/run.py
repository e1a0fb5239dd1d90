"""Times against peers, in one run on the same data: ``python benchmarks/run.py --nodes 100000``.

Every line is the median of several runs of ours and of the peer, taken in turn, and
their ratio.  Results are printed as a table and, with ``--json``, written to a file
together with the machine and the versions.
"""
import argparse
import json
import platform
import statistics
import time
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from scipy.interpolate import LinearNDInterpolator
from scipy.spatial import Delaunay

import meshlib as ml
from meshlib import problems
from meshlib.renumbering import AlongCurve
from meshlib.swapping import prepared

GRID = 1000
SHARE = 0.1
PACKAGES = ("numpy", "scipy", "numba", "matplotlib", "scikit-fem")


class Case:
    """Random nodes, their Delaunay mesh, and values of Franke's function."""

    def __init__(self, n, seed=0):
        rng = np.random.default_rng(seed)
        self.nodes, self.points = rng.random((n, 2)), rng.random((2, n))
        self.mesh = ml.delaunay(self.nodes)
        self.u = problems.functions["franke"]
        self.values = self.u(*self.nodes.T)

    def fresh(self):
        """The mesh with nothing derived from it yet."""
        return ml.Mesh._trusted(self.nodes, self.mesh.elements)


def swapping(case, criterion, norm):
    """Adjacency and edge swapping to local optimality, against SciPy's Delaunay."""
    def ours():
        procedure = prepared(case.fresh(), case.values, criterion, norm, None, None, None)
        AlongCurve(procedure).run(None)
    return ours, lambda: Delaunay(case.nodes)


def grid(case):
    """Evaluation on a grid, against matplotlib, set-up included."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation
    x = np.linspace(0, 1, GRID)

    def peer():
        mesh = Triangulation(*case.nodes.T, case.mesh.elements)
        LinearTriInterpolator(mesh, case.values)(*np.meshgrid(x, x))
    return lambda: ml.Interpolant(case.fresh(), case.values).on_grid(GRID), peer


def scattered(case):
    """Evaluation at as many points as nodes, against SciPy on the same mesh."""
    triangulation = Delaunay(case.nodes)
    return (lambda: ml.Interpolant(case.fresh(), case.values)(*case.points),
            lambda: LinearNDInterpolator(triangulation, case.values)(*case.points))


def quality(case):
    """Maximum angle, skewness and aspect ratio, against the ratio of circles by matplotlib."""
    from matplotlib.tri import TriAnalyzer, Triangulation
    return (lambda: ml.quality(case.fresh()),
            lambda: TriAnalyzer(Triangulation(*case.nodes.T, case.mesh.elements)).circle_ratios())


def quality_in_vtk(case):
    """The same, against VTK, whose extreme angles say the skewness and whose shape is the aspect ratio."""
    from pyvista import PolyData
    nodes = np.column_stack([case.nodes, np.zeros(len(case.nodes))])
    mesh = PolyData.from_regular_faces(nodes, case.mesh.elements)
    return lambda: ml.quality(case.fresh()), lambda: mesh.cell_quality(["max_angle", "min_angle", "shape"])


def refinement(case):
    """Red-green refinement of a tenth of the elements, against scikit-fem."""
    from skfem import MeshTri
    marked = np.random.default_rng(1).permutation(case.mesh.n_elements)[:int(SHARE * case.mesh.n_elements)]
    costs = np.zeros(case.mesh.n_elements)
    costs[marked] = 1

    def ours():
        ml.refined(case.fresh(), case.values, ml.criteria.Criterion("marked", "element", lambda a, b, c: costs),
                   SHARE, mark="element", split="red-green")
    return ours, lambda: MeshTri(case.nodes.T, case.mesh.elements.T.astype(np.int64)).refined(marked)


MEASURES = {
    "swap, JND-L2 / Delaunay": lambda case: swapping(case, "jnd", 2),
    "swap, ABN-L1 / Delaunay": lambda case: swapping(case, "abn", 1),
    "swap, ABN-L2 / Delaunay": lambda case: swapping(case, "abn", 2),
    "grid / matplotlib": grid,
    "scattered / SciPy": scattered,
    "quality / matplotlib": quality,
    "red-green / scikit-fem": refinement,
}
if find_spec("pyvista"):  # large, and asked for by nothing else
    MEASURES["quality / VTK"] = quality_in_vtk


def timed(function):
    """Seconds that a call takes."""
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def measured(case, name, runs):
    """Medians of ours and of the peer, run in turn after one run that does not count."""
    ours, peer = MEASURES[name](case)
    ours()
    pairs = [(timed(ours), timed(peer)) for _ in range(runs)]
    first, second = (statistics.median(column) for column in zip(*pairs, strict=True))
    return {"measure": name, "nodes": len(case.nodes), "ours": first, "peer": second, "ratio": first / second}


def about():
    """The machine and the versions."""
    return {"machine": platform.machine(), "python": platform.python_version(),
            "versions": {name: version(name) for name in PACKAGES}}


def main(arguments=None):
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nodes", type=int, nargs="+", default=[10_000, 100_000])
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--json", type=Path, help="write the results to this file")
    chosen = parser.parse_args(arguments)
    results = []
    print(f"{'measure':<26} {'nodes':>9} {'ours, s':>9} {'peer, s':>9} {'ours/peer':>9}")
    for case in map(Case, chosen.nodes):
        for name in MEASURES:
            line = measured(case, name, chosen.runs)
            results.append(line)
            print(f"{name:<26} {line['nodes']:>9} {line['ours']:9.4f} {line['peer']:9.4f} {line['ratio']:9.4f}",
                  flush=True)
    if chosen.json:
        chosen.json.write_text(json.dumps(about() | {"results": results}, indent=1) + "\n")


if __name__ == "__main__":
    main()
