"""Nodes moved to where the error of their patch is least, by Newton's method on many patches at once."""
import numpy as np

from .collapse import beside
from ..sides import CORNER, INTERIOR

PROBE = 0.08  # of the extent of a patch, at which differences of its error are taken
REACH = 0.35  # of the same: how far a node may go at once
SHARES = (1.0, 0.4)  # of the step that are tried
GAIN = 1e-10  # relative; smaller gains are rounding
CURVED = 1e-3  # smallest curvature of the model, relative to its largest


def move(draft):
    """Move every node once, if that lowers the error; returns how many moved.

    Nodes of one colour have no element in common, so that they move together.
    """
    neighbours, patches = draft.neighbours(), draft.patches()
    colour, moved = _colours(neighbours), 0
    draft.nodes, draft.values = draft.nodes.copy(), draft.values.copy()
    draft.fresh = draft.fresh.copy()
    for c in range(colour.max() + 1):
        nodes = np.flatnonzero((colour == c) & (draft.side != CORNER))
        if len(nodes):
            moved += _Patches(draft, nodes, neighbours, patches).improve()
    draft.settle(np.full(len(draft.elements), np.nan), draft.fresh)
    return moved


def _colours(neighbours):
    from ..kernels import colours
    from ..kernels.backend import flat
    found = flat(np.full(len(neighbours.starts) - 1, -1, dtype=np.int32))
    colours.first_free(flat(neighbours.starts), flat(neighbours.numbers), found)
    return np.asarray(found)


class _Patches:
    """Patches without a common element, and the error of each as a function of its middle node."""

    def __init__(self, draft, nodes, neighbours, patches):
        self.draft, self.nodes = draft, nodes
        corner, self.row = patches.of(nodes)
        self.element, self.k = corner // 3, corner % 3
        self.starts = np.flatnonzero(np.diff(self.row, prepend=-1))
        rows = draft.elements[self.element]
        self.corners, self.values = draft.nodes[rows], draft.values[rows]
        self.around, self.around_row = neighbours.of(nodes)
        self.bound = np.flatnonzero(draft.side[nodes] != INTERIOR)
        self.beside = beside(draft, nodes[self.bound])

    def error(self, at):
        """Error of each patch with its node there, and the value there."""
        values = self.draft.misfit.values(*at.T.copy())
        corners, nodal = self.corners.copy(), self.values.copy()
        place = np.arange(len(self.row)), self.k
        corners[place], nodal[place] = at[self.row], values[self.row]
        total = np.add.reduceat(self.draft.misfit.on_elements(corners, nodal), self.starts)
        for node in self.beside.T:
            ends = np.stack([self.draft.nodes[node], at[self.bound]], axis=1)
            on_edge = np.stack([self.draft.values[node], values[self.bound]], axis=1)
            total[self.bound] += self.draft.weight * self.draft.misfit.on_edges(ends, on_edge)
        return total, values

    def frames(self):
        """Two directions for each patch, in which its extent is PROBE; along a side only the first counts."""
        away = self.draft.nodes[self.around] - self.draft.nodes[self.nodes][self.around_row]
        spread = [np.bincount(self.around_row, away[:, i] * away[:, j]) for i, j in ((0, 0), (0, 1), (1, 1))]
        count = np.bincount(self.around_row)[:, None]
        matrix = np.stack([spread[0], spread[1], spread[1], spread[2]], axis=1) / count
        size, axes = np.linalg.eigh(matrix.reshape(-1, 2, 2))
        frames = np.sqrt(size.clip(min=0))[:, :, None] * axes.transpose(0, 2, 1)
        frames[self.bound] = self._along_sides()
        return PROBE * frames

    def _along_sides(self):
        here = self.draft.nodes[self.nodes[self.bound]]
        away = self.draft.nodes[self.beside] - here[:, None]
        nearest = np.sqrt((away ** 2).sum(axis=2)).min(axis=1)
        ends = self.draft.boundary.ends[self.draft.side[self.nodes[self.bound]]]
        along = ends[:, 1] - ends[:, 0]
        along *= (nearest / np.hypot(*along.T))[:, None]
        return np.stack([along, np.zeros_like(along)], axis=1)

    def improve(self):
        """Move the nodes that can be moved for the better; returns how many."""
        start, frames = self.draft.nodes[self.nodes], self.frames()
        least, _ = self.error(start)
        step, best = self._step(start, frames, least), start.copy()
        values, bound = self.draft.values[self.nodes].copy(), least * (1 - GAIN)
        for share in SHARES:
            at = self._kept_on_sides(np.where((least > bound)[:, None], start + share * step, best))
            error, there = self.error(at)
            better = error < np.minimum(bound, least)
            least[better], best[better], values[better] = error[better], at[better], there[better]
        moved = least <= bound
        self.draft.nodes[self.nodes[moved]], self.draft.values[self.nodes[moved]] = best[moved], values[moved]
        self.draft.fresh[self.element[moved[self.row]]] = True
        return int(moved.sum())

    def _kept_on_sides(self, at):
        at[self.bound] = self.draft.boundary.snapped(at[self.bound], self.draft.side[self.nodes[self.bound]])
        return at

    def _step(self, start, frames, error):
        """Newton's step for the error, from differences in the directions of the frame."""
        u, v = frames[:, 0], frames[:, 1]
        places = start + u, start - u, start + v, start - v, start + u + v
        right, left, up, down, both = (self.error(at)[0] for at in places)
        with np.errstate(invalid="ignore"):  # infinite where an element would be refused
            slope = np.stack([right - left, up - down], axis=1) / 2
            mixed = both - right - up + error
            curvature = np.stack([right + left - 2 * error, mixed, mixed, up + down - 2 * error], axis=1)
        known = np.isfinite(slope).all(axis=1) & np.isfinite(curvature).all(axis=1)
        slope[~known], curvature[~known] = 0, (1, 0, 0, 1)
        slope[self.bound, 1], curvature[self.bound, 1:] = 0, (0, 0, 1)
        length = _downhill(slope, curvature.reshape(-1, 2, 2))
        return length[:, :1] * u + length[:, 1:] * v


def _downhill(slope, curvature):
    """Minimum of a quadratic model, with its curvature made positive, within REACH."""
    size, axes = np.linalg.eigh(curvature)
    size = np.abs(size)
    largest = size.max(axis=1, keepdims=True)
    size = np.maximum(size, CURVED * largest)
    along = np.einsum("nji,nj->ni", axes, slope) / np.where(size > 0, size, 1)
    step = -np.einsum("nij,nj->ni", axes, along)
    length = np.hypot(*step.T)[:, None]
    return step * np.minimum(1, REACH / PROBE / np.where(length > 0, length, 1))
