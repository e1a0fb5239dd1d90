"""Swaps that lower the error, many at a time."""

import numpy as np

from ..mesh.topology import quadrilaterals
from ..support.independent import coarse, independent


def swap(draft, passes=None):
    """Swap edges until none lowers the error, or so many passes are over; returns the number of swaps."""
    total = 0
    for _ in range(passes or draft.settings.swaps.passes):
        swaps = _pass(draft)
        total += swaps
        if not swaps:
            break
    return total


def _pass(draft):
    r"""Of all edges around new elements, swap those that gain most among their neighbours.

    ::

            c                    c
           / \                  /|\
          / t \                / | \         t = (a, b, c) -> (a, b, d)
         a     d     --->     a t|s d        s = (d, c, b) -> (a, d, c)
          \ s /                \ | /         (drawn with b below and c above)
           \ /                  \|/
            b                    b
    """
    edges = _promising(draft)
    quads, pairs = quadrilaterals(draft.mesh, edges)
    a, b, c, d = quads.T
    first, second = np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)
    old, new = draft.errors[pairs].sum(axis=1), np.stack([draft.error_of(first), draft.error_of(second)])
    gain = coarse(old - new.sum(axis=0))
    good = np.flatnonzero(gain > draft.settings.swaps.smallest_gain * old)
    chosen = good[
        independent(gain[good], np.repeat(np.arange(len(good)), 2), pairs[good].ravel(), len(draft.elements))
    ]
    _exchange(draft, pairs[chosen].T, (first[chosen], second[chosen]), new[:, chosen])
    return len(chosen)


def _promising(draft):
    """Inner edges around new elements that have an error to speak of."""
    mesh = draft.mesh
    edges = np.flatnonzero(~mesh.boundary & draft.fresh[mesh.edge_elements].any(axis=1))
    old = draft.errors[mesh.edge_elements[edges]].sum(axis=1)
    return edges[old > draft.little]


def _exchange(draft, rows, elements, errors):
    """Put new elements and their errors into rows, and take only these for new."""
    fresh = np.zeros(len(draft.elements), dtype=bool)
    if not rows.size:
        draft.fresh = fresh
        return
    draft.elements = draft.elements.copy()
    for row, nodes, error in zip(rows, elements, errors, strict=True):
        draft.elements[row], draft.errors[row], fresh[row] = nodes, error, True
    draft.settle(draft.errors, fresh)
