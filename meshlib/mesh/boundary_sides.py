"""The straight sides of a domain, between the corners where its boundary turns."""

from dataclasses import dataclass, replace

import numpy as np

from .._typing import AnyMesh, BoolArray, FloatArray, IntArray

INTERIOR, CORNER = -1, -2  # in place of the side of a node that lies on none, or on two


@dataclass(frozen=True)
class Sides:
    """Straight sides of a domain.

    Attributes
    ----------
    of_node : (N,) ndarray of int
        Number of the side on which each node lies, or INTERIOR or CORNER.
    ends : (S, 2, 2) ndarray of float
        First and last point of each side, with the domain on the left.
    corners : (S, 2) ndarray of int
        Node numbers of the first and the last point.
    """

    of_node: IntArray
    ends: FloatArray
    corners: IntArray

    def of_edges(self, pairs: IntArray, side: IntArray) -> IntArray:
        """Number of the side on which each boundary edge lies.

        ``pairs``, (m, 2), are the nodes of the edges, ``side`` the side of each node; an edge
        between two corners is a whole side.
        """
        found = side[pairs].max(axis=1)
        between = np.flatnonzero(found == CORNER)
        known = {frozenset(ends): number for number, ends in enumerate(self.corners.tolist())}
        found[between] = [known[frozenset(pair)] for pair in pairs[between].tolist()]
        return found

    def renumbered(self, number: IntArray) -> "Sides":
        """Sides of a mesh in which node n has become node number[n]."""
        return replace(self, corners=number[self.corners])

    def snapped(self, points: FloatArray, side: IntArray) -> FloatArray:
        """Points, (m, 2), that rounding has moved off their sides, moved back to the nearest point there."""
        start, along = self.ends[side, 0], self.ends[side, 1] - self.ends[side, 0]
        share = ((points - start) * along).sum(axis=1) / (along**2).sum(axis=1)
        return np.asarray(start + share[:, None] * along)


def sides_of(mesh: AnyMesh) -> Sides:
    """The straight sides of the domain of a mesh.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> sides = sides_of(delaunay([[0, 0], [0.5, 0], [1, 0], [1, 1], [0, 1]]))
    >>> sides.of_node.tolist(), sides.corners.tolist()
    ([-2, 0, -2, -2, -2], [[0, 2], [2, 3], [3, 4], [4, 0]])
    """
    after = _next_on_boundary(mesh)
    corner = _turns(mesh, after)
    of_node = np.where(mesh.boundary_nodes, CORNER, INTERIOR)
    found: list[tuple[int, int]] = []
    for start in np.flatnonzero(corner).tolist():
        for node in after[start]:
            while not corner[node]:
                of_node[node] = len(found)
                node = after[node][0]
            found.append((start, node))
    corners = np.array(found).reshape(-1, 2)
    return Sides(of_node, mesh.nodes[corners], corners)


def _next_on_boundary(mesh: AnyMesh) -> list[list[int]]:
    """For each node the nodes that follow it on the boundary, with the domain on the left."""
    after: list[list[int]] = [[] for _ in range(mesh.n_nodes)]
    t, k = np.nonzero(mesh.neighbours < 0)
    for tail, head in zip(mesh.elements[t, (k + 1) % 3], mesh.elements[t, (k + 2) % 3], strict=True):
        after[tail].append(int(head))
    return after


def _turns(mesh: AnyMesh, after: list[list[int]]) -> BoolArray:
    """Whether the boundary turns at each node, or passes it more than once."""
    before: list[list[int]] = [[] for _ in after]
    for node, heads in enumerate(after):
        for head in heads:
            before[head].append(node)
    corner = np.zeros(mesh.n_nodes, dtype=bool)
    for node in np.flatnonzero(mesh.boundary_nodes).tolist():
        came, goes = (mesh.nodes[np.array(n[node])[:1]] for n in (before, after))
        here = mesh.nodes[node]
        corner[node] = len(after[node]) > 1 or not _is_straight(here - came[0], goes[0] - here)
    return corner


def _is_straight(u: FloatArray, v: FloatArray, least_sine: float = 1e-12) -> bool:
    """Whether v goes on in the direction of u: the sine of the angle between them is below ``least_sine``."""
    cross = abs(u[0] * v[1] - u[1] * v[0])
    return bool(cross <= least_sine * np.hypot(*u) * np.hypot(*v) and u @ v > 0)
