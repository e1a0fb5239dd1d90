"""One sweep of the spring analogy (section 2.3.3) over flat arrays."""
from math import hypot

from .backend import compiled

FLAT = 1e-12  # relative area below which an element counts as turned over


@compiled
def equilibrium(n, starts, neighbours, constants, x, y):
    """Mean of the neighbours of node n, weighted by their spring constants."""
    total = px = py = 0.0
    for i in range(starts[n], starts[n + 1]):
        total += constants[i]
        px += constants[i] * x[neighbours[i]]
        py += constants[i] * y[neighbours[i]]
    return (px / total, py / total) if total > 0 else (x[n], y[n])


@compiled
def tangles(n, px, py, starts, second, third, least, x, y):
    """Whether node n at (px, py) makes an element of its patch too small or turns it over."""
    for i in range(starts[n], starts[n + 1]):
        left = (x[second[i]] - px) * (y[third[i]] - py)
        right = (x[third[i]] - px) * (y[second[i]] - py)
        area = left - right
        if area <= FLAT * (abs(left) + abs(right)) or area < least:
            return True
    return False


@compiled
def sweep(centres, edge_starts, neighbours, constants, element_starts, second, third, least, x, y):
    """Move every centre to its equilibrium, one after the other.

    Returns the largest movement and the number of moves refused.
    """
    largest, refused = 0.0, 0
    for n in centres:
        px, py = equilibrium(n, edge_starts, neighbours, constants, x, y)
        if tangles(n, px, py, element_starts, second, third, least, x, y):
            refused += 1
            continue
        largest = max(largest, hypot(px - x[n], py - y[n]))
        x[n], y[n] = px, py
    return largest, refused
