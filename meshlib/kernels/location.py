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

from .backend import compiled
from .element_shapes import INSIDE, MOVED, is_flat, plane

SPAN = 1e-9  # of its extent, by which an element is looked for beyond its bounding box
NARROW = 3  # strips up to which an element is looked for between the same heights in each


@compiled
def first_not_below(values, begin, end, bound):
    """The first place in begin..end - 1 of ascending values with one of at least ``bound``, or ``end``."""
    while begin < end:
        middle = (begin + end) >> 1
        if values[middle] < bound:
            begin = middle + 1
        else:
            end = middle
    return begin


@compiled
def inner_heights(px, py, qx, qy, area, left, right):
    """Lower and upper bound, in left..right, of what lies to the left of p-q."""
    run, rise = qx - px, qy - py
    if run == 0:
        return -inf, inf
    first, last = py + rise / run * (left - px), py + rise / run * (right - px)
    room = 2 * INSIDE * area / abs(run)
    return (min(first, last) - room, inf) if run > 0 else (-inf, max(first, last) + room)


@compiled
def heights(ax, ay, bx, by, cx, cy, area, left, right):
    """Lower and upper bound, in left..right, of an element with its nodes in either sense."""
    if area < 0:
        area, bx, by, cx, cy = -area, cx, cy, bx, by
    l1, h1 = inner_heights(ax, ay, bx, by, area, left, right)
    l2, h2 = inner_heights(bx, by, cx, cy, area, left, right)
    l3, h3 = inner_heights(cx, cy, ax, ay, area, left, right)
    return max(l1, l2, l3), min(h1, h2, h3)


@compiled
def depth(px, py, ux, uy, vx, vy, area):
    """Smallest barycentric coordinate of a point p in an element with the sides u, v from its first node."""
    second, third = (px * vy - py * vx) / area, (ux * py - uy * px) / area
    return min(1 - second - third, second, third)


@compiled
def searched(x, y, size, edge, order, element, node, unit, best, found):
    """Set the deepest element of each point, of several the first; -1 before and where there is none.

    Strip s holds the points s size..(s + 1) size - 1, between edge[s] and edge[s + 1].
    ``best`` is room for the depth of each point, minus infinity before.  The order in
    which the elements come does not matter but for the memory.
    """
    for t in order:
        a, b, c = element[3 * t], element[3 * t + 1], element[3 * t + 2]
        ax, ay, bx, by, cx, cy = (
            node[2 * a],
            node[2 * a + 1],
            node[2 * b],
            node[2 * b + 1],
            node[2 * c],
            node[2 * c + 1],
        )
        ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
        area = ux * vy - uy * vx
        left, right, low, high = min(ax, bx, cx), max(ax, bx, cx), min(ay, by, cy), max(ay, by, cy)
        left, right = left - SPAN * (right - left), right + SPAN * (right - left)
        room = SPAN * (high - low) + MOVED * (abs(high) + abs(low))
        s = first = max(0, first_not_below(edge, 0, len(edge), left) - 1)
        wide = first + NARROW < len(edge) and edge[first + NARROW] <= right
        while s < len(edge) - 1 and edge[s] <= right and area != 0:
            lowest, highest = low, high
            if wide:
                lowest, highest = heights(
                    ax, ay, bx, by, cx, cy, area, max(left, edge[s]), min(right, edge[s + 1])
                )
            end = min(len(x), (s + 1) * size)
            p = first_not_below(y, s * size, end, max(low, lowest) - room)
            highest = min(high, highest) + room
            while p < end and y[p] <= highest:
                if left <= x[p] <= right:
                    deep = depth(x[p] - ax, y[p] - ay, ux, uy, vx, vy, area)
                    if deep >= -INSIDE and deep >= best[p]:
                        deep = -INSIDE if is_flat(node, a, b, c, unit) else deep
                        if deep > best[p] or (deep == best[p] and t < found[p]):
                            best[p], found[p] = deep, t
                p += 1
            s += 1


@compiled
def interpolated(x, y, found, element, node, u, value):
    """Set the values at points in known elements; what is outside, -1, stays."""
    for p in range(len(x)):
        if found[p] >= 0:
            a, b, c = element[3 * found[p]], element[3 * found[p] + 1], element[3 * found[p] + 2]
            ax, ay = node[2 * a], node[2 * a + 1]
            gx, gy = plane(
                node[2 * b] - ax,
                node[2 * b + 1] - ay,
                node[2 * c] - ax,
                node[2 * c + 1] - ay,
                u[b] - u[a],
                u[c] - u[a],
            )
            value[p] = u[a] + (gx * (x[p] - ax) + gy * (y[p] - ay))
