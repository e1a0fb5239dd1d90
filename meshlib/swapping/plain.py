r"""The local optimisation procedure for vectorised costs and for the lexicographic order.

It works on the half-edges of the kernels, with costs by NumPy and all else in Python.
Around the edge a-b::

            c                    c
           / \                  /|\
        n2/ t \n1            n2/ | \n1       t = (c, a, b) -> (c, a, d), half-edge h from a to b
         a-----b     --->     a t|s b        s = (d, b, a) -> (d, b, c), half-edge j from b to a
        n3\ s /n4            n3\ | /n4       n1 .. n4: the elements beyond
           \ /                  \|/
            d                    d

Meshes and traces are exactly those of the definition, which inspects every edge in every
sweep and evaluates every cost at every inspection.
"""

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from .._typing import FloatArray, IntArray
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..kernels.backend import Plain
from ..kernels.costs import turn
from ..kernels.groups import Quad, State
from ..kernels.lop import after, before, flip
from ..mesh.mesh import Mesh
from ..mesh.quality import angles
from ..mesh.topology import canonical, half_edges
from .local_costs import LOCAL, OnNodes, Place

if TYPE_CHECKING:
    from ..support.progress import Watch

PLAIN = Plain()


class Given(Protocol):
    """What a run is given: a `Procedure`."""

    mesh: Mesh
    values: FloatArray
    criterion: Criterion
    norm: Any
    limits: Any
    tolerance: tuple[float, float]


class Tried(NamedTuple):
    """A swap that was tried, with the local cost before and after it."""

    edge: int
    a: int
    b: int
    c: int
    d: int
    accepted: bool
    old: float
    new: float


# -- schedules ----------------------------------------------------------------------


def swept(run: "Run", order: Sequence[int], watch: "Watch | None" = None) -> int:
    """Inspect all edges again and again until none is swapped; returns the number of sweeps.

    Around an edge where nothing has changed, the last inspection still holds and is
    only recorded once more.
    """
    known: dict[int, Tried | None] = {}
    for sweep in count(1):
        swaps = run.swaps
        for position, e in enumerate(order):
            if e not in known:
                known[e] = run.inspect(e)
            found = known[e]
            run.record(sweep, found)
            if found is not None and found.accepted:
                for f in run.outdated(e):
                    known.pop(f, None)
            if _is_stopped(watch, position):
                return sweep - 1
        if run.swaps == swaps:
            break
    return sweep


def drained(run: "Run", order: Sequence[int], watch: "Watch | None" = None) -> int:
    """Inspect each edge, and those near swaps again, first come, first served; returns 0 for the sweeps."""
    queue, waits = deque(order), [True] * len(order)
    while queue and not _is_stopped(watch, len(order) - len(queue)):
        e = queue.popleft()
        waits[e], found = False, run.inspect(e)
        run.record(0, found)
        if found is not None and found.accepted:
            for f in run.near(e):
                if not waits[f]:
                    waits[f] = True
                    queue.append(f)
    return 0


def _is_stopped(watch: "Watch | None", done: int) -> bool:
    """Tell a watch how many edges are done; whether it stops the run."""
    if watch is None:
        return False
    watch.report(done)
    return watch.stopped


# -- the run ------------------------------------------------------------------------


