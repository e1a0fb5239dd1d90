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

from .backend import compiled
from .element_shapes import INSIDE, is_flat, plane

SLACK = 1e-12  # of a cell, by which the rounding of a crossing may miss a point


@compiled
def points_between(low, high, count):
    """First and last of the points 0, 1, ..., count - 1 from low to high."""
    first = int(low)  # rounded towards 0; faster than to round upwards
    return max(0, first + (first < low)), min(count - 1, floor(high))


@compiled
def side(x, run, rise, room, slack):
    """Slope of a side, and the lower and the upper bound that it sets at its start, x.

    A side that rises is a right one and has no lower bound; one that falls has no upper
    bound; a level one has neither, for no row beyond it is asked.
    """
    height = rise if abs(rise) > SLACK else inf
    start = x + room / height
    return run / height, start - slack if rise < -SLACK else -inf, start + slack if rise > SLACK else inf


@compiled
def painted(grid, first, last, value, slope, empty):
    """Set the points first..last of the flat grid; only those without a value if ``empty``."""
    if empty:
        for k in range(first, last + 1):
            if grid[k] != grid[k]:
                grid[k] = value + slope * (k - first)
    else:
        for k in range(first, last + 1):
            grid[k] = value + slope * (k - first)


@compiled
def filled(grid, nx, ny, low_x, low_y, dx, dy, slack, unit, element, node, u):
    """Set the grid, a flat list of ny rows of nx values, NaN before, with its first point at (low_x, low_y).

    Later elements decide on common points, flat ones only where no other has been.
    """
    for t in range(len(element) // 3):
        a, b, c = element[3 * t], element[3 * t + 1], element[3 * t + 2]
        ax, ay = (node[2 * a] - low_x) * dx, (node[2 * a + 1] - low_y) * dy
        ux, uy = (node[2 * b] - node[2 * a]) * dx, (node[2 * b + 1] - node[2 * a + 1]) * dy
        vx, vy = (node[2 * c] - node[2 * a]) * dx, (node[2 * c + 1] - node[2 * a + 1]) * dy
        left, right = ax + min(0.0, ux, vx) - slack, ax + max(0.0, ux, vx) + slack
        row, top = points_between(ay + min(0.0, uy, vy) - slack, ay + max(0.0, uy, vy) + slack, ny)
        i, end = points_between(left, right, nx)
        if row > top or i > end:
            continue
        det = ux * vy - uy * vx
        if det <= 0:
            continue
        empty = is_flat(node, a, b, c, unit)
        gx, gy = plane(ux, uy, vx, vy, u[b] - u[a], u[c] - u[a])
        room = INSIDE * det
        s1, l1, h1 = side(ax, ux, uy, room, slack)
        s2, l2, h2 = side(ax + ux, vx - ux, vy - uy, room, slack)
        s3, l3, h3 = side(ax, -vx, -vy, room, slack)
        for j in range(row, top + 1):
            p = j - ay
            first, second, third = s1 * p, s2 * (p - uy), s3 * p
            low = max(max(left, first + l1), max(second + l2, third + l3))
            high = min(min(right, first + h1), min(second + h2, third + h3))
            i, end = points_between(low, high, nx)
            painted(grid, j * nx + i, j * nx + end, u[a] + gy * p + gx * (i - ax), gx, empty)
