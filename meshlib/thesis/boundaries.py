"""Three more measures (section 7.2): uniformity, valence, and the deviation from a curved domain."""
from functools import cache

import numpy as np

from .. import combined, curves, problems, refined, smoothed, swapped, uniformity, valence
from ..splitting import SPLITS
from .tables import grid, numbered

START, FUNCTION, LIMIT = "33", "SR1", 10.0
NODES = tuple(2 ** k for k in range(3, 9))  # along a boundary
DENSITIES = {"curvature": "curvature to the power 1/3", "length": "arc length", "parameter": "angle"}
LOBES, DEPTH = 3, 0.35


# -- uniformity and valence --------------------------------------------------------------------


def meshes():
    """What chapter 3 and Algorithm 7.5.1 make of the 33 nodes, by name."""
    mesh, u = problems.mesh(START), problems.functions[FUNCTION]
    found = {"start": mesh, "swapped": swapped(mesh, u, "abn").mesh, "smoothed": smoothed(mesh).mesh,
             "combined": combined(mesh, u, min_angle=LIMIT).mesh}
    return found | {split: refined(mesh, u, fraction=1, split=split).mesh for split in SPLITS}


def table_measures():
    """Uniformity and valence of meshes for SR1."""
    rows = []
    for name, mesh in meshes().items():
        un, val = uniformity(mesh), valence(mesh)
        rows.append((name, mesh.n_nodes, mesh.n_elements, f"{un.mean():.2f}", f"{un.max():.1f}",
                     f"{val.mean():.3f}", val.max()))
    head = ("Mesh", "Nodes", "Elements", "Uniformity, mean", "max", "Valence, mean", "max")
    return numbered("tab-7-2-measures", f"Uniformity and valence for {FUNCTION}: the start mesh, the same nodes "
                    f"swapped, smoothed and combined (no angle below {LIMIT:g}°), and every element split once.",
                    grid(head, rows))


# -- the boundary of the domain ------------------------------------------------------------------


def ellipse(t):
    """Half axes 4 and 1."""
    return 4 * np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)


def trefoil(t):
    """Three lobes: a domain that is not convex."""
    r = 1 + DEPTH * np.cos(2 * np.pi * LOBES * t)
    return r * np.cos(2 * np.pi * t), r * np.sin(2 * np.pi * t)


CURVES = {"ellipse": ellipse, "trefoil": trefoil}


def placed(name, n, density="curvature"):
    """Parameters of n nodes along one of the curves."""
    return curves.boundary_parameters(CURVES[name], n, density)


@cache
def lost(name, density):
    """n^2 times the area between the curve and its polygon, for each number of nodes.

    Examples
    --------
    >>> lost("ellipse", "curvature").round(1).tolist()
    [80.2, 82.0, 82.5, 82.6, 82.7, 82.7]
    """
    return np.array([n ** 2 * curves.deviation(CURVES[name], placed(name, n, density)) for n in NODES])


def limits(name, samples=1 << 14):
    """What n^2 times the area tends to, by density: W^2/12 times the integral of k/w^2, W that of w.

    Examples
    --------
    >>> round(limits("ellipse")["curvature"] / (2 * np.pi ** 3 * 4 / 3), 6)
    1.0
    """
    t = np.arange(samples) / samples
    x, y = (np.fft.fft(v) for v in CURVES[name](t))
    turns = 2j * np.pi * np.fft.fftfreq(samples, 1 / samples)
    (dx, dy), (ddx, ddy) = ([np.fft.ifft(turns ** k * v).real for v in (x, y)] for k in (1, 2))
    speed, bend = np.hypot(dx, dy), np.abs(dx * ddy - dy * ddx)
    curvature = bend / speed ** 3
    weights = {"curvature": np.cbrt(curvature), "length": np.ones(samples), "parameter": 1 / speed}
    return {density: float((w * speed).mean() ** 2 / 12
                           * (np.divide(curvature, w ** 2, where=w > 0, out=0 * w) * speed).mean())
            for density, w in weights.items()}


def table_lost():
    """n^2 times the area lost, and its limit."""
    rows = [(name if density == "curvature" else "", title, *(f"{v:.2f}" for v in lost(name, density)),
             f"{limits(name)[density]:.2f}") for name in CURVES for density, title in DENSITIES.items()]
    head = ("", "The same between neighbours", *(f"$n = {n}$" for n in NODES), "$n \\to \\infty$")
    return numbered("tab-7-2-lost", "$n^2$ times the area between the curve and the polygon with $n$ nodes, "
                    "and the limit by theory.", grid(head, rows))
