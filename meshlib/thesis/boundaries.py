"""Three more measures (section 7.2): uniformity, valence, and the deviation from a curved domain."""
from functools import cache

import numpy as np

from .. import combined, curves, problems, refined, smoothed, swapped, uniformity, valence
from ..splitting import SPLITS
from .tables import grid, numbered

START, FUNCTION, LIMIT = "33", "SR1", 10.0
NODES = tuple(2 ** k for k in range(3, 9))  # along a boundary
DENSITIES = {"curvature": "$\\kappa^{1/3}$", "length": "arc length", "parameter": "parameter"}
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
    caption = (f"Uniformity and valence for {FUNCTION}: the start mesh, the same nodes swapped, smoothed and "
               f"combined (no angle below {LIMIT:g}°), and every element split once.")
    return numbered("tab-7-2-measures", caption, grid(head, rows))


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
    """What n^2 times the area tends to, by density w: W^2 K/12, with W = int w ds and K = int k/w^2 ds.

    An arc of length h = W/(n w) leaves a sliver of area k h^3/12, and there are n w/W of
    them for each unit of length.

    Examples
    --------
    >>> round(limits("ellipse")["curvature"] / (2 * np.pi ** 3 * 4 / 3), 6)
    1.0
    """
    speed, curvature = _speed_and_curvature(CURVES[name](np.arange(samples) / samples))
    found = {}
    weights = {"curvature": np.cbrt(curvature), "length": 1 + 0 * speed, "parameter": 1 / speed}
    for density, w in weights.items():
        ratio = np.divide(curvature, w ** 2, where=w > 0, out=np.zeros(samples))
        found[density] = float((w * speed).mean() ** 2 * (ratio * speed).mean() / 12)
    return found


def _speed_and_curvature(points):
    """Of a smooth periodic curve at equal steps of its parameter, by Fourier series."""
    n = len(points[0])
    turns = 2j * np.pi * np.fft.fftfreq(n, 1 / n)
    (dx, dy), (ddx, ddy) = (np.fft.ifft(turns ** k * np.fft.fft(points)).real for k in (1, 2))
    return np.hypot(dx, dy), np.abs(dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3


def table_lost():
    """n^2 times the area lost, and its limit."""
    rows = [(name if density == "curvature" else "", title, *(f"{v:.2f}" for v in lost(name, density)),
             f"{limits(name)[density]:.2f}") for name in CURVES for density, title in DENSITIES.items()]
    head = ("", "The same between neighbours", *(f"$n = {n}$" for n in NODES), "$n \\to \\infty$")
    return numbered("tab-7-2-lost", "$n^2$ times the area between the curve and the polygon with $n$ nodes, "
                    "and the limit by theory.", grid(head, rows))
