"""The local optimisation procedure, set up once and run for many edge orders.

Data go from a mesh to flat arrays, through a kernel, and back to elements.
"""
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .criteria import Criterion
from .mesh import Mesh
from .norms import norm_of
from .topology import from_smallest

TRACE = np.dtype([("sweep", np.int32), ("edge", np.int32), ("a", np.int32), ("b", np.int32),
                  ("c", np.int32), ("d", np.int32), ("accepted", bool),
                  ("old", np.float64), ("new", np.float64)])
NORM_CODES = {1: 1, 2: 2, "max": 0}  # SUM, SQUARES, MAXIMUM of the kernel


@dataclass(frozen=True)
class Limits:
    """Geometric limits of section 6.1 on the elements that a swap creates."""

    angle: float = 0.0  # radians
    area: float = 0.0


@dataclass(frozen=True)
class Outcome:
    """What a run leaves: the elements, old ones in their old rows, and what was done."""

    elements: np.ndarray
    swaps: int
    sweeps: int
    tried: int
    trace: np.ndarray


@dataclass(frozen=True)
class Procedure:
    """Algorithm 3.1.4 on one start mesh; ``run`` takes the order of the edges.

    Arguments are those of `meshlib.swapped`, checked.
    """

    mesh: Mesh
    values: np.ndarray
    criterion: Criterion
    norm: object
    limits: Limits
    tolerance: tuple

    def run(self, order, trace=False, schedule="sweep"):
        """Inspect the edges in this order until no swap is left to make.

        Parameters
        ----------
        order : (E,) ndarray of int
        trace : bool
            Whether to record every tried swap.
        schedule : {"sweep", "queue"}
            Sweep after sweep, or each edge once and then those near swaps.

        Returns
        -------
        Outcome
        """
        compiled = self.criterion.code >= 0 and self.norm in NORM_CODES
        return (self._compiled if compiled else self._plain)(order, trace, schedule)

    def swapped(self, order):
        """The mesh that `run` leaves, without a record."""
        return Mesh._trusted(self.mesh.nodes, self.run(order).elements)

    def cost(self, mesh):
        """Norm of the cost vector of a mesh with the same nodes."""
        return norm_of(self.criterion.costs(mesh, self.values), self.norm)

    def _compiled(self, order, trace, schedule):
        from .kernels import lop  # with numba, which takes a while to load
        state, arguments = self._arguments(order)
        if trace and schedule == "sweep":
            return self._traced(lop.sweep, state, arguments)
        # the trace of a queue may be of any length
        logs = _logs(self.run(order, False, schedule).tried if trace else 0)
        done = {"sweep": lop.optimised, "queue": lop.drained}[schedule](*arguments, *logs)
        return Outcome(_elements(state), *done, _rows(0, *logs, done[2] if trace else 0))

    def _arguments(self, order):
        """A fresh copy of the state, and all that a kernel wants but the logs."""
        from .kernels.backend import flat
        state = tuple(array.copy() for array in self._state)
        return state, (flat(order), self.criterion.code, NORM_CODES[self.norm], *self.tolerance,
                       self.limits.angle, 2 * self.limits.area, *self._data, *state)

    def _traced(self, sweep, state, arguments):
        rows, totals, logs = [], [], _logs(self.mesh.n_edges)
        while not totals or totals[-1][0]:
            totals.append(sweep(*arguments, *logs))
            rows.append(_rows(len(totals), *logs, totals[-1][1]))
        swaps, tried = (sum(column) for column in zip(*totals, strict=True))
        return Outcome(_elements(state), swaps, len(totals), tried, np.concatenate(rows))

    def _plain(self, order, trace, schedule):
        from .kernels import reference
        procedure = {"sweep": reference.swapped, "queue": reference.drained}[schedule]
        elements, swaps, sweeps, tried = procedure(
            self.mesh, self.values, self.criterion, self.norm, order, self.limits, self.tolerance)
        return Outcome(_in_rows(elements, self.mesh), swaps, sweeps, len(tried), np.array(tried, dtype=TRACE))

    @cached_property
    def _data(self):
        """Coordinates and values of the nodes, as the kernel wants them."""
        from .kernels.backend import flat
        return tuple(flat(v) for v in (*self.mesh.nodes.T, self.values))

    @cached_property
    def _state(self):
        """All that the kernel changes, before the first swap: the mesh, its planes and costs."""
        from .kernels import lop, setup
        from .kernels.backend import flat
        mesh = self.mesh
        element, twin, slot, half = (flat(v) for v in (mesh.elements, *mesh.half_edges))
        planes = tuple(flat(np.empty(mesh.n_elements)) for _ in range(3))
        cost, settled = flat(np.zeros(mesh.n_edges)), flat(np.full(mesh.n_edges, lop.UNKNOWN, dtype=np.int8))
        setup.planes(element, *self._data, *planes)
        if self.criterion.code < lop.SMALLEST_ANGLE:
            lop.first_costs(self.criterion.code, *self._data[:2], element, twin, half, *planes, cost)
        return element, twin, slot, half, *planes, cost, settled


def _logs(rows):
    """Room to record so many tried swaps."""
    from .kernels.backend import flat
    return flat(np.zeros(6 * rows, dtype=np.int64)), flat(np.zeros(2 * rows))


def _elements(state):
    return np.array(state[0], dtype=np.int32).reshape(-1, 3)


def _rows(sweep, log, costs, count):
    rows = np.zeros(count, dtype=TRACE)
    rows["sweep"] = sweep
    table = np.reshape(log[:6 * count], (-1, 6))
    for name, column in zip(("edge", "a", "b", "c", "d", "accepted"), table.T, strict=True):
        rows[name] = column
    rows["old"], rows["new"] = np.reshape(costs[:2 * count], (-1, 2)).T
    return rows


def _in_rows(elements, mesh):
    """The elements, old ones in their old rows."""
    left, rows = set(map(tuple, elements.tolist())), mesh.elements.copy()
    old = list(map(tuple, from_smallest(mesh.elements).tolist()))
    changed = [t for t, nodes in enumerate(old) if nodes not in left]
    rows[changed] = np.array(sorted(left.difference(old)), dtype=np.int32).reshape(-1, 3)
    return rows
