"""The limit of piecewise linear interpolation (section 7.7), and how near meshes come to it."""

from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np

from ... import Interpolant, Mesh, approximate, delaunay, problems
from ...approximation.approximate import Approximation
from .measures import Function

DEFINITE, INDEFINITE = 4 / 45, 1 / 90  # squared error of the best element / (|det H| area^3)
ZIGZAG = 0.75  # error of strips whose nodes on one side are half a strip ahead / of parallel strips
STEP = 3e-5  # distance of the points from which second derivatives are computed
CELLS = 1000  # cells along a side in the integral of the Hessian
Box: TypeAlias = tuple[tuple[float, float], tuple[float, float]]  # lower left and upper right corner
SQUARE: Box = ((0.0, 0.0), (1.0, 1.0))
# The Hessian of DD1 has full rank on its spike alone, which this box encloses.  Elsewhere DD1 is
# linear but for two kinks, which differences would take for curvature.
BOXES: dict[str, Box] = {"DD1": ((1.35 / 2.1, 0.25), (1.85 / 2.1, 0.75))}
NODES = tuple(50 * 2**k for k in range(6))
DIRECTED_NODES = NODES[1::2]
SHOWN = 400  # nodes of the meshes that are shown
DEGREE = 12  # degree of the quadrature that measures errors
LEAST_ANGLE = 20.0  # degrees


