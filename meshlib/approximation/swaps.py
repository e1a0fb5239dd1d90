"""Swaps that lower the error, many at a time."""

from dataclasses import replace

import numpy as np

from ..mesh.topology import quadrilaterals
from ..support.independent import coarse, independent


def swapped(draft, passes=None):
    """The draft after swaps of edges until none lowers the error, or until the last pass."""
    for _ in range(passes or draft.settings.swaps.passes):
        before, draft = draft, _pass(draft)
        if draft.mesh is before.mesh:
            break
    return draft


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
    return _exchanged(draft, pairs[chosen].T, (first[chosen], second[chosen]), new[:, chosen])


def _promising(draft):
    """Inner edges around new elements that have an error to speak of."""
    mesh = draft.mesh
    edges = np.flatnonzero(~mesh.boundary & draft.fresh[mesh.edge_elements].any(axis=1))
    old = draft.errors[mesh.edge_elements[edges]].sum(axis=1)
    return edges[old > draft.little]


def _exchanged(draft, rows, elements, errors):
    """The draft with other elements and errors in some rows, which alone count as new."""
    fresh = np.zeros(draft.n_elements, dtype=bool)
    if not rows.size:
        return replace(draft, fresh=fresh)
    all_elements, all_errors = draft.elements.copy(), draft.errors.copy()
    for row, nodes, error in zip(rows, elements, errors, strict=True):
        all_elements[row], all_errors[row], fresh[row] = nodes, error, True
    return draft.changed(draft.nodes, all_elements, errors=all_errors, fresh=fresh)
