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
        from .plain import Run

        self._mesh, self._run = procedure.mesh, Run(procedure)

    def go(self, edges, rises):
        for e, rise in zip(edges.tolist(), rises.tolist(), strict=True):
            self._inspect(e, rise)

    def differences(self):
        found = (self._inspect(e, -np.inf) for e in range(self._mesh.n_edges))
        return np.array([tried.new - tried.old for tried in found if tried is not None])

    def _inspect(self, e, rise):
        self._run.tolerance = 0.0, -rise
        return self._run.inspect(e)

    @property
    def swaps(self):
        return self._run.swaps

    @property
    def mesh(self):
        return Mesh._trusted(self._mesh.nodes, self._run.elements)
