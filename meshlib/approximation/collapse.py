r"""Nodes taken out again where they serve least, and nodes put on the boundary that all but lie on it."""

import numpy as np

from ..mesh.boundary_sides import CORNER, INTERIOR
from ..support.independent import coarse, independent


def collapsed(draft, share):
    r"""The draft with the cheapest nodes, up to a share of all, merged into a neighbour.

    ::

          *---*              *---*
         / \ / \            / \   \
        *---i---j    --->  *---\---j     the two elements at i-j vanish
         \ / \ /            \ / \ /      (i is merged into j)
          *---*              *---*
    """
    pairs, number, settings = _Pairs(draft), int(share * draft.n_nodes), draft.settings.removal
    pairs.keep_likely(draft, max(int(settings.candidates * number), settings.fewest_candidates))
    cost, into = pairs.cheapest(draft)
    nodes = np.argsort(cost, kind="stable")[:number]
    nodes = nodes[np.isfinite(cost[nodes])]
    corner, row = draft.patches().of(nodes)
    chosen = nodes[independent(-cost[nodes], row, corner // 3, len(draft.elements))]
    return _merged(draft, chosen, into[chosen])


class _Pairs:
    """All pairs (i, j) of a node that may go and a neighbour into which it may be merged."""

    def __init__(self, draft):
        nodes = np.flatnonzero(draft.side != CORNER)
        self.j, row = draft.neighbours().of(nodes)
        self.i = nodes[row]
        allowed = (draft.side[self.i] == INTERIOR) | self._along_side(draft)
        self.i, self.j = self.i[allowed], self.j[allowed]

    def _along_side(self, draft):
        ends = np.sort(np.stack([self.i, self.j], axis=1), axis=1)
        return draft.mesh.boundary[draft.mesh.edge_numbers(ends)]

    def keep_likely(self, draft, number):
        """Keep that number of nodes, and for each the few neighbours towards which u bends least."""
        bend = draft.bends_of(np.stack([self.i, self.j], axis=1))
        bent = _without_noise(draft, bend**2 * draft.patch_sums(draft.mesh.areas)[self.i])
        order, rank = self._ranked(bent)
        first = order[rank == 0]
        worth = np.full(draft.n_nodes, np.inf)
        worth[self.i[first]] = bent[first]
        few = np.zeros(draft.n_nodes, dtype=bool)
        few[np.argsort(worth, kind="stable")[:number]] = True
        chosen = np.sort(order[(rank < draft.settings.removal.neighbours) & few[self.i[order]]])
        self.i, self.j = self.i[chosen], self.j[chosen]

    def cheapest(self, draft):
        """For each node the least cost of merging it into a neighbour, and that neighbour."""
        cost = self._costs(draft)
        order, rank = self._ranked(cost)
        first = order[rank == 0]
        least, into = np.full(draft.n_nodes, np.inf), np.full(draft.n_nodes, -1)
        least[self.i[first]], into[self.i[first]] = cost[first], self.j[first]
        return least, into

    def _ranked(self, cost):
        """Rows node by node, the cheapest of each first, and the place of each among those of its node."""
        order = np.lexsort((cost, self.i))
        node = self.i[order]
        return order, np.arange(len(order)) - np.searchsorted(node, node)

    def _costs(self, draft):
        """Error of the patch after less that before."""
        corner, row = draft.patches().of(self.i)
        nodes, k = draft.elements[corner // 3], corner % 3
        stays = (nodes != self.j[row][:, None]).all(axis=1)
        nodes, k, row = nodes[stays].copy(), k[stays], row[stays]
        nodes[np.arange(len(row)), k] = self.j[row]
        after = np.bincount(row, draft.error_of(nodes), len(self.i))
        return _without_noise(draft, after - draft.patch_sums(draft.errors)[self.i] + self._edge_costs(draft))

    def _edge_costs(self, draft):
        """Merges along the boundary, for nodes on a side: one edge in place of two."""
        cost = np.zeros(len(self.i))
        bound = np.flatnonzero(draft.side[self.i] != INTERIOR)
        i, j = self.i[bound], self.j[bound]
        other = beside(draft, i).sum(axis=1) - j
        old = draft.edge_error_of(np.stack([i, j], 1)) + draft.edge_error_of(np.stack([i, other], 1))
        cost[bound] = draft.edge_error_of(np.stack([other, j], 1)) - old
        return cost


def _without_noise(draft, costs):
    """Costs that are equal where they differ by rounding, and zero where they hardly count."""
    return coarse(np.where(np.abs(costs) > draft.little, costs, 0))


def beside(draft, nodes):
    """The two neighbours along the boundary of nodes on a side."""
    edges = draft.mesh.edges[draft.mesh.boundary]
    pairs = np.concatenate([edges, edges[:, ::-1]])
    pairs = pairs[np.argsort(pairs[:, 0], kind="stable")]
    first = np.searchsorted(pairs[:, 0], nodes)
    return pairs[np.stack([first, first + 1], axis=1), 1]


def _merged(draft, nodes, into):
    """The draft with each of some nodes merged into another."""
    target, gone = np.arange(draft.n_nodes), np.zeros(draft.n_nodes, dtype=bool)
    target[nodes], gone[nodes] = into, True
    rows = target[draft.elements]
    changed = (rows != draft.elements).any(axis=1)
    kept = (rows != np.roll(rows, 1, axis=1)).all(axis=1)
    number = (np.cumsum(~gone) - 1).astype(np.int32)
    return draft.changed(
        draft.nodes[~gone],
        number[rows[kept]],
        values=draft.values[~gone],
        side=draft.side[~gone],
        boundary=draft.boundary.renumbered(number),
        errors=np.where(changed, np.nan, draft.errors)[kept],
        fresh=(draft.fresh | changed)[kept],
    )


def settled_on_boundary(draft):
    r"""The draft with nodes that almost lie on a boundary edge put on it, where that lowers the error.

    ::

          ...n...                       the element (n, a, b) vanishes
        a---------b    --->    a---n---b
    """
    edges = np.flatnonzero(draft.mesh.boundary)
    ends, element = draft.mesh.edges[edges], draft.mesh.edge_elements[edges, 0]
    node = draft.elements[element].sum(axis=1) - ends.sum(axis=1)
    side = draft.boundary.of_edges(ends, draft.side)
    foot = draft.boundary.snapped(draft.nodes[node], side)
    over = _is_near(draft.nodes[ends], draft.nodes[node], foot, draft.settings.removal)
    near = np.flatnonzero((draft.side[node] == INTERIOR) & over)
    gain, values = _gain(draft, node[near], element[near], ends[near], foot[near])
    better = gain > draft.little
    good = near[better]
    corner, row = draft.patches().of(node[good])
    chosen = independent(gain[better], row, corner // 3, len(draft.elements))
    return _put(
        draft,
        node[good][chosen],
        element[good][chosen],
        foot[good][chosen],
        values[better][chosen],
        side[good][chosen],
    )


def _is_near(ends, point, foot, settings):
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(*along.T)
    share = ((foot - ends[:, 0]) * along).sum(axis=1) / length**2
    is_between = np.abs(share - 0.5) < 0.5 - settings.from_ends
    return (np.hypot(*(point - foot).T) < settings.near * length) & is_between


def _gain(draft, node, element, ends, foot):
    """By how much the error of each patch falls, and the values on the boundary."""
    values = draft.misfit.values(*foot.T.copy())
    corner, row = draft.patches().of(node)
    stays = corner // 3 != element[row]
    rows, k = draft.elements[corner[stays] // 3], corner[stays] % 3
    corners, nodal = draft.nodes[rows], draft.values[rows]
    place = np.arange(len(rows)), k
    corners[place], nodal[place] = foot[row[stays]], values[row[stays]]
    after = np.bincount(row[stays], draft.misfit.on_elements(corners, nodal), len(node))
    before = np.bincount(row, draft.errors[corner // 3], len(node)) + draft.edge_error_of(ends)
    for end in ends.T:
        pair = np.stack([draft.nodes[end], foot], 1), np.stack([draft.values[end], values], 1)
        after = after + draft.weight * draft.misfit.on_edges(*pair)
    return coarse(before - after), values


def _put(draft, node, element, foot, values, side):
    """The draft with nodes put on boundary edges, and without the elements between."""
    if not len(node):
        return draft
    nodes, all_values, sides = draft.nodes.copy(), draft.values.copy(), draft.side.copy()
    nodes[node], all_values[node], sides[node] = foot, values, side
    kept = np.ones(draft.n_elements, dtype=bool)
    kept[element] = False
    changed = np.isin(draft.elements, node).any(axis=1)
    return draft.changed(
        nodes,
        draft.elements[kept],
        values=all_values,
        side=sides,
        errors=np.where(changed, np.nan, draft.errors)[kept],
        fresh=(draft.fresh | changed)[kept],
    )
