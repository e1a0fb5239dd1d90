r"""Values of u_h at the points of a regular grid, element by element, row by row.

A row of the grid cuts an element in the points between two of its sides::

              c
             / \
     - - - -o-o-o- - - - -   row j: the first point is right of c-a,
           /     \                  the last one left of b-c
          a-------b

A point on a side is set by both neighbours, to the same value but for rounding.
"""
from math import ceil, floor

from .backend import compiled

INSIDE = 1e-12  # barycentric coordinates this far below 0 still count as on the boundary
SLACK = 1e-12  # of a cell, by which the rounding of a crossing may miss a point


@compiled
def points_between(low, high, step, slack, count):
    """First and last of the points 0, step, ..., (count - 1) step from low to high."""
    return max(0, ceil(low / step - slack)), min(count - 1, floor(high / step + slack))


@compiled
def cut(px, py, qx, qy, y, room, low, high):
    """What the side p-q, with the element to its left, leaves of low..high at height y."""
    rise, over = qy - py, (qx - px) * (y - py) + room
    if rise > 0:
        return low, min(high, px + over / rise)
    if rise < 0:
        return max(low, px + over / rise), high
    return (low, high) if over >= 0 else (high, low - 1)


@compiled
def filled(grid, nx, ny, dx, dy, slack, order, element, x, y, u, gx, gy):
    """Set the grid, a flat list of ny rows of nx values with its first point at (0, 0).

    Elements come in the given order, so that later ones decide on common points.
    """
    for t in order:
        a, b, c = element[3 * t], element[3 * t + 1], element[3 * t + 2]
        left, right = min(x[a], x[b], x[c]), max(x[a], x[b], x[c])
        room = INSIDE * ((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]))
        first, last = points_between(min(y[a], y[b], y[c]), max(y[a], y[b], y[c]), dy, slack, ny)
        for j in range(first, last + 1):
            height = j * dy
            low, high = cut(x[a], y[a], x[b], y[b], height, room, left, right)
            low, high = cut(x[b], y[b], x[c], y[c], height, room, low, high)
            low, high = cut(x[c], y[c], x[a], y[a], height, room, low, high)
            start = u[a] + gy[t] * (height - y[a])
            i, end = points_between(low, high, dx, slack, nx)
            for k in range(i, end + 1):
                grid[j * nx + k] = start + gx[t] * (k * dx - x[a])
