"""User-defined cost functions in the form that kernels call: a function of four points.

A point is three numbers x, y, u.  The four are the ends of an edge and the nodes to its
left and right, or the corners of an element and the first of them once more.  Such a
function is called so often that it is worth compiling even for a small mesh.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from math import sqrt
from typing import Any

import numpy as np

from .._typing import FloatArray
from . import ANY, for_work
from .backend import Plain
from .groups import Point, UserCost

KEPT = 128  # compiled functions that are kept for the next use


def pointer(maker: Callable[[], Callable[..., float]], on: str) -> Any:
    """The function that ``maker`` returns in the form for kernels, or None if numba cannot compile it."""
    return _pointer(maker, on, for_work(ANY))


@lru_cache(maxsize=KEPT)
def _pointer(maker: Callable[[], Callable[..., float]], on: str, kernels: Plain) -> Any:
    cost = kernels.inner(maker())
    return kernels.pointer(_of_edge(cost) if on == "edge" else _of_element(cost))


def _of_edge(cost: Callable[..., float]) -> UserCost:
    def of_points(p: Point, q: Point, left: Point, right: Point) -> float:
        return cost(*p, *q, *left, *right)

    return of_points


def _of_element(cost: Callable[..., float]) -> UserCost:
    def of_points(a: Point, b: Point, c: Point, _: Point) -> float:
        return cost(*a, *b, *c)

    return of_points


def error_of(
    function: Callable[[float, float], float], points: Sequence[Point], weights: Sequence[float]
) -> Callable[..., float]:
    """The L2 norm of u - u_h on one element, by quadrature, as a function of its three points."""
    u = for_work(ANY).inner(function)

    def error(
        ax: float, ay: float, au: float, bx: float, by: float, bu: float, cx: float, cy: float, cu: float
    ) -> float:
        total = 0.0
        for k in range(len(weights)):
            p, q, r = points[k]
            miss = u(p * ax + q * bx + r * cx, p * ay + q * by + r * cy) - (p * au + q * bu + r * cu)
            total += weights[k] * miss * miss
        return sqrt(abs((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2 * total)

    return error


def evaluated(given: Any, points: FloatArray) -> FloatArray:
    """The cost of each four points, which stand in rows of twelve numbers."""
    kernels = for_work(ANY)
    costs = kernels.writable(np.zeros(len(points)))
    kernels.costs.evaluated(given, kernels.readable(points), costs)
    return np.asarray(costs)
