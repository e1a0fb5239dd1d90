"""One sweep of the spring analogy (section 2.3.3) over flat arrays."""

from math import hypot

from .backend import compiled

FLAT = 1e-12  # relative area below which an element counts as turned over


@compiled
def equilibrium(n, starts, neighbours, constants, place):
    """Mean of the neighbours of node n, weighted by their spring constants."""
    total = px = py = 0.0
    for i in range(starts[n], starts[n + 1]):
        m = 2 * neighbours[i]
        total += constants[i]
        px += constants[i] * place[m]
        py += constants[i] * place[m + 1]
    return (px / total, py / total) if total > 0 else (place[2 * n], place[2 * n + 1])


@compiled
def on_rail(px, py, rails, i):
    """The point of the side along which the i-th node slides that is nearest to a point, or the point itself.

    A rail is where it starts, x and y, and what leads along it, zero if the node is free.
    """
    x, y, dx, dy = rails[4 * i], rails[4 * i + 1], rails[4 * i + 2], rails[4 * i + 3]
    square = dx * dx + dy * dy
    if square == 0:
        return px, py
    share = ((px - x) * dx + (py - y) * dy) / square
    return x + share * dx, y + share * dy


@compiled
def tangles(n, px, py, starts, second, third, least, place):
    """Whether node n at (px, py) makes an element of its patch too small or turns it over."""
    for i in range(starts[n], starts[n + 1]):
        b, c = 2 * second[i], 2 * third[i]
        left = (place[b] - px) * (place[c + 1] - py)
        right = (place[c] - px) * (place[b + 1] - py)
        area = left - right
        if area <= FLAT * (abs(left) + abs(right)) or area < least:
            return True
    return False


@compiled
def sweep(
    centres, rails, edge_starts, neighbours, constants, element_starts, second, third, halvings, least, place
):
    """Move every centre to its equilibrium, or as far towards it as halvings of the step allow.

    ``place`` holds x and y of node after node.  Returns the largest movement and the
    number of moves refused.
    """
    largest, refused = 0.0, 0
    for i in range(len(centres)):
        n = centres[i]
        x, y = place[2 * n], place[2 * n + 1]
        px, py = equilibrium(n, edge_starts, neighbours, constants, place)
        px, py = on_rail(px, py, rails, i)
        left = halvings
        tangled = tangles(n, px, py, element_starts, second, third, least, place)
        while tangled and left > 0:
            px, py, left = x + (px - x) / 2, y + (py - y) / 2, left - 1
            tangled = tangles(n, px, py, element_starts, second, third, least, place)
        if tangled:
            refused += 1
            continue
        largest = max(largest, hypot(px - x, py - y))
        place[2 * n], place[2 * n + 1] = px, py
    return largest, refused
