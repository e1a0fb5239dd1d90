"""Vectorised costs around an edge as they are and as they would be after its swap.

One call of a vectorised cost takes longer than all the rest of an inspection.  It is
therefore called once for the edges, or elements, that a swap would create and for those
that have not been evaluated before; their costs are kept until a swap changes them.
Letters are those of the drawing in `meshlib.swapping.plain`.
"""

from collections.abc import Callable
from functools import partial
from math import inf, isnan, nan
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .._typing import FloatArray
from ..errors import not_a_cost
from ..interpolation.interpolant import Interpolant
from ..kernels.costs import from_smallest
from ..kernels.groups import Corners, Quad, State
from ..kernels.lop import after, before
from ..mesh.mesh import Mesh

Cost: TypeAlias = Callable[..., Any]  # vectorised
Costs: TypeAlias = list[float]
OldAndNew: TypeAlias = tuple[Costs, Costs]
Items: TypeAlias = list[int]  # edges or elements
Nodes: TypeAlias = tuple[int, ...]


class Place(NamedTuple):
    """Where a swap is tried: nodes a, b, c, d, and the half-edges from a to b and from b to a."""

    quad: Quad
    h: int
    j: int


class Known:
    """Costs of edges or elements, each evaluated when it is first asked for."""

    def __init__(self, cost: Cost, points: FloatArray, size: int) -> None:
        self.cost, self.points, self.known = cost, points, [nan] * size

    def costs(self, items: Items, old: Callable[[int], Nodes], new: list[Nodes], quad: Quad) -> OldAndNew:
        """Costs of items as they are, of which ``old`` gives the nodes, and with new nodes."""
        known = self.known
        missing = [item for item in items if isnan(known[item])]
        nodes = np.array(new + [old(item) for item in missing])
        found = _checked(self.cost(*self.points.take(nodes, axis=0).swapaxes(0, 1)), quad)
        self.keep(missing, found[len(new) :])
        return [known[item] for item in items], found[: len(new)]

    def keep(self, items: Items, costs: Costs) -> None:
        """Set the costs of a few items."""
        for item, cost in zip(items, costs, strict=True):
            self.known[item] = cost


class OnEdges:
    """Costs of the five edges of a quadrilateral, or of fewer at the boundary."""

    def __init__(self, cost: Cost, points: FloatArray, state: State) -> None:
        self.state, self.known = state, Known(cost, points, len(state.half))
        self.new: tuple[Items, Costs] = [], []  # edges of the last place, and their costs after its swap

    def costs(self, place: Place) -> OldAndNew:
        """Costs of a-b, b-c, c-a, a-d, d-b, and of the same with c-d for a-b."""
        twin, slot = self.state.twin, self.state.slot
        (a, b, c, d), h, j = place
        sides = [g for g in (after(h), before(h), after(j), before(j)) if twin[g] >= 0]
        edges = [slot[g] for g in (h, *sides)]
        new = [_from_smaller(c, d, b, a), *(self._nodes(g, d if g // 3 == h // 3 else c) for g in sides)]
        found = self.known.costs(edges, self._nodes_of_edge, new, place.quad)
        self.new = edges, found[1]
        return found

    def swap(self, place: Place) -> None:
        """Take over the costs of the last place after its swap."""
        self.known.keep(*self.new)

    def _nodes_of_edge(self, e: int) -> Nodes:
        h = self.state.half[e]
        return self._nodes(h, self.state.element[h])

    def _nodes(self, h: int, left: int) -> Nodes:
        """Nodes of a half-edge: its ends, one to its left, and that of the element to its right."""
        element = self.state.element
        return _from_smaller(element[after(h)], element[before(h)], left, element[self.state.twin[h]])


class OnElements:
    """Costs of the two elements of a quadrilateral."""

    def __init__(self, cost: Cost, points: FloatArray, state: State) -> None:
        self.state, self.known = state, Known(cost, points, len(state.element) // 3)
        self.new: tuple[Items, Costs] = [], []  # elements of the last place, and their costs after its swap

    def costs(self, place: Place) -> OldAndNew:
        """Costs of (c, a, b), (d, b, a), and of (c, a, d), (d, b, c)."""
        (a, b, c, d), rows = place.quad, [place.h // 3, place.j // 3]
        new: list[Nodes] = [from_smallest(c, a, d), from_smallest(d, b, c)]
        found = self.known.costs(rows, partial(_corners, self.state), new, place.quad)
        self.new = rows, found[1]
        return found

    def swap(self, place: Place) -> None:
        """Take over the costs of the last place after its swap."""
        self.known.keep(*self.new)


class OnNodes:
    """Costs of the four nodes of a quadrilateral, on the elements around them."""

    def __init__(self, cost: Cost, points: FloatArray, state: State) -> None:
        self.cost, self.points, self.state = cost, points, state
        self.rows: list[set[int]] = [set() for _ in points]  # elements at each node
        for k, n in enumerate(state.element):
            self.rows[n].add(k // 3)

    def costs(self, place: Place) -> OldAndNew:
        """Costs of the nodes a, b, c, d before and after the swap."""
        (a, b, c, d), t, s = place.quad, place.h // 3, place.j // 3
        around = {row: _corners(self.state, row) for row in self._around(place.quad)}
        old = self._on_patch(list(around.values()), place.quad)
        around[t], around[s] = from_smallest(c, a, d), from_smallest(d, b, c)
        return old, self._on_patch(list(around.values()), place.quad)

    def swap(self, place: Place) -> None:
        """Node b leaves t, and a leaves s; d joins t, and c joins s."""
        (a, b, c, d), t, s = place.quad, place.h // 3, place.j // 3
        self.rows[b].remove(t)
        self.rows[a].remove(s)
        self.rows[d].add(t)
        self.rows[c].add(s)

    def outdated(self, quad: Quad) -> set[int]:
        """The edges whose quadrilateral has one of these nodes."""
        return {self.state.slot[3 * t + k] for t in self._around(quad) for k in range(3)}

    def _around(self, quad: Quad) -> set[int]:
        return set().union(*(self.rows[n] for n in quad))

    def _on_patch(self, elements: list[Corners], quad: Quad) -> Costs:
        used, numbers = np.unique(np.array(sorted(elements), dtype=np.int32), return_inverse=True)
        patch = Mesh._trusted(self.points[used, :2], numbers.reshape(-1, 3))
        costs = self.cost(Interpolant(patch, self.points[used, 2]))
        return _checked(np.asarray(costs)[np.searchsorted(used, quad)], quad)


LOCAL: dict[str, type[OnEdges | OnElements | OnNodes]] = {
    "edge": OnEdges,
    "element": OnElements,
    "node": OnNodes,
}


def _checked(costs: Any, quad: Quad) -> Costs:
    """What a cost function returned as numbers, or the error that they are no costs."""
    found: Costs = np.asarray(costs, dtype=float).tolist()
    if all(0 <= cost < inf for cost in found):
        return found
    raise not_a_cost(quad[0], quad[1])


def _from_smaller(p: int, q: int, left: int, right: int) -> Nodes:
    """The edge p-q from its smaller node, so that its cost does not depend on history."""
    return (p, q, left, right) if p < q else (q, p, right, left)


def _corners(state: State, row: int) -> Corners:
    """Nodes of an element, the smallest first."""
    return from_smallest(*state.element[3 * row : 3 * row + 3])
