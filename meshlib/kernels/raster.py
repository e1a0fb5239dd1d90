r"""Values of u_h at the points of a regular grid, element by element, row by row.

Points of the grid have whole coordinates here: lengths are measured in its cells.
A row of the grid cuts an element in the points between two of its sides::

              c
             / \
     - - - -o-o-o- - - - -   row j: the first point is right of c-a,
           /     \                  the last one left of b-c
          a-------b

A point on a side is set by both neighbours, to the same value but for rounding.
"""

from math import floor, inf
from typing import NamedTuple

from .element_shapes import INSIDE, corner, gradient, is_flat, minus
from .groups import Corners, Floats, Ints, Vector
from .marks import inlined, kernel

SLACK = 1e-12  # error of a crossing that may miss a point, as a fraction of a cell


class Grid(NamedTuple):
    """A regular grid of points, row by row from below."""

    values: Floats  # (ny nx,) NaN at first
    nx: int  # number of points along x
    ny: int  # number of points along y
    low: Vector  # first point
    cells: Vector  # number of cells in a unit of length along x and y
    slack: float  # error of a crossing, as a fraction of a cell


class Outline(NamedTuple):
    """An element in cells of the grid."""

    a: Vector  # first corner
    u: Vector  # from there to the second
    v: Vector  # from there to the third
    left: float
    right: float
    bottom: float
    top: float


@kernel
def points_between(low: float, high: float, count: int) -> tuple[int, int]:
    """First and last of the points 0, 1, ..., count - 1 from low to high."""
    first = int(low)  # rounded towards 0; faster than to round upwards
    return max(0, first + (first < low)), min(count - 1, floor(high))


@kernel
def side(x: float, along: Vector, room: float, slack: float) -> tuple[float, float, float]:
    """Slope of a side, and the lower and the upper bound that it sets at its start, x.

    A side that rises is a right one and has no lower bound; one that falls has no upper
    bound; a level one has neither, for no row beyond it is asked.
    """
    run, rise = along
    height = rise if abs(rise) > SLACK else inf
    start = x + room / height
    return run / height, start - slack if rise < -SLACK else -inf, start + slack if rise > SLACK else inf


@kernel
def painted(values: Floats, points: tuple[int, int], value: float, slope: float, empty: bool) -> None:
    """Set the points first..last of the flat grid; only those without a value if ``empty``."""
    first, last = points
    if empty:
        for k in range(first, last + 1):
            if values[k] != values[k]:
                values[k] = value + slope * (k - first)
    else:
        for k in range(first, last + 1):
            values[k] = value + slope * (k - first)


@kernel
def scaled(p: Vector, cells: Vector) -> Vector:
    """A vector in cells of the grid."""
    return p[0] * cells[0], p[1] * cells[1]


@kernel
def outline(node: Floats, corners: Corners, grid: Grid) -> Outline:
    """An element in cells of the grid, and its bounding box, larger by the slack."""
    a, b, c = corner(node, corners[0]), corner(node, corners[1]), corner(node, corners[2])
    x, y = scaled(minus(a, grid.low), grid.cells)
    u, v, slack = scaled(minus(b, a), grid.cells), scaled(minus(c, a), grid.cells), grid.slack
    left, right = x + min(0.0, u[0], v[0]) - slack, x + max(0.0, u[0], v[0]) + slack
    bottom, top = y + min(0.0, u[1], v[1]) - slack, y + max(0.0, u[1], v[1]) + slack
    return Outline((x, y), u, v, left, right, bottom, top)


@kernel
def filled(grid: Grid, element: Ints, node: Floats, u: Floats, unit: float) -> None:
    """Set the values of the grid; ``unit`` is the largest coordinate of the mesh.

    Later elements decide on common points, flat ones only where no other has been.
    """
    for t in range(len(element) // 3):
        corners = element[3 * t], element[3 * t + 1], element[3 * t + 2]
        shape = outline(node, corners, grid)
        row, top = points_between(shape.bottom, shape.top, grid.ny)
        i, end = points_between(shape.left, shape.right, grid.nx)
        area = shape.u[0] * shape.v[1] - shape.u[1] * shape.v[0]
        if row > top or i > end or area <= 0:
            continue
        a, b, c = corners
        g = gradient(shape.u, shape.v, u[b] - u[a], u[c] - u[a], area)
        fill_rows(grid, shape, (row, top), (g[0], g[1], u[a]), INSIDE * area, is_flat(node, corners, unit))


@inlined
def fill_rows(grid, shape, rows, plane, room, empty):
    """Set the points of an element, given the plane by its gradient and its value at the first corner."""
    a, u, v, left, right, _, _ = shape
    s1, l1, h1 = side(a[0], u, room, grid.slack)
    s2, l2, h2 = side(a[0] + u[0], (v[0] - u[0], v[1] - u[1]), room, grid.slack)
    s3, l3, h3 = side(a[0], (-v[0], -v[1]), room, grid.slack)
    for j in range(rows[0], rows[1] + 1):
        p = j - a[1]
        first, second, third = s1 * p, s2 * (p - u[1]), s3 * p
        low = max(left, first + l1, second + l2, third + l3)
        high = min(right, first + h1, second + h2, third + h3)
        i, end = points_between(low, high, grid.nx)
        value = plane[2] + plane[1] * p + plane[0] * (i - a[0])
        painted(grid.values, (j * grid.nx + i, j * grid.nx + end), value, plane[0], empty)
