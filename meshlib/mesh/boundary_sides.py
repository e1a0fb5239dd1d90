"""The straight sides of a domain, between the corners where its boundary turns."""

from dataclasses import dataclass, replace

import numpy as np

INTERIOR, CORNER = -1, -2
STRAIGHT = 1e-12  # sine of the angle below which the boundary goes straight on


@dataclass(frozen=True)
class Sides:
    """Sides of a domain.

    Attributes
    ----------
    of_node : (N,) ndarray of int
        The side of each node of the mesh given, INTERIOR or CORNER.
    ends : (S, 2, 2) ndarray of float
        First and last point of each side.
    corners : (S, 2) ndarray of int
        Their node numbers.
    """

    of_node: np.ndarray
    ends: np.ndarray
    corners: np.ndarray

    def of_edges(self, pairs, side):
        """The side of boundary edges given by node numbers, (m, 2); a corner is on two sides."""
        found = side[pairs].max(axis=1)
        between = np.flatnonzero(found == CORNER)
        known = {frozenset(ends): number for number, ends in enumerate(self.corners.tolist())}
        found[between] = [known[frozenset(pair)] for pair in pairs[between].tolist()]
        return found

    def renumbered(self, number):
        """The same sides when node n has become node number[n]."""
        return replace(self, corners=number[self.corners])

    def snapped(self, points, side):
        """Points moved onto their sides, where rounding has left them beside."""
        start, along = self.ends[side, 0], self.ends[side, 1] - self.ends[side, 0]
        share = ((points - start) * along).sum(axis=1) / (along**2).sum(axis=1)
        return start + share[:, None] * along


def sides_of(mesh):
    """The sides of the domain of a mesh.

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
    corners = []
    for start in np.flatnonzero(corner):
        for node in after[start]:
            while not corner[node]:
                of_node[node] = len(corners)
                node = after[node][0]
            corners.append((start, node))
    corners = np.array(corners).reshape(-1, 2)
    return Sides(of_node, mesh.nodes[corners], corners)


def _next_on_boundary(mesh):
    """For each node the nodes that follow it with the domain on the left."""
    after = [[] for _ in range(mesh.n_nodes)]
    t, k = np.nonzero(mesh.neighbours < 0)
    for tail, head in zip(mesh.elements[t, (k + 1) % 3], mesh.elements[t, (k + 2) % 3], strict=True):
        after[tail].append(int(head))
    return after


def _turns(mesh, after):
    """Whether the boundary turns at a node, or passes it more than once."""
    before = [[] for _ in after]
    for node, heads in enumerate(after):
        for head in heads:
            before[head].append(node)
    corner = np.zeros(mesh.n_nodes, dtype=bool)
    for node in np.flatnonzero(mesh.boundary_nodes):
        came, goes = (mesh.nodes[np.array(n[node])[:1]] for n in (before, after))
        here = mesh.nodes[node]
        corner[node] = len(after[node]) > 1 or not _is_straight(here - came[0], goes[0] - here)
    return corner


def _is_straight(u, v):
    return abs(u[0] * v[1] - u[1] * v[0]) <= STRAIGHT * np.hypot(*u) * np.hypot(*v) and u @ v > 0
