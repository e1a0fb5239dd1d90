"""Triangulations by brute force: slow, obvious, and sharing nothing with the library.

A triangulation is a frozenset of elements, an element a sorted tuple of node numbers.
Orientations are decided in rational arithmetic.
"""

from fractions import Fraction

import numpy as np

from meshlib import Mesh


def lattice(nx, ny):
    """The (nx + 1)(ny + 1) corners of nx times ny unit squares, row by row."""
    return np.array([(i, j) for j in range(ny + 1) for i in range(nx + 1)], dtype=float)


def polygon(n):
    """n points in strictly convex position, on a parabola, with integer coordinates."""
    return np.array([(i, i * i) for i in range(n)], dtype=float)


def rational(point):
    """The point with exact coordinates."""
    return tuple(Fraction(float(v)) for v in point)


def sign(value):
    return (value > 0) - (value < 0)


def exact_turn(a, b, c):
    """Sign of the turn a -> b -> c in rational arithmetic."""
    (ax, ay), (bx, by), (cx, cy) = map(rational, (a, b, c))
    return sign((bx - ax) * (cy - ay) - (cx - ax) * (by - ay))


def exact_circle(a, b, c, d):
    """+1 if d is inside the circle through the counter-clockwise a, b, c, in rationals."""
    d = rational(d)
    rows = [(p[0] - d[0], p[1] - d[1]) for p in map(rational, (a, b, c))]
    (ax, ay), (bx, by), (cx, cy) = rows
    p, q, r = (x * x + y * y for x, y in rows)
    return sign(p * (bx * cy - by * cx) + q * (cx * ay - cy * ax) + r * (ax * by - ay * bx))


def hull_area(nodes):
    """Area of the convex hull, by Andrew's monotone chain, as a Fraction."""
    points = sorted(map(rational, nodes))
    ring = _chain(points)[:-1] + _chain(points[::-1])[:-1]
    return sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)) / 2


def _chain(points):
    chain = []
    for p in points:
        while len(chain) > 1 and exact_turn(chain[-2], chain[-1], p) <= 0:
            chain.pop()
        chain.append(p)
    return chain


class Flips:
    """Flips of diagonals of strictly convex quadrilaterals, on given nodes."""

    def __init__(self, nodes):
        self.nodes, self._turns = np.asarray(nodes, dtype=float), {}

    def of(self, elements):
        """All triangulations one flip away."""
        opposite = {}
        for t in elements:
            for k in range(3):
                opposite.setdefault(t[:k] + t[k + 1 :], []).append(t[k])
        for (a, b), apexes in opposite.items():
            if len(apexes) == 2 and self._convex(a, b, *apexes):
                c, d = apexes
                old = {tuple(sorted((a, b, v))) for v in (c, d)}
                yield (elements - old) | {tuple(sorted((c, d, v))) for v in (a, b)}

    def reachable(self, start):
        """All triangulations that any number of flips leads to."""
        seen, waiting = {start}, [start]
        while waiting:
            new = set(self.of(waiting.pop())) - seen
            seen |= new
            waiting.extend(new)
        return seen

    def walk(self, elements, rng, steps):
        """A triangulation some random flips away."""
        for _ in range(steps):
            choices = sorted(map(sorted, self.of(elements)))
            if not choices:
                break
            elements = frozenset(choices[rng.integers(len(choices))])
        return elements

    def _convex(self, a, b, c, d):
        """Whether c-d crosses a-b strictly between its ends (and a-b crosses c-d)."""
        return self.turn(c, d, a) * self.turn(c, d, b) < 0

    def turn(self, a, b, c):
        if (a, b, c) not in self._turns:
            self._turns[a, b, c] = exact_turn(*self.nodes[[a, b, c]])
        return self._turns[a, b, c]

    def mesh(self, elements):
        """The triangulation as a validated Mesh."""
        rows = [t if self.turn(*t) > 0 else t[::-1] for t in sorted(elements)]
        return Mesh(self.nodes, rows).validate()


def as_set(mesh):
    """The elements of a mesh as a triangulation in the sense of this file."""
    return frozenset(tuple(sorted(t)) for t in mesh.elements.tolist())


def all_meshes(start):
    """Every triangulation of the nodes of a mesh of their convex hull."""
    flips = Flips(start.nodes)
    return [flips.mesh(t) for t in sorted(flips.reachable(as_set(start)), key=sorted)]


def shuffled(mesh, rng, steps=None, unit=None):
    """A mesh of the same nodes, some random flips away.

    What is collinear as decimal numbers seldom is as binary ones: with ``unit`` the nodes
    are taken for multiples of it, so that no element is flat but for rounding.
    """
    flips = Flips(mesh.nodes if unit is None else np.rint(mesh.nodes / unit))
    found = flips.mesh(flips.walk(as_set(mesh), rng, 3 * mesh.n_nodes if steps is None else steps))
    return Mesh(mesh.nodes, found.elements).validate()


def is_delaunay(mesh):
    """Whether no interior edge has the opposite node beyond it inside the circle: exact."""
    for t, s in mesh.edge_elements[~mesh.boundary].tolist():
        inner, outer = mesh.elements[t].tolist(), mesh.elements[s].tolist()
        (beyond,) = set(outer) - set(inner)
        if exact_circle(*mesh.nodes[inner], mesh.nodes[beyond]) > 0:
            return False
    return True
