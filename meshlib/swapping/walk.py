"""Swaps one by one, of which some may raise the cost: steps among the meshes of given nodes."""

import numpy as np

from ..kernels import ANY, codes, for_work
from ..mesh.mesh import Mesh
from .procedure import elements_of, log_for


def walk_from(procedure):
    """A walk that starts at the mesh of a procedure, with its criterion, norm and limits."""
    return (_Compiled if procedure.is_compiled else _Plain)(procedure)


class _Compiled:
    """A walk by kernels."""

    def __init__(self, procedure):
        self._mesh = procedure.mesh
        self._kernels = for_work(ANY)
        *self._rules, self._state = procedure.arguments(self._kernels)
        self._tally = np.array([0] * codes.FAULT + [-1])

    def go(self, edges, rises):
        """Inspect edges, and swap where the sum of costs, or of their squares, rises by less than given."""
        self._go(edges, rises, log_for(0, self._kernels))

    def differences(self):
        """What each possible swap would add to that sum."""
        count = self._mesh.n_edges
        log = log_for(count, self._kernels)
        self._go(np.arange(count), np.full(count, -np.inf), log)
        old, new = np.reshape(log.costs, (-1, 2)).T
        return (new - old)[np.reshape(log.tried, (-1, 6))[:, 1:3].any(axis=1)]

    def _go(self, edges, rises, log):
        readable, tally = self._kernels.readable, self._kernels.writable(self._tally)
        self._kernels.schedules.walked(
            readable(edges.astype(np.int32)), readable(rises), tally, *self._rules, self._state, log
        )
        self._tally = np.asarray(tally)

    @property
    def swaps(self):
        """Number of swaps so far."""
        return int(self._tally[codes.SWAPS])

    @property
    def mesh(self):
        """The mesh as it is."""
        return Mesh._trusted(self._mesh.nodes, elements_of(self._state, self._tally).copy())


class _Plain:
    """A walk in Python, for costs that kernels do not know."""

    def __init__(self, procedure):
        from . import plain

        order = np.arange(procedure.mesh.n_edges)
        self._state = plain.State(
            procedure.mesh,
            procedure.values,
            procedure.criterion,
            procedure.norm,
            order,
            procedure.limits,
            procedure.tolerance,
        )

    def go(self, edges, rises):
        for e, rise in zip(edges.tolist(), rises.tolist(), strict=True):
            self._state.tolerance = 0.0, -rise
            self._state.inspect(e, 0)

    def differences(self):
        before = len(self._state.tried)
        self.go(np.array(self._state.order), np.full(len(self._state.order), -np.inf))
        return np.array([row[-1] - row[-2] for row in self._state.tried[before:]])

    @property
    def swaps(self):
        return self._state.swaps

    @property
    def mesh(self):
        return Mesh._trusted(self._state.nodes, self._state.elements)
