"""The strategy: grow a mesh, then take nodes out, put them in again and move them, in rounds.

A mesh for many nodes begins as one for a quarter of them, with its elements divided: in
this way its good arrangement, the dearest thing to reach, is kept.
"""

import numpy as np

from .collapse import collapse, settle_on_boundary
from .division import bisect, divide
from .insertion import insert
from .moves import move
from .swaps import swap
from .working_mesh import Best


def steps(draft, n_nodes):
    """At most how many steps there will be."""
    settings = draft.settings.rounds
    levellings = (2 * settings.levelling + settings.last_moves + 1) * (draft.norm == "max")
    return sum(2 * rounds + 2 for _, rounds in _sizes(draft, n_nodes)) + settings.last_moves + levellings + 2


def strategy(draft, n_nodes, note, regular=None):
    """Adapt a draft with so many nodes; ``note`` is told after each step what it was.

    A regular mesh of at most so many nodes, if there is one, is tried as well: for
    functions of nearly constant second derivatives none may be better.
    """
    settings = draft.settings
    for size, rounds in _sizes(draft, n_nodes):
        divided(draft, size)
        grown(draft, size)
        note("grown")
        improved(draft)
        note("moved")
        if size < n_nodes or not regular_taken(
            draft, regular, n_nodes, settings.lattice.clearly_better, note
        ):
            in_rounds(draft, size, rounds, note)
    polish(draft, note)
    if draft.norm == "max":
        draft.measure(settings.objective.squarings)
        in_rounds(draft, n_nodes, settings.rounds.levelling, note)
        if regular_taken(draft, regular, n_nodes, 1, note):
            polish(draft, note)


def regular_taken(draft, regular, n_nodes, share, note):
    """Take a regular mesh if that lowers the objective to such a share or less; returns whether."""
    if regular is None or not draft.misfit.is_allowed(regular.corners).all():
        return False
    best, before = Best(draft), draft.objective
    best.offer()
    draft.begin(regular)
    swap(draft)
    if draft.objective < draft.settings.lattice.promising * before:
        grown(draft, n_nodes)
        improved(draft)
    is_better = draft.n_nodes == n_nodes and draft.objective < share * before
    if not is_better:
        best.restore()
    note("compared")
    return is_better


def in_rounds(draft, n_nodes, rounds, note):
    """Renew a part of the nodes in each round, less and less of them, and go back to the best state."""
    best = Best(draft)
    best.offer()
    for k in range(rounds):
        renewed(draft, n_nodes, draft.settings.rounds.renewed * (1 - k / rounds))
        note("renewed")
        improved(draft)
        note("moved")
        best.offer()
    best.restore()


def polish(draft, note):
    """Move all nodes a few times, as long as it is worth it."""
    settings = draft.settings.rounds
    for _ in range(settings.last_moves):
        before = draft.errors.sum()
        improved(draft)
        note("moved")
        if draft.errors.sum() > (1 - settings.worthwhile) * before:
            break


def _sizes(draft, n_nodes):
    """Numbers of nodes at which the mesh is improved, each a quarter or half of the next, and the rounds."""
    settings, sizes = draft.settings.rounds, [n_nodes]
    while not draft.misfit.sharpest and (before := _before(draft, sizes[0])) > draft.n_nodes:
        sizes.insert(0, before)
    times = np.clip(np.sqrt(settings.typical_nodes / n_nodes), settings.fewest_times, settings.most_times)
    return [*((size, settings.early) for size in sizes[:-1]), (n_nodes, round(times * settings.main))]


def _before(draft, n_nodes):
    settings = draft.settings.division
    are_many = n_nodes >= settings.ratio * settings.fewest_nodes
    return n_nodes // (settings.ratio if are_many else settings.ratio_of_few)


def divided(draft, n_nodes):
    """Divide the elements as long as there are not so many nodes then."""
    fewest = draft.settings.division.fewest_nodes
    while draft.n_nodes >= fewest and draft.n_nodes + draft.mesh.n_edges <= n_nodes and divide(draft):
        swap(draft)
        improved(draft)


def grown(draft, n_nodes):
    """Insert nodes until there are so many."""
    grow = _bisected if draft.misfit.sharpest else _inserted
    inserted = True
    while inserted and draft.n_nodes < n_nodes:
        most = max(1, int(draft.settings.insertion.growth * draft.n_nodes))
        inserted = grow(draft, min(n_nodes - draft.n_nodes, most))
        settle_on_boundary(draft)
    swap(draft)


def _inserted(draft, most):
    found = insert(draft, most)
    swap(draft, draft.settings.swaps.passes_between_insertions)
    return found


def _bisected(draft, most):
    """Where angles are limited: swaps in between would leave elements that cannot be split any more."""
    return bisect(draft, most) or insert(draft, most)


def improved(draft):
    """Move all nodes once, and swap."""
    move(draft)
    settle_on_boundary(draft)
    swap(draft)


def renewed(draft, n_nodes, share):
    """Take out a share of the nodes, and put as many in again elsewhere."""
    collapse(draft, share)
    swap(draft)
    grown(draft, n_nodes)
