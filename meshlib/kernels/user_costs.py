"""Cost functions of one's own in the form that kernels call: a function of four points.

A point is three numbers x, y, u.  The four are the ends of an edge and the nodes to its
left and right, or the corners of an element and the first of them once more.
"""

from functools import lru_cache
from math import sqrt

from .backend import callable_from_kernels, compiled, inner
from .costs import own_cost

KEPT = 128  # functions compiled before


@lru_cache(maxsize=KEPT)
def pointer(maker, on):
    """The function that ``maker`` returns in the form for kernels, or None if numba cannot compile it."""
    cost = inner(maker())
    return callable_from_kernels(cost if on == "edge" else _of_four_points(cost), 12)


def _of_four_points(cost):
    def padded(ax, ay, au, bx, by, bu, cx, cy, cu, _x, _y, _u):
        return cost(ax, ay, au, bx, by, bu, cx, cy, cu)

    return padded


def error_of(function, points, weights):
    """The L2 norm of u - u_h on one element, by quadrature, as a function of its three points."""
    u = inner(function)

    def error(ax, ay, au, bx, by, bu, cx, cy, cu):
        total = 0.0
        for k in range(len(weights)):
            p, q, r = points[k]
            miss = u(p * ax + q * bx + r * cx, p * ay + q * by + r * cy) - (p * au + q * bu + r * cu)
            total += weights[k] * miss * miss
        return sqrt(abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2 * total)

    return error


@compiled
def evaluated(given, points, costs):
    """Set the cost of each four points, which stand in rows of twelve numbers."""
    for n in range(len(costs)):
        costs[n] = own_cost(given, points, 4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3)
