r"""The error of a patch as a function of the position of its middle node: value, slope and curvature.

With e = u_h - u and the node p moved by v, u_h changes at a fixed point by
phi_p (grad u(p) - grad u_h) . v, and so the squared error by the sum over the elements of

    2 (integral of e phi_p) (grad u(p) - grad u_h) . v .

The curvature is that of the error of a quadratic function, area / 720 times
(sum of d^2 + (sum of d)^2) with d = e' H e for each edge e.

All is written in the frame of a patch, two directions in which it is round.
"""

import numpy as np

from ..interpolation.interpolant import gradients
from ..mesh.boundary_sides import INTERIOR
from .collapse import beside


class Patches:
    """Patches without a common element.

    Attributes
    ----------
    points, values : (N, 2), (N,) ndarray of float
        Positions of all nodes, some of them moved already, and the function there.
    nodes : (n,) ndarray of int
        Their middle nodes.
    element, k, row : (m,) ndarray of int
        All their elements, which corner of each is the middle node, and the patch of each.
    error : (n,) ndarray of float
        With the weighted error along the boundary.
    """

    def __init__(self, sweep, nodes):
        self.draft, self.points, self.values = sweep.draft, sweep.nodes, sweep.values
        corner, self.row = sweep.patches.of(nodes)
        self.nodes = nodes
        self.element, self.k = corner // 3, corner % 3
        self.starts = np.flatnonzero(np.diff(self.row, prepend=-1))
        self.rows = self.draft.elements[self.element]
        self.bound = np.flatnonzero(self.draft.side[nodes] != INTERIOR)
        self.beside = (
            beside(self.draft, nodes[self.bound]) if len(self.bound) else np.empty((0, 2), dtype=int)
        )
        self.moments = sweep.moments[self.element, self.k]
        self.on_sides, self.side_moments = self._along_sides(self.points[nodes], self.values[nodes])
        self.error = np.add.reduceat(sweep.errors[self.element], self.starts) + self.on_sides

    def moved(self, at, values):
        """Error of each patch with its node there, and errors and moments of the elements."""
        corners, nodal = self.points[self.rows], self.values[self.rows]
        place = np.arange(len(self.row)), self.k
        corners[place], nodal[place] = at[self.row], values[self.row]
        errors, moments = self.draft.misfit.moments(corners, nodal)
        return np.add.reduceat(errors, self.starts) + self._along_sides(at, values)[0], errors, moments

    def _along_sides(self, at, values):
        """Weighted error along the boundary for each patch, and the moments of its two edges, (bound, 2)."""
        total, moments = np.zeros(len(self.nodes)), np.zeros((len(self.bound), 2))
        for j, node in enumerate(self.beside.T):
            ends = np.stack([at[self.bound], self.points[node]], axis=1)
            nodal = np.stack([values[self.bound], self.values[node]], axis=1)
            error, moment = self.draft.misfit.moments_on_edges(ends, nodal)
            total[self.bound] += self.draft.weight * error
            moments[:, j] = self.draft.weight * moment[:, 0]
        return total, moments

    def kept_on_sides(self, at):
        """Points moved onto the side of their node."""
        at[self.bound] = self.draft.boundary.snapped(at[self.bound], self.draft.side[self.nodes[self.bound]])
        return at

    def frames(self, away, row):
        """Two directions for each patch as long as its extent, (n, 2, 2); the first along a side if on it."""
        away = self.points[away] - self.points[self.nodes][row]
        spread = [np.bincount(row, away[:, i] * away[:, j]) for i, j in ((0, 0), (0, 1), (1, 1))]
        count = np.bincount(row)[:, None]
        matrix = np.stack([spread[0], spread[1], spread[1], spread[2]], axis=1) / count
        size, axes = np.linalg.eigh(matrix.reshape(-1, 2, 2))
        frames = np.sqrt(size.clip(min=0))[:, :, None] * axes.transpose(0, 2, 1)
        middle = np.stack([np.bincount(row, x) for x in away.T], axis=1) / count
        frames[self.bound] = self._side_frames(middle[self.bound])
        return frames

    def _side_frames(self, middle):
        here = self.points[self.nodes[self.bound]]
        away = self.points[self.beside] - here[:, None]
        nearest = np.sqrt((away**2).sum(axis=2)).min(axis=1)[:, None]
        ends = self.draft.boundary.ends[self.draft.side[self.nodes[self.bound]]]
        along = ends[:, 1] - ends[:, 0]
        along /= np.hypot(*along.T)[:, None]
        inward = middle - (middle * along).sum(axis=1, keepdims=True) * along
        return np.stack([nearest * along, inward], axis=1)

    def model(self, frames):
        """Slope (n, 2) and curvature (n, 2, 2) of the error in the frame of each patch."""
        slope, hessian = self._differences(frames)
        y, z, size = self._arms(frames)
        gradient = self._gradients(y, z)
        force = 2 * self.moments[:, None] * (slope[self.row] - gradient)
        curvature = size[:, None, None] * _curvature(y, z, hessian[self.row])
        total = np.add.reduceat(force, self.starts), np.add.reduceat(curvature, self.starts)
        force, curvature = self._with_sides(frames, slope, hessian, *total)
        areas = np.add.reduceat(size * _cross(y, z) / 2, self.starts)
        return force, curvature * self._steepness(areas)[:, None, None]

    def _steepness(self, areas):
        """How much more a power of the error curves than its square: p / 2 times the mean of |e|^(p - 2)."""
        power = 2**self.draft.misfit.squarings
        return power / 2 * (self.error / areas) ** (1 - 2 / power)

    def _differences(self, frames):
        """First and second differences of the function in the frame, about a point inside the domain."""
        probe = self.draft.settings.moves.probe
        u, v = probe * frames[:, 0], probe * frames[:, 1]
        centre = self.points[self.nodes].copy()
        centre[self.bound] += v[self.bound]
        places = np.concatenate([centre, centre + u, centre - u, centre + v, centre - v, centre + u + v])
        here, right, left, up, down, both = self.draft.misfit.values(*places.T.copy()).reshape(6, -1)
        mixed = both - right - up + here
        hessian = np.stack([right + left - 2 * here, mixed, mixed, up + down - 2 * here], axis=1) / probe**2
        slope = np.stack([right - left, up - down], axis=1) / (2 * probe)
        slope[self.bound] -= probe * hessian[self.bound][:, [1, 3]]
        return slope, hessian.reshape(-1, 2, 2)

    def _arms(self, frames):
        """From the middle to the other two corners of each element, in the frame, and the frame's area."""
        here = self.points[self.nodes][self.row]
        pair = [self.points[self._corner(shift)] - here for shift in (1, 2)]
        u, v = frames[self.row, 0], frames[self.row, 1]
        area = _cross(u, v)
        return *(np.stack([_cross(x, v), _cross(u, x)], axis=1) / area[:, None] for x in pair), area

    def _corner(self, shift):
        return self.rows[np.arange(len(self.rows)), (self.k + shift) % 3]

    def _gradients(self, y, z):
        """Gradient of the interpolant on each element, in the frame."""
        nodes = np.take_along_axis(self.rows, (self.k[:, None] + np.arange(3)) % 3, axis=1)
        return gradients(np.stack([np.zeros_like(y), y, z], axis=1), self.values[nodes])

    def _with_sides(self, frames, slope, hessian, force, curvature):
        """Nodes on a side have one direction only, and the error along it counts as well."""
        bound, here = self.bound, self.points[self.nodes[self.bound]]
        length = np.hypot(*frames[bound, 0].T)
        force[bound, 1] = 0
        curvature[bound, 0, 1] = curvature[bound, 1, 0] = 0
        curvature[bound, 1, 1] = np.abs(curvature[bound, 1, 1]) + np.abs(curvature[bound, 0, 0])
        for j, node in enumerate(self.beside.T):
            away = ((self.points[node] - here) * frames[bound, 0]).sum(axis=1) / length**2
            chord = (self.values[node] - self.values[self.nodes[bound]]) / away
            force[bound, 0] += 2 * self.side_moments[:, j] * (slope[bound, 0] - chord)
            curvature[bound, 0, 0] += (
                self.draft.weight * length * hessian[bound, 0, 0] ** 2 * np.abs(away) ** 3 / 6
            )
        return force, curvature


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _curvature(y, z, hessian):
    """Second derivatives of the error of a quadratic function on the triangle (p, y, z) at p = 0."""
    area = _cross(y, z) / 2
    turn = np.stack([y[:, 1] - z[:, 1], z[:, 0] - y[:, 0]], axis=1) / 2
    ahead, behind = (-2 * np.einsum("nij,nj->ni", hessian, x) for x in (y, z))
    d_y, d_z = -(ahead * y).sum(axis=1) / 2, -(behind * z).sum(axis=1) / 2
    opposite = np.einsum("ni,nij,nj->n", y - z, hessian, y - z)
    total = d_y + d_z + opposite
    slope = 2 * ((d_y + total)[:, None] * ahead + (d_z + total)[:, None] * behind)
    outer = sum(x[:, :, None] * x[:, None] for x in (ahead, behind, ahead + behind))
    bent = 2 * outer + 4 * (d_y + d_z + 2 * total)[:, None, None] * hessian
    crossed = turn[:, :, None] * slope[:, None]
    return (area[:, None, None] * bent + crossed + crossed.transpose(0, 2, 1)) / 720
