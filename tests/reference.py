"""The local optimisation procedure once more: slow, obvious, for any criterion.

The mesh is a dictionary from directed edges to the node on their left.  Costs come
from the vectorised definitions in `meshlib.criteria`, so that nothing but the
algorithm is shared with the kernels and with the runner in plain Python, whose oracle
this is.
"""

from collections import deque
from dataclasses import replace

import numpy as np

from meshlib import Interpolant, Mesh, checks
from meshlib.criteria import norms
from meshlib.errors import not_a_cost
from meshlib.mesh.quality import angles
from meshlib.mesh.topology import canonical
from meshlib.swapping.along_curve import AlongCurve
from meshlib.swapping.procedure import TRACE, Outcome
from meshlib.swapping.swapped import prepared

FLAT = 1e-12


def run(procedure, order, schedule="sweep"):
    """The outcome of a procedure, with its trace; elements in lexicographic order."""
    follow = {"sweep": swapped, "queue": drained}[schedule]
    elements, swaps, sweeps, tried = follow(state_of(procedure), order.tolist())
    return Outcome(elements, swaps, sweeps, len(tried), np.array(tried, dtype=TRACE))


def result(
    mesh,
    values,
    criterion,
    *,
    norm="L2",
    order=None,
    schedule="sweep",
    min_angle=None,
    min_area=None,
    min_gain=None,
):
    """The outcome with the arguments of `meshlib.swapped`."""
    procedure = prepared(mesh, values, criterion, norm, min_angle, min_area, min_gain)
    if order is not None or schedule == "sweep":
        edges = np.arange(mesh.n_edges) if order is None else checks.permutation(order, mesh.n_edges)
        return run(procedure, edges, schedule)
    curve = AlongCurve(procedure)
    done = run(curve._procedure, np.arange(mesh.n_edges), schedule)
    elements = canonical(curve._curve.nodes[done.elements])
    return replace(done, elements=elements, trace=curve._restored(done.trace))


def state_of(procedure):
    """The start mesh of a procedure."""
    p = procedure
    return State(p.mesh, p.values, p.criterion, p.norm, p.limits, p.tolerance)


def swapped(state, order):
    """Elements after Algorithm 3.1.4, the numbers of swaps and sweeps, and every tried swap."""
    sweep, changed = 0, True
    while changed:
        sweep += 1
        changed = sum([state.inspect(e, sweep) for e in order])  # no short cut: all are inspected
    return state.elements, state.swaps, sweep, state.tried


def drained(state, order):
    """`swapped` with a queue: all edges once, and again those whose local cost a swap may change."""
    queue = deque(order)
    while queue:
        e = queue.popleft()
        if state.inspect(e, 0):
            queue.extend(f for f in dict.fromkeys(state.near(e)) if f not in set(queue))
    return state.elements, state.swaps, 0, state.tried


class State:
    """A mesh as a dictionary, and what has been done to it."""

    def __init__(self, mesh, values, criterion, norm, limits, tolerance):
        self.apex = {
            (a, b): c for t in mesh.elements.tolist() for a, b, c in (t, t[1:] + t[:1], t[2:] + t[:2])
        }
        self.slots = [tuple(e) for e in mesh.edges.tolist()]
        self.nodes, self.points = mesh.nodes, np.column_stack([mesh.nodes, values])
        self.cost, self.norm, self.limits, self.tolerance = criterion.cost, norm, limits, tolerance
        self.local_cost = {"edge": _edge_costs, "element": _element_costs, "node": _node_costs}[criterion.on]
        self.swaps, self.tried = 0, []

    @property
    def elements(self):
        return _elements(self.apex)

    def inspect(self, e, sweep):
        """Swap an edge if it is not locally optimal; returns whether it was swapped."""
        quad = _quadrilateral(self.apex, self.slots[e])
        if quad is None or _is_refused(self.nodes, quad, self.limits):
            return False
        a, b, c, d = quad
        old, new = (
            norms.measure(_finite(h, a, b), self.norm, self.tolerance[1])
            for h in self.local_cost(self.cost, self.points, self.apex, quad)
        )
        accepted = norms.is_below(new, old, self.norm, *self.tolerance)
        self.tried.append((sweep, e, a, b, c, d, accepted, *_deciding(old, new)))
        if accepted:
            _swap(self.apex, quad)
            self.slots[e], self.swaps = (c, d), self.swaps + 1
        return accepted

    def near(self, e):
        """The edges around the new edge c-d: its sides, and the two others of each element beyond."""
        number = {frozenset(ends): k for k, ends in enumerate(self.slots)}
        c, d = sorted(self.slots[e])
        a, b = self.apex[d, c], self.apex[c, d]
        for p, q in ((d, b), (b, c), (c, a), (a, d)):
            yield number[frozenset((p, q))]
            r = self.apex.get((q, p))
            if r is not None:
                yield number[frozenset((p, r))]
                yield number[frozenset((r, q))]


