r"""The element of each point, element by element.

The points stand in strips, as many in each, and from bottom to top in each strip.
So crowded places have narrow strips, and an element finds its points by bisection::

    |  . |.  |   .|          of each strip that an element meets, it looks at the
    |    |/\ |  . |  . |     points between its lowest and highest place there
    | . /|. \|.   |    |
    |  /_|___\    | .  |
    |.   |   | .  |.   |
"""

from math import inf
from typing import NamedTuple

from .element_shapes import INSIDE, MOVED, corner, gradient, is_flat, minus
from .groups import Floats, Ints, Vector
from .marks import inlined, kernel

SPAN = 1e-9  # margin around the bounding box of an element, as a fraction of its extent
NARROW = 3  # number of strips up to which an element is looked for between the same heights in each


class Strips(NamedTuple):
    """Points from strip to strip, and from bottom to top in each strip."""

    x: Floats
    y: Floats
    size: int  # number of points in each strip but the last
    edge: Floats  # where each strip begins along x, and infinity


class Elements(NamedTuple):
    """The elements of a mesh, and the order in which they are taken."""

    order: Ints  # numbers of the elements; which order it is matters only for the use of memory
    nodes: Ints  # (3 T,) nodes of each element
    place: Floats  # (2 N,) coordinates of each node
    unit: float  # largest coordinate


class Search(NamedTuple):
    """What has been found for each point so far."""

    best: Floats  # depth, minus infinity at first
    found: Ints  # element, -1 at first


class Triangle(NamedTuple):
    """An element as it is looked for."""

    a: Vector
    b: Vector
    c: Vector
    area: float  # twice the signed area
    left: float
    right: float
    low: float
    high: float
    room: float  # margin above and below


@kernel
def first_not_below(values: Floats, begin: int, end: int, bound: float) -> int:
    """The first place in begin..end - 1 of ascending values with one of at least ``bound``, or ``end``."""
    while begin < end:
        middle = (begin + end) >> 1
        if values[middle] < bound:
            begin = middle + 1
        else:
            end = middle
    return begin


@kernel
def inner_heights(p: Vector, q: Vector, area: float, left: float, right: float) -> Vector:
    """Lower and upper bound, in left..right, of what lies to the left of p-q."""
    run, rise = minus(q, p)
    if run == 0:
        return -inf, inf
    first, last = p[1] + rise / run * (left - p[0]), p[1] + rise / run * (right - p[0])
    room = 2 * INSIDE * area / abs(run)
    return (min(first, last) - room, inf) if run > 0 else (-inf, max(first, last) + room)


@kernel
def heights(triangle: Triangle, left: float, right: float) -> Vector:
    """Lower and upper bound, in left..right, of an element with its nodes in either sense."""
    a, b, c, area = triangle.a, triangle.b, triangle.c, triangle.area
    if area < 0:
        area, b, c = -area, c, b
    l1, h1 = inner_heights(a, b, area, left, right)
    l2, h2 = inner_heights(b, c, area, left, right)
    l3, h3 = inner_heights(c, a, area, left, right)
    return max(l1, l2, l3), min(h1, h2, h3)


@kernel
def depth(p: Vector, triangle: Triangle) -> float:
    """Smallest barycentric coordinate of a point in an element."""
    p, u, v = minus(p, triangle.a), minus(triangle.b, triangle.a), minus(triangle.c, triangle.a)
    second = (p[0] * v[1] - p[1] * v[0]) / triangle.area
    third = (u[0] * p[1] - u[1] * p[0]) / triangle.area
    return min(1 - second - third, second, third)


@kernel
def triangle_of(t: int, elements: Elements) -> Triangle:
    """Element t with its bounding box and margins."""
    nodes, place = elements.nodes, elements.place
    a, b, c = corner(place, nodes[3 * t]), corner(place, nodes[3 * t + 1]), corner(place, nodes[3 * t + 2])
    u, v = minus(b, a), minus(c, a)
    left, right = min(a[0], b[0], c[0]), max(a[0], b[0], c[0])
    low, high = min(a[1], b[1], c[1]), max(a[1], b[1], c[1])
    room = SPAN * (high - low) + MOVED * (abs(high) + abs(low))
    span = SPAN * (right - left)
    return Triangle(a, b, c, u[0] * v[1] - u[1] * v[0], left - span, right + span, low, high, room)


@kernel
def searched(strips: Strips, elements: Elements, search: Search) -> None:
    """Set the deepest element of each point, of several the first; -1 where there is none."""
    edge = strips.edge
    for t in elements.order:
        triangle = triangle_of(t, elements)
        s = first = max(0, first_not_below(edge, 0, len(edge), triangle.left) - 1)
        wide = first + NARROW < len(edge) and edge[first + NARROW] <= triangle.right
        while s < len(edge) - 1 and edge[s] <= triangle.right and triangle.area != 0:
            search_strip(s, t, triangle, wide, strips, elements, search)
            s += 1


@inlined
def search_strip(s, t, triangle, wide, strips, elements, search):
    """Compare element t with the points of strip s at its height; in many strips, at its height in each."""
    lowest, highest = triangle.low, triangle.high
    if wide:
        left, right = max(triangle.left, strips.edge[s]), min(triangle.right, strips.edge[s + 1])
        lowest, highest = heights(triangle, left, right)
    x, y = strips.x, strips.y
    end = min(len(x), (s + 1) * strips.size)
    p = first_not_below(y, s * strips.size, end, max(triangle.low, lowest) - triangle.room)
    highest = min(triangle.high, highest) + triangle.room
    while p < end and y[p] <= highest:
        if triangle.left <= x[p] <= triangle.right:
            compare(p, t, triangle, strips, elements, search)
        p += 1


@inlined
def compare(p, t, triangle, strips, elements, search):
    """Set the element of point p to t if it is deeper in there, or as deep and t comes first."""
    best, found, nodes = search.best, search.found, elements.nodes
    deep = depth((strips.x[p], strips.y[p]), triangle)
    if deep >= -INSIDE and deep >= best[p]:
        corners = nodes[3 * t], nodes[3 * t + 1], nodes[3 * t + 2]
        deep = -INSIDE if is_flat(elements.place, corners, elements.unit) else deep
        if deep > best[p] or (deep == best[p] and t < found[p]):
            best[p], found[p] = deep, t


@kernel
def interpolated(strips: Strips, elements: Elements, found: Ints, u: Floats, value: Floats) -> None:
    """Set the values at points in known elements; what is outside, -1, stays."""
    x, y, nodes, place = strips.x, strips.y, elements.nodes, elements.place
    for p in range(len(x)):
        if found[p] >= 0:
            a, b, c = nodes[3 * found[p]], nodes[3 * found[p] + 1], nodes[3 * found[p] + 2]
            start = corner(place, a)
            first, second = minus(corner(place, b), start), minus(corner(place, c), start)
            area = first[0] * second[1] - first[1] * second[0]
            g = gradient(first, second, u[b] - u[a], u[c] - u[a], area)
            value[p] = u[a] + (g[0] * (x[p] - start[0]) + g[1] * (y[p] - start[1]))
