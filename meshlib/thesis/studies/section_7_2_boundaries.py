"""Three more measures (section 7.2): uniformity, valence, and the deviation from a curved domain."""

from functools import cache

import numpy as np

from ... import curves, problems, refined, smoothed, swapped, uniformity, valence
from ...refinement.splitting import SPLITS
from ..tables.numbered import grid, numbered
from .section_7_5_combining import LIMIT, START, adapted

FUNCTION = "SR1"
NODES = tuple(2**k for k in range(3, 9))  # along a boundary
DENSITIES = {"curvature": "$\\kappa^{1/3}$", "length": "arc length", "parameter": "parameter"}
LOBES, DEPTH = 3, 0.35
FINE = 1 << 14  # points along a curve, for integrals


# -- uniformity and valence --------------------------------------------------------------------


def meshes():
    """What chapter 3 and Algorithm 7.5.1 make of the 33 nodes, by name."""
    mesh, u = problems.mesh(START), problems.functions[FUNCTION]
    found = {
        "start": mesh,
        "swapped": swapped(mesh, u, "abn").mesh,
        "smoothed": smoothed(mesh).mesh,
        "combined": adapted(FUNCTION).mesh,
    }
    return found | {split: refined(mesh, u, fraction=1, split=split).mesh for split in SPLITS}


def table_measures():
    """Uniformity and valence of meshes for SR1."""
    rows = []
    for name, mesh in meshes().items():
        un, val = uniformity(mesh), valence(mesh)
        rows.append(
            (
                name,
                mesh.n_nodes,
                mesh.n_elements,
                f"{un.mean():.2f}",
                f"{un.max():.1f}",
                f"{val.mean():.3f}",
                val.max(),
            )
        )
    head = ("Mesh", "Nodes", "Elements", "Uniformity, mean", "max", "Valence, mean", "max")
    caption = (
        f"Uniformity and valence for {FUNCTION}: the start mesh, the same nodes swapped, smoothed and "
        f"combined (no angle below {LIMIT:g}°), and every element split once."
    )
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
    return np.array([n**2 * curves.deviation(CURVES[name], placed(name, n, density)) for n in NODES])


def limits(name):
    """What n^2 times the area tends to, by density w: W^2 K/12, with W = int w ds and K = int k/w^2 ds.

    An arc of length h = W/(n w) leaves a sliver of area k h^3/12, and there are n w/W of
    them for each unit of length.

    Examples
    --------
    >>> round(limits("ellipse")["curvature"] / (2 * np.pi ** 3 * 4 / 3), 6)
    1.0
    """
    speed, curvature = _speed_and_curvature(_around(name))
    found = {}
    weights = {"curvature": np.cbrt(curvature), "length": 1 + 0 * speed, "parameter": 1 / speed}
    for density, w in weights.items():
        ratio = np.divide(curvature, w**2, where=w > 0, out=np.zeros(FINE))
        found[density] = float((w * speed).mean() ** 2 * (ratio * speed).mean() / 12)
    return found


def _around(name):
    """Points all around a curve, at equal steps of its parameter."""
    return np.stack(CURVES[name](np.arange(FINE) / FINE))


def _speed_and_curvature(points):
    (dx, dy), (ddx, ddy) = _derivative(points), _derivative(_derivative(points))
    return np.hypot(dx, dy), np.abs(dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3


def _derivative(values):
    """Of smooth periodic functions at equal steps, by their Fourier series."""
    return np.fft.ifft(2j * np.pi * np.fft.fftfreq(FINE, 1 / FINE) * np.fft.fft(values)).real


def table_lost():
    """n^2 times the area lost, and its limit."""
    rows = [
        (
            name if density == "curvature" else "",
            title,
            *(f"{v:.2f}" for v in lost(name, density)),
            f"{limits(name)[density]:.2f}",
        )
        for name in CURVES
        for density, title in DENSITIES.items()
    ]
    head = ("", "The same between neighbours", *(f"$n = {n}$" for n in NODES), "$n \\to \\infty$")
    return numbered(
        "tab-7-2-lost",
        "$n^2$ times the area between the curve and the polygon with $n$ nodes, and the limit by theory.",
        grid(head, rows),
    )


# -- data on the boundary ------------------------------------------------------------------------


@cache
def missed(name, function, by_data):
    """n^2 times the L2 error of linear interpolation along a curve, for each number of nodes.

    Nodes are placed by the function or at equal arcs.

    Examples
    --------
    >>> missed("trefoil", "SR1", True)[-1] < missed("trefoil", "SR1", False)[-1] / 3
    np.True_
    """
    u, t = problems.functions[function], np.arange(FINE + 1) / FINE
    x, y = CURVES[name](t)
    s = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    found = []
    for n in NODES:
        at = np.append(placed(name, n, u if by_data else "length"), 1)
        linear = np.interp(s, np.interp(at, t, s), u(*CURVES[name](at)))
        found.append(n**2 * np.sqrt(np.trapezoid((u(x, y) - linear) ** 2, s)))
    return np.array(found)


def missed_limit(name, function):
    """What it tends to if u decides: the integral of |u_ss|^(2/5), to the power 5/2, over root 120."""
    points = _around(name)
    speed = np.hypot(*_derivative(points))
    u_ss = _derivative(_derivative(problems.functions[function](*points)) / speed) / speed
    return float((np.abs(u_ss) ** 0.4 * speed).mean() ** 2.5 / np.sqrt(120))


def table_missed(name="trefoil", function="SR1"):
    """n^2 times the error along the boundary, by the data and by arc length."""
    limit = f"{missed_limit(name, function):.3f}"
    cases = (r"$\lvert u_{ss}\rvert^{2/5}$", True, limit), ("arc length", False, "")
    rows = [
        (title, *(f"{v:.3f}" for v in missed(name, function, by_data)), last)
        for title, by_data, last in cases
    ]
    head = ("The same between neighbours", *(f"$n = {n}$" for n in NODES), "$n \\to \\infty$")
    caption = (
        f"$n^2$ times the $L_2$ error of linear interpolation of {function} along the boundary of the "
        f"{name} between $n$ nodes."
    )
    return numbered("tab-7-2-data", caption, grid(head, rows))