def _finite(costs, a, b):
    if (np.isfinite(costs) & (np.asarray(costs) >= 0)).all():
        return costs
    raise not_a_cost(a, b)


def _deciding(old, new):
    """The costs that decide: the first that differ in the lexicographic order."""
    if not isinstance(old, tuple):
        return old, new
    differ = (pair for pair in zip(old, new, strict=False) if pair[0] != pair[1])
    return next(differ, (old[0], new[0]))


def _quadrilateral(apex, edge):
    """Nodes a, b, c, d: the edge a-b, c to its left, d to its right; None on the boundary."""
    a, b = edge
    c, d = apex.get((a, b)), apex.get((b, a))
    return None if c is None or d is None else (a, b, c, d)


def _swap(apex, quad):
    """Replace the elements (c, a, b), (d, b, a) by (c, a, d), (d, b, c)."""
    a, b, c, d = quad
    del apex[a, b], apex[b, a]
    for p, q, r in ((c, a, d), (d, b, c)):
        apex[p, q], apex[q, r], apex[r, p] = r, p, q


def _elements(apex):
    rows = {from_smallest(a, b, c) for (a, b), c in apex.items()}
    return np.array(sorted(rows), dtype=np.int32)


def from_smallest(a, b, c):
    """The element turned so that its smallest node number comes first."""
    return min((a, b, c), (b, c, a), (c, a, b))


def _is_refused(nodes, quad, limits):
    a, b, c, d = quad
    corners = nodes[[[c, a, d], [d, b, c]]]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    left, right = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
    if (left - right <= FLAT * (abs(left) + abs(right))).any():
        return True
    return ((left - right) / 2 < limits.area).any() or angles(corners).min() < limits.angle


def _edge_costs(cost, points, apex, quad):
    """Costs of the five edges around a-b, and of those around c-d instead."""
    a, b, c, d = quad
    sides = [(b, c), (c, a), (a, d), (d, b)]
    beyond = [apex.get((q, p)) for p, q in sides]
    old = [(a, b, c, d)] + [(p, q, r, n) for (p, q), r, n in zip(sides, (a, b, b, a), beyond, strict=True)]
    new = [(c, d, b, a)] + [(p, q, r, n) for (p, q), r, n in zip(sides, (d, d, c, c), beyond, strict=True)]
    return tuple(
        cost(*np.moveaxis(points[[_canonical(*s) for s in stencils if s[3] is not None]], 1, 0))
        for stencils in (old, new)
    )


def _canonical(p, q, left, right):
    """The edge p-q from its smaller node, so that its cost does not depend on history."""
    return (p, q, left, right) if p < q else (q, p, right, left)


def _element_costs(cost, points, apex, quad):
    """Costs of the two elements at a-b, and of those at c-d instead."""
    a, b, c, d = quad
    return tuple(
        cost(*np.moveaxis(points[[from_smallest(*t) for t in pair]], 1, 0))
        for pair in ([(c, a, b), (d, b, a)], [(c, a, d), (d, b, c)])
    )


def _node_costs(cost, points, apex, quad):
    """Costs of the four nodes, before and after, on the elements around them."""
    after = dict(apex)
    _swap(after, quad)
    return tuple(_patch_costs(cost, points, mesh, quad) for mesh in (apex, after))


def _patch_costs(cost, points, apex, quad):
    elements = _elements({edge: c for edge, c in apex.items() if {*edge, c} & {*quad}})
    used, numbers = np.unique(elements, return_inverse=True)
    patch = Mesh._trusted(points[used, :2], numbers.reshape(-1, 3))
    return cost(Interpolant(patch, points[used, 2]))[np.searchsorted(used, quad)]
