"""The strategy: grow a mesh, then remove nodes, insert them again and move them, in rounds.

A mesh with many nodes begins as one with a quarter of them, whose elements are divided. So its
good arrangement is kept, which is the most expensive thing to reach.

What takes several steps is a generator: it yields the name of each step and the draft after
it, and returns the draft with which to go on.
"""

from collections.abc import Generator
from typing import TypeAlias

import numpy as np

from ..mesh.mesh import Mesh
from .collapse import collapsed, settled_on_boundary
from .division import bisected, divided
from .insertion import inserted
from .moves import moved
from .swaps import swapped
from .working_mesh import Draft

Steps: TypeAlias = Generator[tuple[str, Draft], None, Draft]


def most_steps(draft: Draft, n_nodes: int) -> int:
    """Largest number of steps of the strategy, the final measurement included."""
    settings = draft.settings.rounds
    levelling = (2 * settings.levelling + settings.last_moves + 1) * (draft.norm == "max")
    return sum(2 * rounds + 2 for _, rounds in _sizes(draft, n_nodes)) + settings.last_moves + levelling + 2


def strategy(draft: Draft, n_nodes: int, regular: Mesh | None = None) -> Steps:
    """Adapt a draft until it has ``n_nodes`` nodes and there is little left to gain.

    A regular mesh of at most as many nodes, if one is given, is tried as well: for
    functions of nearly constant second derivatives none may be better.
    """
    settings = draft.settings
    for size, rounds in _sizes(draft, n_nodes):
        draft = before = yield from enlarged(draft, size)
        if size == n_nodes:
            draft = yield from compared(draft, regular, n_nodes, settings.lattice.clearly_better)
        if draft is before:
            draft = yield from renewed_in_rounds(draft, size, rounds)
    draft = yield from polished(draft)
    return (yield from levelled(draft, regular, n_nodes)) if draft.norm == "max" else draft


def levelled(draft: Draft, regular: Mesh | None, n_nodes: int) -> Steps:
    """Lower the largest error, by the integral of a high power of it."""
    settings = draft.settings
    draft = draft.measured(settings.objective.squarings)
    draft = before = yield from renewed_in_rounds(draft, n_nodes, settings.rounds.levelling)
    draft = yield from compared(draft, regular, n_nodes, share=1)
    return draft if draft is before else (yield from polished(draft))


def enlarged(draft: Draft, n_nodes: int) -> Steps:
    """Divide elements and insert nodes up to a number of nodes, then move the nodes once."""
    draft = grown(divided_up_to(draft, n_nodes), n_nodes)
    yield "grown", draft
    draft = improved(draft)
    yield "moved", draft
    return draft


def compared(draft: Draft, regular: Mesh | None, n_nodes: int, share: float) -> Steps:
    """Go on with a regular mesh if its objective is less than a share of that of the draft."""
    if regular is None or not draft.misfit.is_allowed(regular.corners).all():
        return draft
    promising, limit = draft.settings.lattice.promising * draft.objective, share * draft.objective
    other = swapped(Draft.of(draft.misfit, regular, draft.norm, draft.settings))
    if other.objective < promising:
        other = improved(grown(other, n_nodes))
    better = other if other.n_nodes == n_nodes and other.objective < limit else draft
    yield "compared", better
    return better


def renewed_in_rounds(draft: Draft, n_nodes: int, rounds: int) -> Steps:
    """Renew a part of the nodes in each round, fewer each time; go on with the best draft met."""
    best, least = draft, _rank(draft)
    for k in range(rounds):
        draft = renewed(draft, n_nodes, draft.settings.rounds.renewed * (1 - k / rounds))
        yield "renewed", draft
        draft = improved(draft)
        yield "moved", draft
        if (rank := _rank(draft)) < least:
            best, least = draft, rank
    return best


def _rank(draft: Draft) -> tuple[int, float]:
    """Drafts with more nodes come first; of equally many nodes that with the lower objective."""
    return -draft.n_nodes, draft.objective


def polished(draft: Draft) -> Steps:
    """Move all nodes a few times, as long as it is worth it."""
    settings = draft.settings.rounds
    for _ in range(settings.last_moves):
        before, draft = draft, improved(draft)
        yield "moved", draft
        if draft.errors.sum() > (1 - settings.worthwhile) * before.errors.sum():
            break
    return draft


def _sizes(draft: Draft, n_nodes: int) -> list[tuple[int, int]]:
    """Numbers of nodes at which the mesh is improved, and the rounds at each.

    Each is a quarter or half of the next.
    """
    settings, sizes = draft.settings.rounds, [n_nodes]
    while not draft.misfit.sharpest and (before := _before(draft, sizes[0])) > draft.n_nodes:
        sizes.insert(0, before)
    times = np.clip(np.sqrt(settings.typical_nodes / n_nodes), settings.fewest_times, settings.most_times)
    return [*((size, settings.early) for size in sizes[:-1]), (n_nodes, round(times * settings.main))]


def _before(draft: Draft, n_nodes: int) -> int:
    settings = draft.settings.division
    are_many = n_nodes >= settings.ratio * settings.fewest_nodes
    return n_nodes // (settings.ratio if are_many else settings.ratio_of_few)


def divided_up_to(draft: Draft, n_nodes: int) -> Draft:
    """The draft with its elements divided as often as the number of nodes allows."""
    fewest, before = draft.settings.division.fewest_nodes, 0
    while max(fewest, before + 1) <= draft.n_nodes <= n_nodes - draft.mesh.n_edges:
        before = draft.n_nodes
        draft = improved(swapped(divided(draft)))
    return draft


def grown(draft: Draft, n_nodes: int) -> Draft:
    """The draft with nodes inserted until there are ``n_nodes``, or no element can be split."""
    grow, before = _grown_by_bisection if draft.misfit.sharpest else _grown_by_insertion, 0
    while before < draft.n_nodes < n_nodes:
        before = draft.n_nodes
        most = max(1, int(draft.settings.insertion.growth * before))
        draft = settled_on_boundary(grow(draft, min(n_nodes - before, most)))
    return swapped(draft)


def _grown_by_insertion(draft: Draft, most: int) -> Draft:
    return swapped(inserted(draft, most), draft.settings.swaps.passes_between_insertions)


def _grown_by_bisection(draft: Draft, most: int) -> Draft:
    """For limited angles: swaps in between would leave elements that cannot be split any more."""
    halved = bisected(draft, most)
    return halved if halved.n_nodes > draft.n_nodes else inserted(draft, most)


def improved(draft: Draft) -> Draft:
    """The draft with all nodes moved once, and edges swapped."""
    return swapped(settled_on_boundary(moved(draft)))


def renewed(draft: Draft, n_nodes: int, share: float) -> Draft:
    """The draft with a share of the nodes removed, and as many inserted elsewhere."""
    return grown(swapped(collapsed(draft, share)), n_nodes)
