"""The local optimisation procedure, set up once and run for many edge orders.

Data go from a mesh to flat arrays, through a kernel, and back to elements.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .._typing import Norm
from ..criteria.norms import Tolerance, norm_of
from ..criteria.registry import Criterion
from ..errors import not_a_cost
from ..kernels import codes, for_work
from ..kernels.groups import Log, Rules, State
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
STEPS = 25  # steps of plain Python for an edge, from its first inspection to its last
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
    norm: Norm
    limits: Limits
    tolerance: Tolerance
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
        kernels = for_work(STEPS * len(order))  # compiled ones for a user-defined cost, which has loaded them
        given, rules, state = self.arguments(kernels)
        order, tally = _start(order, kernels)
        if trace and schedule == "sweep":
            return self._traced(kernels, order, tally, given, rules, state)
        # the trace of a queue may be of any length
        log = log_for(self.run(order, False, schedule).tried if trace else 0, kernels)
        kernel = {"sweep": kernels.schedules.swept, "queue": kernels.schedules.drained}[schedule]
        _watched(kernel, watch, order, tally, given, rules, state, log)
        return self._outcome(state, tally, _rows(0, log, tally[codes.TRIES] if trace else 0))

    def arguments(self, kernels):
        """What kernels want after order, tally and limit: a user-defined cost, rules, and a fresh state."""
        limits = self.limits.angle, 2 * self.limits.area
        rules = Rules(self.criterion.code, NORM_CODES[self.norm], *self.tolerance, *limits)
        return self.criterion.pointer, rules, self._prepared(kernels)

    def _traced(self, kernels, order, tally, *arguments):
        rows, log, done = [], log_for(len(order), kernels), False
        while not done:
            before = tally[codes.TRIES]
            kernels.schedules.sweep(order, tally, len(order), *arguments, log)
            done = kernels.schedules.is_last(tally)
            rows.append(_rows(len(rows) + 1, log, tally[codes.TRIES] - before))
        return self._outcome(arguments[-1], tally, np.concatenate(rows))

    def _outcome(self, state, tally, trace):
        elements = elements_of(state, tally)
        return Outcome(elements, *(int(tally[k]) for k in (codes.SWAPS, codes.SWEEPS, codes.TRIES)), trace)

    def _plain(self, order, trace, schedule, watch):
        from . import plain

        run = plain.Run(self, trace)
        sweeps = {"sweep": plain.swept, "queue": plain.drained}[schedule](run, order.tolist(), watch)
        elements = _in_rows(run.elements, self.mesh)
        return Outcome(elements, run.swaps, sweeps, run.tried, np.array(run.trace or [], dtype=TRACE))

    @cached_property
    def _kept(self):
        return {}  # what has been prepared, by the backend whose form it has

    def _prepared(self, kernels):
        """The state before the first swap, which is the caller's to change."""
        if self.once:
            return self._new(kernels)
        if kernels.name not in self._kept:
            self._kept[kernels.name] = self._new(kernels)
        point, *changing = self._kept[kernels.name]
        return State(point, *(array.copy() for array in changing))

    def _new(self, kernels):
        """The points, and all that a kernel changes: the mesh, its planes and costs."""
        mesh, code, writable = self.mesh, self.criterion.code, kernels.writable
        twin, slot, half = half_edges(mesh.element_edges, mesh.n_edges, kernels)
        state = State(
            kernels.readable(np.column_stack([mesh.nodes, self.values])),
            kernels.flat(mesh.elements),
            twin,
            slot,
            half,
            face=writable(np.empty(3 * mesh.n_elements)),
            cost=writable(np.zeros(mesh.n_edges)),
            settled=writable(np.full(mesh.n_edges, codes.UNKNOWN, dtype=np.int8)),
        )
        kernels.half_edges.faces(state.element, state.point, state.face)
        if code < codes.SMALLEST_ANGLE:
            kernels.lop.first_costs(self.criterion.pointer, code, state)
        return state


def _start(order, kernels):
    """Order and tally of a run that has done nothing yet."""
    tally = np.zeros(codes.FAULT + 1, dtype=np.int64)
    tally[[codes.WAITING, codes.FAULT]] = len(order), -1
    writable = kernels.writable
    return writable(np.array(order, dtype=np.int32)), writable(tally)


def elements_of(state, tally):
    """The elements of a state, or the error of a user-defined cost that is not a cost."""
    if tally[codes.FAULT] >= 0:
        h = int(state.half[tally[codes.FAULT]])
        a, b = sorted(int(state.element[h - h % 3 + (h + step) % 3]) for step in (1, 2))
        raise not_a_cost(a, b)
    return np.asarray(state.element, dtype=np.int32).reshape(-1, 3)


def _watched(kernel, watch, order, tally, *arguments):
    """Run a kernel to its end, part by part if somebody watches."""
    if watch is None:
        kernel(order, tally, UNLIMITED, *arguments)
        return
    while not (watch.stopped or kernel(order, tally, watch.part, *arguments)):
        waiting = tally[codes.WAITING]  # all of them in a sweep
        watch.report(tally[codes.PLACE] if waiting == len(order) else len(order) - waiting)


def log_for(rows, kernels):
    """Room to record a number of tried swaps."""
    writable = kernels.writable
    return Log(writable(np.zeros(6 * rows, dtype=np.int64)), writable(np.zeros(2 * rows)))


def _rows(sweep, log, count):
    rows = np.zeros(count, dtype=TRACE)
    rows["sweep"] = sweep
    table = np.reshape(log.tried[: 6 * count], (-1, 6))
    for name, column in zip(("edge", "a", "b", "c", "d", "accepted"), table.T, strict=True):
        rows[name] = column
    rows["old"], rows["new"] = np.reshape(log.costs[: 2 * count], (-1, 2)).T
    return rows


def _in_rows(elements, mesh):
    """The elements, old ones in their old rows."""
    left, rows = set(map(tuple, elements.tolist())), mesh.elements.copy()
    old = list(map(tuple, from_smallest(mesh.elements).tolist()))
    changed = [t for t, nodes in enumerate(old) if nodes not in left]
    rows[changed] = np.array(sorted(left.difference(old)), dtype=np.int32).reshape(-1, 3)
    return rows
