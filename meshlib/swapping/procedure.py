"""The local optimisation procedure, set up once and run for many edge orders.

Data go from a mesh to flat arrays, through a kernel, and back to elements.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..criteria.norms import norm_of
from ..criteria.registry import Criterion
from ..errors import not_a_cost
from ..kernels import codes, for_work
from ..mesh.mesh import Mesh
from ..mesh.topology import from_smallest, half_edges

TRACE = np.dtype(
    [
        ("sweep", np.int32),
        ("edge", np.int32),
        ("a", np.int32),
        ("b", np.int32),
        ("c", np.int32),
        ("d", np.int32),
        ("accepted", bool),
        ("old", np.float64),
        ("new", np.float64),
    ]
)
NORM_CODES = {1: codes.SUM, 2: codes.SQUARES, "max": codes.MAXIMUM}
STEPS = 25  # of plain Python, from the first look at an edge to the last
UNLIMITED = np.iinfo(np.int64).max // 2


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

    Arguments are those of `meshlib.swapped`, checked.  What is prepared for a run is
    kept for further ones, unless it is to be used ``once``.
    """

    mesh: Mesh
    values: np.ndarray
    criterion: Criterion
    norm: object
    limits: Limits
    tolerance: tuple
    once: bool = False

    def run(self, order, trace=False, schedule="sweep", watch=None):
        """Inspect the edges in this order until no swap is left to make.

        Parameters
        ----------
        order : (E,) ndarray of int
        trace : bool
            Whether to record every tried swap.
        schedule : {"sweep", "queue"}
            Sweep after sweep, or each edge once and then those near swaps.
        watch : Watch, optional
            Is told how far the run is, and may stop it.

        Returns
        -------
        Outcome
        """
        return (self._compiled if self.is_compiled else self._plain)(order, trace, schedule, watch)

    @property
    def is_compiled(self):
        """Whether kernels know criterion and norm."""
        return self.norm in NORM_CODES and self.criterion.is_compiled

    def swapped(self, order):
        """The mesh that `run` leaves, without a record."""
        return Mesh._trusted(self.mesh.nodes, self.run(order).elements)

    def cost(self, mesh):
        """Norm of the cost vector of a mesh with the same nodes."""
        return norm_of(self.criterion.costs(mesh, self.values), self.norm)

    def _compiled(self, order, trace, schedule, watch):
        kernels = for_work(STEPS * len(order))  # a cost of one's own has loaded the compiled
        state, arguments = self.arguments(kernels)
        order, tally = _start(order, kernels)
        if trace and schedule == "sweep":
            return self._traced(kernels, order, tally, state, arguments)
        # the trace of a queue may be of any length
        logs = logs_for(self.run(order, False, schedule).tried if trace else 0, kernels)
        kernel = {"sweep": kernels.schedules.swept, "queue": kernels.schedules.drained}[schedule]
        _watched(kernel, watch, order, tally, *arguments, *logs)
        return self._outcome(state, tally, _rows(0, *logs, tally[codes.TRIES] if trace else 0))

    def arguments(self, kernels):
        """A fresh copy of the state, and all that a kernel wants after order, tally and limit."""
        points, state = self._prepared(kernels)
        return state, (
            self.criterion.code,
            self.criterion.pointer,
            NORM_CODES[self.norm],
            *self.tolerance,
            self.limits.angle,
            2 * self.limits.area,
            points,
            *state,
        )

    def _traced(self, kernels, order, tally, state, arguments):
        rows, logs, done = [], logs_for(len(order), kernels), False
        while not done:
            before = tally[codes.TRIES]
            kernels.schedules.sweep(order, tally, len(order), *arguments, *logs)
            done = kernels.schedules.is_last(tally)
            rows.append(_rows(len(rows) + 1, *logs, tally[codes.TRIES] - before))
        return self._outcome(state, tally, np.concatenate(rows))

    def _outcome(self, state, tally, trace):
        elements = elements_of(state, tally)
        return Outcome(elements, *(int(tally[k]) for k in (codes.SWAPS, codes.SWEEPS, codes.TRIES)), trace)

    def _plain(self, order, trace, schedule, watch):
        from . import plain

        procedure = {"sweep": plain.swapped, "queue": plain.drained}[schedule]
        elements, swaps, sweeps, tried = procedure(
            self.mesh, self.values, self.criterion, self.norm, order, self.limits, self.tolerance
        )
        return Outcome(_in_rows(elements, self.mesh), swaps, sweeps, len(tried), np.array(tried, dtype=TRACE))

    @cached_property
    def _kept(self):
        return {}  # what has been prepared, by the backend whose form it has

    def _prepared(self, kernels):
        """The points x, y, u, and the state before the first swap, which is the caller's to change."""
        if self.once:
            return self._new(kernels)
        name = kernels.backend.NAME
        if name not in self._kept:
            self._kept[name] = self._new(kernels)
        points, state = self._kept[name]
        return points, tuple(array.copy() for array in state)

    def _new(self, kernels):
        """The points, and all that a kernel changes: the mesh, its planes and costs."""
        mesh, code, writable = self.mesh, self.criterion.code, kernels.backend.writable
        points = kernels.backend.readable(np.column_stack([mesh.nodes, self.values]))
        element = kernels.backend.flat(mesh.elements)
        twin, slot, half = half_edges(mesh.element_edges, mesh.n_edges, kernels)
        face = writable(np.empty(3 * mesh.n_elements))
        cost = writable(np.zeros(mesh.n_edges))
        settled = writable(np.full(mesh.n_edges, codes.UNKNOWN, dtype=np.int8))
        kernels.half_edges.faces(element, points, face)
        if code < codes.SMALLEST_ANGLE:
            kernels.lop.first_costs(code, self.criterion.pointer, points, element, twin, half, face, cost)
        return points, (element, twin, slot, half, face, cost, settled)


