"""What is measured: for each measure calls of ours and of the best peers, on one case.

A function returns two dictionaries of calls by name.  All take the same data and do equal
work, set-up included.
"""

from importlib.util import find_spec

import numpy as np

import meshlib as ml
from meshlib.swapping.along_curve import along_curve

GRID = 1000
SHARE = 0.1
MANY = 200_000
PROCEDURES = {"JND-L2": ("jnd", 2), "ABN-L1": ("abn", 1), "ABN-L2": ("abn", 2)}


def swapping(case):
    """Adjacency and edge swapping to local optimality, against Qhull's Delaunay mesh of these nodes."""
    from scipy.spatial import Delaunay

    def ours(criterion, norm):
        return lambda: ml.swapped(case.fresh(), case.values, criterion, norm=norm, schedule="queue")

    return (
        {name: ours(*arguments) for name, arguments in PROCEDURES.items()},
        {"SciPy Delaunay": lambda: Delaunay(case.nodes)},
    )


def grid(case):
    """Values on a grid of 1000 by 1000 points."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation

    x = np.linspace(0, 1, GRID)

    def matplotlib():
        mesh = Triangulation(*case.nodes.T, case.mesh.elements)
        LinearTriInterpolator(mesh, case.values)(*np.meshgrid(x, x))

    return (
        {"on_grid": lambda: ml.Interpolant(case.fresh(), case.values).on_grid(GRID)},
        {"matplotlib": matplotlib},
    )


def numbering(case):
    """Values on a grid, before and after numbering along a space-filling curve; and the numbering."""
    placed = along_curve(case.mesh)
    values = case.values[placed.nodes]
    return {
        "grid as given": lambda: ml.Interpolant(case.fresh(), case.values).on_grid(GRID),
        "grid along the curve": lambda: ml.Interpolant(placed.mesh, values).on_grid(GRID),
        "along_curve": lambda: along_curve(case.fresh()),
    }, {}


def scattered(case):
    """Values on a given mesh at random points, one for each node.

    With a million points the peer takes minutes, so it is measured on random nodes alone.
    """
    from scipy.interpolate import LinearNDInterpolator
    from scipy.spatial import Delaunay

    ours = {"Interpolant": lambda: ml.Interpolant(case.fresh(), case.values)(*case.points)}
    if len(case.nodes) > MANY and case.kind != "random":
        return ours, {}
    triangulation = Delaunay(case.nodes)
    return ours, {"SciPy LinearND": lambda: LinearNDInterpolator(triangulation, case.values)(*case.points)}


def refinement(case):
    """Refinement of a tenth of the elements, chosen at random and marked for all."""
    from skfem import MeshTri

    n = case.mesh.n_elements
    marked = np.random.default_rng(1).permutation(n)[: int(SHARE * n)]
    costs = np.zeros(n)
    costs[marked] = 1
    criterion = ml.criteria.Criterion("marked", "element", lambda a, b, c: costs)

    def ours(split):
        return lambda: ml.refined(
            case.fresh(), case.values, criterion, fraction=SHARE, mark="element", split=split
        )

    nodes, elements = (np.ascontiguousarray(a.T) for a in (case.nodes, case.mesh.elements.astype(np.int64)))
    return (
        {split: ours(split) for split in ("red-green", "longest-edge", "centroid")},
        {"scikit-fem": lambda: MeshTri(nodes, elements).refined(marked)},
    )


def quality(case):
    """Maximum angle, skewness and aspect ratio of every element; of the peers the nearest measures."""
    from matplotlib.tri import TriAnalyzer, Triangulation

    def circles():
        return TriAnalyzer(Triangulation(*case.nodes.T, case.mesh.elements)).circle_ratios()

    vtk = (
        {"VTK": _vtk(case)} if find_spec("pyvista") else {}
    )  # a large package, which only this measure needs
    return {"three measures": lambda: ml.quality(case.fresh())}, {"matplotlib": circles, **vtk}


def _vtk(case):
    """Its angles give the skewness, its "shape" is our aspect ratio."""
    import pyvista

    points = np.column_stack([case.nodes, np.zeros(len(case.nodes))])
    elements = np.asarray(case.mesh.elements, dtype=np.int64)
    return lambda: pyvista.PolyData.from_regular_faces(points, elements).cell_quality(
        ["max_angle", "min_angle", "shape"]
    )


def smoothing(case):
    """One sweep of node movement with equal springs."""
    return {"one sweep": lambda: ml.smoothed(case.fresh(), max_sweeps=1)}, {}


def errors(case):
    """The L2 error, by quadrature on each element."""
    return {"exact": lambda: ml.Interpolant(case.fresh(), case.values).l2_error(case.u, rule="exact")}, {}


def validation(case):
    """All checks of the definition of a mesh, on arrays not yet checked."""
    return {"validate": lambda: ml.Mesh(case.nodes, case.mesh.elements).validate()}, {}


MEASURES = {
    "swapping": swapping,
    "grid": grid,
    "numbering": numbering,
    "scattered": scattered,
    "refinement": refinement,
    "quality": quality,
    "smoothing": smoothing,
    "errors": errors,
    "validation": validation,
}
