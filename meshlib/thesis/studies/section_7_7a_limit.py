"""The limit of piecewise linear interpolation (section 7.7), and how near meshes come to it."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Interpolant, Mesh, approximate, delaunay, problems

DEFINITE, INDEFINITE = 4 / 45, 1 / 90  # squared error of the best element / (|det H| area^3)
ZIGZAG = 0.75  # error of the best strips that meet the boundary half a strip apart / of parallel strips
STEP = 3e-5  # of differences for second derivatives
CELLS = 1000  # along a side, for the integral of the Hessian
SQUARE = ((0.0, 0.0), (1.0, 1.0))
# Where the Hessian of DD1 has full rank: the box around its spike.  Elsewhere it is linear but for
# two kinks, which differences would take for curvature.
BOXES = {"DD1": ((1.35 / 2.1, 0.25), (1.85 / 2.1, 0.75))}

NODES = tuple(50 * 2**k for k in range(6))
DIRECTED_NODES = NODES[1::2]
SHOWN = 400  # nodes of meshes to look at
DEGREE = 12  # of the quadrature that measures
LEAST_ANGLE = 20.0  # degrees


def ring(x, y):
    """A steep front along a circle."""
    return np.tanh(20 * (np.hypot(x - 0.5, y - 0.5) - 0.3))


FUNCTIONS = {"Franke": problems.functions["franke"], "SR3": problems.SR3, "DD1": problems.DD1, "ring": ring}
DIRECTED = {"SR1": problems.SR1, "SR2": problems.SR2}  # that vary in one direction only, across a diagonal


# -- the limit -----------------------------------------------------------------------------------


def hessians(function, x, y, step=STEP):
    """Second derivatives by central differences.

    Parameters
    ----------
    function : callable
    x, y : (n,) ndarray of float64
        At a distance of ``step`` or more from where the function is not defined.
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


def constant(function, box=SQUARE, cells=CELLS):
    """The constant B of the limit: no mesh of T elements has an L2 error much below B / T.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    box : pair of corners
        Of a rectangle outside which the Hessian has no full rank.
    cells : int
        Of the midpoint rule, along a side.

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


def _densities(function, x, y):
    """The cube root of c |det H|, the density of elements in a best mesh but for a factor."""
    xx, xy, _, yy = hessians(function, x, y).reshape(-1, 4).T
    det = xx * yy - xy**2
    return np.cbrt(np.where(det > 0, DEFINITE, INDEFINITE) * np.abs(det))


@cache
def limit(name):
    """The constant B of one of `FUNCTIONS`."""
    return constant(FUNCTIONS[name], BOXES.get(name, SQUARE))


def error(mesh, function):
    """L2 error by a quadrature that is not the one of `approximate`."""
    return Interpolant(mesh, function).l2_error(function, rule="exact", degree=DEGREE)


def efficiency(mesh, function, bound):
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
def made(name, nodes=SHOWN, min_angle=None):
    """The approximation of one of the functions; made once in a process."""
    return approximate((FUNCTIONS | DIRECTED)[name], nodes=nodes, min_angle=min_angle)


def lattice(nodes):
    """The Delaunay mesh of a square lattice of about so many nodes."""
    ticks = np.linspace(0, 1, round(nodes**0.5))
    return delaunay(np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2))


@cache
def efficiencies(name):
    """What `made` and `lattice` reach for all numbers of nodes.

    Returns
    -------
    made, lattice : (n,) ndarray of float64
    """
    u, bound = FUNCTIONS[name], limit(name)
    meshes = [(made(name, nodes).mesh, lattice(nodes)) for nodes in NODES]
    return np.array([[efficiency(mesh, u, bound) for mesh in pair] for pair in meshes]).T


# -- one direction -------------------------------------------------------------------------------


def strip_constant(function, points=100_000):
    r"""K of a function of the distance from a diagonal: the error of m parallel strips is K / m^2.

    On a strip of width w the squared error of linear interpolation is f''^2 w^5 / 120 for each
    unit of its length.  It is least, for m strips, if all have the same share of it.

    Parameters
    ----------
    function : callable
        Constant along one of the diagonals of the unit square.
    points : int
        Of the midpoint rule along the other diagonal.

    Returns
    -------
    float

    Examples
    --------
    >>> round(strip_constant(problems.SR2), 4)
    0.4347
    """
    t = (np.arange(points) + 0.5) / points
    h = hessians(function, t, t if _falls_along(function) else 1 - t)
    second = np.trace(h, axis1=1, axis2=2)  # the Laplacian: nothing is curved along the strip
    length = 2 * np.sqrt(2) * np.minimum(t, 1 - t)
    return float((np.sqrt(2) * np.mean((second**2 * length / 120) ** 0.2)) ** 2.5)


def _falls_along(function):
    """Whether it varies from (0, 0) to (1, 1), and not from (0, 1) to (1, 0)."""
    return bool(abs(function(1.0, 1.0) - function(0.0, 0.0)) > abs(function(1.0, 0.0) - function(0.0, 1.0)))


def strip_error(function, nodes):
    """Error of the mesh of parallel strips that has so many nodes, two for each strip and two more."""
    return strip_constant(function) / ((nodes - 2) / 2) ** 2


# -- terrain and a hole --------------------------------------------------------------------------

TERRAIN, TERRAIN_NODES = "jacksboro_fault_dem.npz", 1024  # sample data of matplotlib
HOLE_RADIUS, HOLE_SIDES, HOLE_NODES = 0.15, 32, 300
HOLE_CELLS = 10  # along a side of its first mesh


@dataclass(frozen=True)
class Terrain:
    """Heights on a grid, in metres, rows from south to north, and meshes for them.

    Attributes
    ----------
    heights : (rows, columns) ndarray of float64
    made, regular : Interpolant
        By `approximate`, and on every so many samples.
    """

    heights: np.ndarray
    made: Interpolant
    regular: Interpolant

    def differences(self, surface):
        """Surface less heights at all samples."""
        rows, columns = self.heights.shape
        return surface(*np.meshgrid(np.arange(columns), np.arange(rows))) - self.heights


@cache
def terrain():
    """The sample heights, approximated and on a lattice with as many nodes.

    Returns
    -------
    Terrain
    """
    from matplotlib.cbook import get_sample_data

    with get_sample_data(TERRAIN) as data:
        heights = data["elevation"][::-1].astype(float)
    rows, columns = heights.shape
    found = approximate(heights, nodes=TERRAIN_NODES, domain=((0, 0), (columns - 1, rows - 1)))
    side = round(TERRAIN_NODES**0.5)
    x, y = (np.linspace(0, n - 1, side).round().astype(int) for n in (columns, rows))
    nodes = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    regular = Interpolant(delaunay(nodes), heights[nodes[:, 1], nodes[:, 0]])
    return Terrain(heights, found.interpolant, regular)


def stream(x, y):
    """Stream function of the flow around a disc in the middle of the unit square."""
    x, y = x - 0.5, y - 0.5
    return y * (1 - HOLE_RADIUS**2 / (x * x + y * y))


def square_with_hole():
    """The unit square without a regular polygon in its middle.

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
def around_hole():
    """The stream function approximated on the square with the hole."""
    return approximate(stream, nodes=HOLE_NODES, domain=square_with_hole())