def _start(order, kernels):
    """Order and tally of a run that has done nothing yet."""
    tally = np.zeros(codes.FAULT + 1, dtype=np.int64)
    tally[[codes.WAITING, codes.FAULT]] = len(order), -1
    writable = kernels.backend.writable
    return writable(np.array(order, dtype=np.int32)), writable(tally)


def elements_of(state, tally):
    """The elements of a state, or the error of a cost of one's own that is not a cost."""
    element, half = state[0], state[3]
    if tally[codes.FAULT] >= 0:
        h = int(half[tally[codes.FAULT]])
        a, b = sorted(int(element[h - h % 3 + (h + step) % 3]) for step in (1, 2))
        raise not_a_cost(a, b)
    return np.asarray(element, dtype=np.int32).reshape(-1, 3)


def _watched(kernel, watch, order, tally, *arguments):
    """Run a kernel to its end, part by part if somebody watches."""
    if watch is None:
        kernel(order, tally, UNLIMITED, *arguments)
        return
    while not (watch.stopped or kernel(order, tally, watch.part, *arguments)):
        waiting = tally[codes.WAITING]  # all of them in a sweep
        watch.report(tally[codes.PLACE] if waiting == len(order) else len(order) - waiting)


def logs_for(rows, kernels):
    """Room to record so many tried swaps."""
    writable = kernels.backend.writable
    return writable(np.zeros(6 * rows, dtype=np.int64)), writable(np.zeros(2 * rows))


def _rows(sweep, log, costs, count):
    rows = np.zeros(count, dtype=TRACE)
    rows["sweep"] = sweep
    table = np.reshape(log[: 6 * count], (-1, 6))
    for name, column in zip(("edge", "a", "b", "c", "d", "accepted"), table.T, strict=True):
        rows[name] = column
    rows["old"], rows["new"] = np.reshape(costs[: 2 * count], (-1, 2)).T
    return rows


def _in_rows(elements, mesh):
    """The elements, old ones in their old rows."""
    left, rows = set(map(tuple, elements.tolist())), mesh.elements.copy()
    old = list(map(tuple, from_smallest(mesh.elements).tolist()))
    changed = [t for t, nodes in enumerate(old) if nodes not in left]
    rows[changed] = np.array(sorted(left.difference(old)), dtype=np.int32).reshape(-1, 3)
    return rows
