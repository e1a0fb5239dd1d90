"""Nodes moved to where the error of their patch is least, by Newton's method on many patches at once."""

import numpy as np

from ..kernels import for_work
from ..mesh.boundary_sides import CORNER
from .patches import Patches


def moved(draft):
    """The draft with every node moved once, if that lowers the error.

    Nodes of one colour have no element in common, so that they move together.
    """
    sweep = _Sweep(draft)
    for nodes in sweep.classes():
        sweep.improve(nodes)
    return sweep.result()


class _Sweep:
    """Nodes on their way, and the errors and moments of their elements."""

    def __init__(self, draft):
        self.nodes, self.values, self.fresh = draft.nodes.copy(), draft.values.copy(), draft.fresh.copy()
        self.draft, self.around, self.patches = draft, draft.neighbours(), draft.patches()
        self.little, self.settings = draft.little, draft.settings.moves
        self.errors, self.moments = draft.misfit.moments(
            draft.nodes[draft.elements], draft.values[draft.elements], is_new=False
        )

    def classes(self):
        """The nodes that may move, one colour after the other."""
        kernels = for_work(self.settings.colouring * self.draft.n_nodes)
        flat = kernels.backend.flat
        colour = flat(np.full(self.draft.n_nodes, -1, dtype=np.int32))
        kernels.colours.first_free(flat(self.around.starts), flat(self.around.numbers), colour)
        colour = np.where(self.draft.side != CORNER, np.asarray(colour), -1)
        return (np.flatnonzero(colour == c) for c in range(colour.max() + 1))

    def improve(self, nodes):
        """Move the nodes that can be moved for the better."""
        if not len(nodes):
            return
        patches = self._patches(nodes)
        step, gain = self._steps(patches)
        left = np.flatnonzero(gain > self.settings.worthwhile * patches.error + self.little)
        for share in self.settings.step_shares:
            if len(left):
                left = left[~self._try(nodes[left], share * step[left])]

    def result(self):
        """The draft with the nodes where they are now."""
        return self.draft.changed(
            self.nodes, self.draft.elements, values=self.values, errors=self.errors, fresh=self.fresh
        )

    def _patches(self, nodes):
        return Patches(self, nodes)

    def _steps(self, patches):
        """Newton's steps, and the gain that they promise."""
        away, row = self.around.of(patches.nodes)
        frames = patches.frames(away, row)
        slope, curvature = patches.model(frames)
        length = _downhill(slope, curvature, self.settings)
        gain = -(slope * length).sum(axis=1) / 2
        return _on_grid(np.einsum("nk,nkc->nc", length, frames), frames, self.settings.grid), gain

    def _try(self, nodes, step):
        """Move nodes by a step where the error falls; returns where it did."""
        patches = self._patches(nodes)
        at = patches.kept_on_sides(self.nodes[nodes] + step)
        there = self.draft.misfit.values(*at.T.copy())
        error, of_element, moments = patches.moved(at, there)
        better = error < patches.error * (1 - self.settings.smallest_gain)
        self.nodes[nodes[better]], self.values[nodes[better]] = at[better], there[better]
        changed = better[patches.row]
        element = patches.element[changed]
        self.errors[element], self.moments[element] = of_element[changed], moments[changed]
        self.fresh[element] = True
        return better


def _on_grid(steps, frames, grid):
    """Steps rounded to multiples of powers of two, so that rounding leaves no trace in the mesh."""
    extent = np.hypot(frames[..., 0], frames[..., 1]).min(axis=1)
    grid = grid * 2.0 ** np.round(np.log2(np.where(extent > 0, extent, 1)))[:, None]
    return np.round(steps / grid) * grid


def _downhill(slope, curvature, settings):
    """Minimum of a quadratic model, with its curvature made positive, within the longest step."""
    size, axes = np.linalg.eigh(curvature)
    size = np.abs(size)
    largest = size.max(axis=1, keepdims=True)
    size = np.maximum(size, settings.least_curved * largest)
    along = np.einsum("nji,nj->ni", axes, slope) / np.where(size > 0, size, 1)
    step = -np.einsum("nij,nj->ni", axes, along)
    length = np.hypot(*step.T)[:, None]
    return step * np.minimum(1, settings.longest_step / np.where(length > 0, length, 1))