class Run:
    """A mesh that is changed swap by swap, and a record of the swaps tried."""

    def __init__(self, procedure: Given, trace: bool = False) -> None:
        mesh, criterion = procedure.mesh, procedure.criterion
        points = np.column_stack([mesh.nodes, procedure.values])
        self.nodes, self.state = mesh.nodes, _state(mesh, points)
        self.start = mesh.edges[:, 0].tolist()  # node a of each edge, seen from which d is to the right
        self.local = LOCAL[criterion.on](criterion.cost, points, self.state)
        self.norm, self.limits, self.tolerance = procedure.norm, procedure.limits, procedure.tolerance
        self.swaps, self.tried = 0, 0
        self.trace: list[tuple[Any, ...]] | None = [] if trace else None

    @property
    def elements(self) -> IntArray:
        """(T, 3) int32: the elements as they are, in lexicographic order, smallest node first."""
        return canonical(np.array(self.state.element, dtype=np.int32).reshape(-1, 3))

    def inspect(self, e: int) -> Tried | None:
        """Swap an edge if it is not locally optimal; None if no swap can be tried."""
        place = self._place(e)
        if place is None or self._is_refused(place.quad):
            return None
        old, new = (norms.measure(v, self.norm, self.tolerance[1]) for v in self.local.costs(place))
        accepted = norms.is_below(new, old, self.norm, *self.tolerance)
        if accepted:
            self._swap(e, place)
        return Tried(e, *place.quad, accepted, *_deciding(old, new))

    def record(self, sweep: int, found: Tried | None) -> None:
        """Count what an inspection found, and write it down if a trace is wanted."""
        if found is not None:
            self.tried += 1
            if self.trace is not None:
                self.trace.append((sweep, *found))

    def near(self, e: int) -> Iterator[int]:
        """The edges around a new edge c-d: its sides, and the two others of each element beyond."""
        (c, d, *_), h, j = self._inner(e)
        slot, twin = self.state.slot, self.state.twin
        if c > d:
            h, j = j, h
        for g in (after(h), before(h), after(j), before(j)):
            yield slot[g]
            beyond = twin[g]
            if beyond >= 0:
                yield slot[after(beyond)]
                yield slot[before(beyond)]

    def outdated(self, e: int) -> Iterable[int]:
        """Edges whose local cost the swap to edge e may have changed, itself among them."""
        quad = self._inner(e).quad
        return self.local.outdated(quad) if isinstance(self.local, OnNodes) else (e, *self.near(e))

    def _place(self, e: int) -> Place | None:
        """An edge and what is around it; None on the boundary."""
        return None if self.state.twin[self.state.half[e]] < 0 else self._inner(e)

    def _inner(self, e: int) -> Place:
        """An inner edge, from the end at which it starts, and what is around it."""
        element, h = self.state.element, self.state.half[e]
        j = self.state.twin[h]
        if element[after(h)] != self.start[e]:
            h, j = j, h
        return Place((element[after(h)], element[before(h)], element[h], element[j]), h, j)

    def _is_refused(self, quad: Quad) -> bool:
        """Whether an element that the swap would create is flat, turned over, or below a limit."""
        a, b, c, d = quad
        if self._is_small(c, a, d) or self._is_small(d, b, c):
            return True
        angle = self.limits.angle
        return angle > 0 and bool(angles(self.nodes[[[c, a, d], [d, b, c]]]).min() < angle)

    def _is_small(self, p: int, q: int, r: int) -> bool:
        """Whether the element p, q, r is flat, turned over, or too small."""
        area = turn(self.state.point, (p, q, r))
        return area <= 0 or area / 2 < self.limits.area

    def _swap(self, e: int, place: Place) -> None:
        self.local.swap(place)
        flip(place.h, place.j, self.state)
        self.start[e], self.swaps = place.quad[2], self.swaps + 1


def _state(mesh: Mesh, points: FloatArray) -> State:
    """Half-edges in lists; costs are kept elsewhere."""
    twin, slot, half = half_edges(mesh.element_edges, mesh.n_edges, PLAIN)
    element = PLAIN.flat(mesh.elements)
    return State(PLAIN.readable(points), element, twin, slot, half, face=[], cost=[], settled=[])


def _deciding(old: Any, new: Any) -> tuple[float, float]:
    """The costs that decide: the first that differ in the lexicographic order."""
    if not isinstance(old, tuple):
        return old, new
    differ = (pair for pair in zip(old, new, strict=False) if pair[0] != pair[1])
    return next(differ, (old[0], new[0]))
