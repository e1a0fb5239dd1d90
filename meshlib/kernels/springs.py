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
def sweep(centres, edge_starts, neighbours, constants, element_starts, second, third, least, place):
    """Move every centre to its equilibrium, one after the other.

    ``place`` holds x and y of node after node.  Returns the largest movement and the
    number of moves refused.
    """
    largest, refused = 0.0, 0
    for n in centres:
        px, py = equilibrium(n, edge_starts, neighbours, constants, place)
        if tangles(n, px, py, element_starts, second, third, least, place):
            refused += 1
            continue
        largest = max(largest, hypot(px - place[2 * n], py - place[2 * n + 1]))
        place[2 * n], place[2 * n + 1] = px, py
    return largest, refused