def ring(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """A steep front along a circle."""
    return np.tanh(20 * (np.hypot(x - 0.5, y - 0.5) - 0.3))


FUNCTIONS: dict[str, Function] = {
    "Franke": problems.functions["franke"],
    "SR3": problems.SR3,
    "DD1": problems.DD1,
    "ring": ring,
}
DIRECTED: dict[str, Function] = {
    "SR1": problems.SR1,
    "SR2": problems.SR2,
}  # functions that vary across a diagonal only


# -- the limit -----------------------------------------------------------------------------------


def hessians(function: Function, x: np.ndarray, y: np.ndarray, step: float = STEP) -> np.ndarray:
    """Second derivatives by central differences.

    Parameters
    ----------
    function : callable
    x, y : (n,) ndarray of float64
        Points at least ``step`` away from where the function is not defined.
    step : float

    Returns
    -------
    (n, 2, 2) ndarray of float64

    Examples
    --------
    >>> hessians(lambda x, y: x * x + x * y, np.array([0.5]), np.array([0.5])).round(3).tolist()
    [[[2.0, 1.0], [1.0, 0.0]]]
    """
    u = {(i, j): function(x + i * step, y + j * step) for i in (-1, 0, 1) for j in (-1, 0, 1)}
    xx = u[1, 0] - 2 * u[0, 0] + u[-1, 0]
    yy = u[0, 1] - 2 * u[0, 0] + u[0, -1]
    xy = (u[1, 1] - u[1, -1] - u[-1, 1] + u[-1, -1]) / 4
    return np.stack([xx, xy, xy, yy], axis=-1).reshape(*np.shape(x), 2, 2) / step**2


def constant(function: Function, box: Box = SQUARE, cells: int = CELLS) -> float:
    """The constant B of the limit: no mesh of T elements has an L2 error much below B / T.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    box : pair of corners
        A rectangle outside which the Hessian does not have full rank.
    cells : int
        Number of cells of the midpoint rule along a side.

    Returns
    -------
    float

    Examples
    --------
    >>> print(f"{constant(problems.functions['convex']):.4f} = {(4 / 45 * 4) ** 0.5:.4f}")
    0.5963 = 0.5963
    """
    low, high = np.array(box)
    size = (high - low) / cells
    x, y = np.meshgrid(*(low + size * (np.arange(cells)[:, None] + 0.5)).T)
    total = sum(_densities(function, *row).sum() for row in zip(x, y, strict=True))
    return float((total * size.prod()) ** 1.5)


def _densities(function: Function, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The cube root of c |det H|, to which the density of elements in a best mesh is proportional."""
    xx, xy, _, yy = hessians(function, x, y).reshape(-1, 4).T
    det = xx * yy - xy**2
    return np.cbrt(np.where(det > 0, DEFINITE, INDEFINITE) * np.abs(det))


@cache
def limit(name: str) -> float:
    """The constant B of one of `FUNCTIONS`."""
    return constant(FUNCTIONS[name], BOXES.get(name, SQUARE))


def error(mesh: Mesh, function: Function) -> float:
    """L2 error by a quadrature other than that of `approximate`."""
    return Interpolant(mesh, function).l2_error(function, rule="exact", degree=DEGREE)


def efficiency(mesh: Mesh, function: Function, bound: float) -> float:
    """The error times the number of elements, in units of the limit.

    Parameters
    ----------
    mesh : Mesh
    function : callable
    bound : float
        The constant B of the function.

    Returns
    -------
    float
        1 for a mesh as good as the best ones of very many elements.

    Examples
    --------
    >>> u = problems.functions["hyperbolic"]
    >>> round(efficiency(problems.mesh("81"), u, constant(u)), 6)
    1.0
    """
    return error(mesh, function) * mesh.n_elements / bound


# -- meshes --------------------------------------------------------------------------------------


@cache
def made(name: str, nodes: int = SHOWN, min_angle: float | None = None) -> Approximation:
    """The approximation of one of the functions; computed once in a process."""
    return approximate((FUNCTIONS | DIRECTED)[name], nodes=nodes, min_angle=min_angle)


def lattice(nodes: int) -> Mesh:
    """The Delaunay mesh of a square lattice with about the given number of nodes."""
    ticks = np.linspace(0, 1, round(nodes**0.5))
    return delaunay(np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2))


@cache
def efficiencies(name: str) -> np.ndarray:
    """Efficiencies of the meshes `made` for a function and of lattices, for all numbers of nodes.

    Returns
    -------
    (2, n) ndarray of float64
        Those of `made`, those of `lattice`.
    """
    u, bound = FUNCTIONS[name], limit(name)
    meshes = [(made(name, nodes).mesh, lattice(nodes)) for nodes in NODES]
    return np.array([[efficiency(mesh, u, bound) for mesh in pair] for pair in meshes]).T


# -- one direction -------------------------------------------------------------------------------


def strip_constant(function: Function, points: int = 100_000) -> float:
    """The constant K of parallel strips along a diagonal: m of them have the L2 error K / m^2.

    On a strip of width w the squared error of linear interpolation is f''^2 w^5 / 120 for each
    unit of its length.  The sum for m strips is least if all have the same share of it.

    Parameters
    ----------
    function : callable
        Constant along one of the diagonals of the unit square.
    points : int
        Number of points of the midpoint rule along the other diagonal.

    Returns
    -------
    float

    Examples
    --------
    >>> round(strip_constant(problems.SR2), 4)
    0.4347
    """
    t = (np.arange(points) + 0.5) / points
    h = hessians(function, t, t if _varies_upwards(function) else 1 - t)
    second = np.trace(h, axis1=1, axis2=2)  # the Laplacian: nothing is curved along the strip
    length = 2 * np.sqrt(2) * np.minimum(t, 1 - t)
    return float((np.sqrt(2) * np.mean((second**2 * length / 120) ** 0.2)) ** 2.5)


def _varies_upwards(function: Function) -> bool:
    """Whether the function varies from (0, 0) to (1, 1), and not from (0, 1) to (1, 0)."""
    return bool(abs(function(1.0, 1.0) - function(0.0, 0.0)) > abs(function(1.0, 0.0) - function(0.0, 1.0)))


def strip_error(function: Function, nodes: int) -> float:
    """L2 error of parallel strips with the given number of nodes, two for each strip and two more."""
    return strip_constant(function) / ((nodes - 2) / 2) ** 2


def over_strips(name: str) -> np.ndarray:
    """L2 errors of the meshes `made` for a function of `DIRECTED` over those of parallel strips."""
    u = DIRECTED[name]
    return np.array([error(made(name, n).mesh, u) / strip_error(u, n) for n in DIRECTED_NODES])


# -- terrain and a hole --------------------------------------------------------------------------

TERRAIN, TERRAIN_NODES = "jacksboro_fault_dem.npz", 1024  # sample data of matplotlib
HOLE_RADIUS, HOLE_SIDES, HOLE_NODES = 0.15, 32, 300
HOLE_CELLS = 10  # cells along a side of the start mesh around the hole


@dataclass(frozen=True)
class Terrain:
    """Heights on a grid and two surfaces that approximate them.

    Attributes
    ----------
    heights : (rows, columns) ndarray of float64
        Samples in metres, rows from south to north.
    made, regular : Interpolant
        The surface by `approximate`, and that on a lattice of samples.
    """

    heights: np.ndarray
    made: Interpolant
    regular: Interpolant

    def differences(self, surface: Interpolant) -> np.ndarray:
        """(rows, columns) float64: the surface minus the heights, at all samples."""
        rows, columns = self.heights.shape
        return surface(*np.meshgrid(np.arange(columns), np.arange(rows))) - self.heights


@cache
def terrain() -> Terrain:
    """Sample heights, approximated by a mesh made for them and on a lattice with as many nodes.

    Returns
    -------
    Terrain
    """
    from matplotlib.cbook import get_sample_data

    with np.load(get_sample_data(TERRAIN, asfileobj=False)) as data:
        heights = data["elevation"][::-1].astype(float)
    rows, columns = heights.shape
    found = approximate(heights, nodes=TERRAIN_NODES, domain=((0, 0), (columns - 1, rows - 1)))
    side = round(TERRAIN_NODES**0.5)
    x, y = (np.linspace(0, n - 1, side).round().astype(int) for n in (columns, rows))
    nodes = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    regular = Interpolant(delaunay(nodes), heights[nodes[:, 1], nodes[:, 0]])
    return Terrain(heights, found.interpolant, regular)


def stream(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Stream function of the flow around a disc in the middle of the unit square."""
    x, y = x - 0.5, y - 0.5
    return y * (1 - HOLE_RADIUS**2 / (x * x + y * y))


def square_with_hole() -> Mesh:
    """A mesh of the unit square without a regular polygon in its middle.

    Examples
    --------
    >>> mesh = square_with_hole()
    >>> holes = (mesh.n_elements - 2 * (mesh.n_nodes - 1) + mesh.boundary_nodes.sum()) // 2
    >>> int(holes)
    1
    """
    turn = 2 * np.pi * np.arange(HOLE_SIDES) / HOLE_SIDES
    rim = HOLE_RADIUS * np.column_stack([np.cos(turn), np.sin(turn)])
    ticks = np.linspace(-0.5, 0.5, HOLE_CELLS + 1)
    outer = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    outer = outer[np.hypot(*outer.T) > 1.2 * HOLE_RADIUS]
    whole = delaunay(np.concatenate([rim, outer]) + 0.5)
    return Mesh(whole.nodes, whole.elements[(whole.elements >= HOLE_SIDES).any(axis=1)]).validate()


@cache
def around_hole() -> Approximation:
    """The stream function approximated on the square with the hole."""
    return approximate(stream, nodes=HOLE_NODES, domain=square_with_hole())
