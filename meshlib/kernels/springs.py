"""One sweep of the spring analogy (section 2.3.3) over flat arrays."""

from math import hypot
from typing import NamedTuple

from .groups import Floats, Ints, Vector
from .marks import kernel

FLAT = 1e-12  # relative area below which an element counts as turned over


class Springs(NamedTuple):
    """The nodes that may move, and the springs of every node, node after node."""

    centres: Ints  # (C,) nodes that may move
    rails: Floats  # (4 C,) where the side starts on which each slides, and the vector along it; 0 if free
    starts: Ints  # (N + 1,) where the springs of each node start in the next two arrays
    neighbours: Ints  # node at the other end of each spring
    constants: Floats  # constant of each spring


class Patches(NamedTuple):
    """The elements around every node, node after node."""

    starts: Ints  # (N + 1,) where the elements of each node start in the next two arrays
    second: Ints  # the next node of each element
    third: Ints  # the one after


@kernel
def equilibrium(n: int, springs: Springs, place: Floats) -> Vector:
    """Mean of the neighbours of node n, weighted by their spring constants."""
    neighbours, constants = springs.neighbours, springs.constants
    total = px = py = 0.0
    for i in range(springs.starts[n], springs.starts[n + 1]):
        m = 2 * neighbours[i]
        total += constants[i]
        px += constants[i] * place[m]
        py += constants[i] * place[m + 1]
    return (px / total, py / total) if total > 0 else (place[2 * n], place[2 * n + 1])


@kernel
def on_rail(p: Vector, rails: Floats, i: int) -> Vector:
    """The point nearest to p of the side on which the i-th centre slides, or p itself if it is free."""
    x, y, dx, dy = rails[4 * i], rails[4 * i + 1], rails[4 * i + 2], rails[4 * i + 3]
    square = dx * dx + dy * dy
    if square == 0:
        return p
    share = ((p[0] - x) * dx + (p[1] - y) * dy) / square
    return x + share * dx, y + share * dy


@kernel
def tangles(n: int, p: Vector, patches: Patches, least: float, place: Floats) -> bool:
    """Whether node n at p makes an element of its patch too small or turns it over."""
    px, py = p
    second, third = patches.second, patches.third
    for i in range(patches.starts[n], patches.starts[n + 1]):
        b, c = 2 * second[i], 2 * third[i]
        left = (place[b] - px) * (place[c + 1] - py)
        right = (place[c] - px) * (place[b + 1] - py)
        area = left - right
        if area <= FLAT * (abs(left) + abs(right)) or area < least:
            return True
    return False


@kernel
def sweep(
    springs: Springs, patches: Patches, halvings: int, least: float, place: Floats
) -> tuple[float, int]:
    """Move every centre to its equilibrium, or as far towards it as halvings of the step allow.

    ``place`` holds x and y of node after node; ``least`` is twice the smallest area that is
    allowed.  Returns the largest movement and the number of moves refused.
    """
    largest, refused = 0.0, 0
    for i in range(len(springs.centres)):
        n = springs.centres[i]
        x, y = place[2 * n], place[2 * n + 1]
        p = on_rail(equilibrium(n, springs, place), springs.rails, i)
        left = halvings
        tangled = tangles(n, p, patches, least, place)
        while tangled and left > 0:
            p, left = (x + (p[0] - x) / 2, y + (p[1] - y) / 2), left - 1
            tangled = tangles(n, p, patches, least, place)
        if tangled:
            refused += 1
            continue
        largest = max(largest, hypot(p[0] - x, p[1] - y))
        place[2 * n], place[2 * n + 1] = p
    return largest, refused
