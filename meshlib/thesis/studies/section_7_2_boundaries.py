"""Three more measures (section 7.2): uniformity, valence, and the deviation from a curved domain."""

from functools import cache

import numpy as np

from ... import Mesh, curves, problems, refined, smoothed, swapped
from ...refinement.splitting import SPLITS
from .measures import Function
from .section_7_5_combining import START, adapted

FUNCTION = "SR1"
NODES = tuple(2**k for k in range(3, 9))  # numbers of nodes along a boundary
DENSITIES = {"curvature": "$\\kappa^{1/3}$", "length": "arc length", "parameter": "parameter"}
LOBES, DEPTH = 3, 0.35
FINE = 1 << 14  # points along a curve at which integrands are evaluated


# -- uniformity and valence --------------------------------------------------------------------


def meshes() -> dict[str, Mesh]:
    """Meshes that the methods of chapter 3 and Algorithm 7.5.1 make of the 33 nodes, by name."""
    mesh, u = problems.mesh(START), problems.functions[FUNCTION]
    found = {
        "start": mesh,
        "swapped": swapped(mesh, u, "abn").mesh,
        "smoothed": smoothed(mesh).mesh,
        "combined": adapted(FUNCTION).mesh,
    }
    return found | {split: refined(mesh, u, fraction=1, split=split).mesh for split in SPLITS}


# -- the boundary of the domain ------------------------------------------------------------------


def ellipse(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points of the ellipse with half axes 4 and 1."""
    return 4 * np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)


def trefoil(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points of a curve with three lobes, whose inside is not convex."""
    r = 1 + DEPTH * np.cos(2 * np.pi * LOBES * t)
    return r * np.cos(2 * np.pi * t), r * np.sin(2 * np.pi * t)


CURVES = {"ellipse": ellipse, "trefoil": trefoil}


def placed(name: str, n: int, density: str | Function = "curvature") -> np.ndarray:
    """Parameters of n nodes along one of the curves."""
    return curves.boundary_parameters(CURVES[name], n, density)


@cache
def lost(name: str, density: str) -> np.ndarray:
    """n^2 times the area between the curve and its polygon, for each number of nodes.

    Examples
    --------
    >>> lost("ellipse", "curvature").round(1).tolist()
    [80.2, 82.0, 82.5, 82.6, 82.7, 82.7]
    """
    return np.array([n**2 * curves.deviation(CURVES[name], placed(name, n, density)) for n in NODES])


def limits(name: str) -> dict[str, float]:
    """Limits of n^2 times the area lost, for each density w of the nodes.

    With the curvature k an arc of length h = W/(n w), W = int w ds, leaves a sliver of area
    k h^3/12.  There are n w/W of them for each unit of length, so that the limit is
    W^2/12 int k/w^2 ds.

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


def _around(name: str) -> np.ndarray:
    """Points all around a curve, at equal steps of its parameter."""
    return np.stack(CURVES[name](np.arange(FINE) / FINE))


def _speed_and_curvature(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    (dx, dy), (ddx, ddy) = _derivative(points), _derivative(_derivative(points))
    return np.hypot(dx, dy), np.abs(dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3


def _derivative(values: np.ndarray) -> np.ndarray:
    """Derivative of smooth periodic functions, given at equal steps, by their Fourier series."""
    return np.fft.ifft(2j * np.pi * np.fft.fftfreq(FINE, 1 / FINE) * np.fft.fft(values)).real


# -- data on the boundary ------------------------------------------------------------------------


@cache
def missed(name: str, function: str, by_data: bool) -> np.ndarray:
    """n^2 times the L2 error of linear interpolation along a curve, for each number of nodes.

    The nodes are placed by the function if ``by_data``, else at equal arcs.

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


def missed_limit(name: str, function: str) -> float:
    """Limit of `missed` for nodes placed by the function u: (int |u_ss|^(2/5) ds)^(5/2) / sqrt(120)."""
    points = _around(name)
    speed = np.hypot(*_derivative(points))
    u_ss = _derivative(_derivative(problems.functions[function](*points)) / speed) / speed
    return float((np.abs(u_ss) ** 0.4 * speed).mean() ** 2.5 / np.sqrt(120))
