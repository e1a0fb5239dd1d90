"""Elements divided into four: what is well arranged stays so at half the size."""

import numpy as np

from ..mesh.boundary_sides import INTERIOR
from ..refinement.splitting import SPLITS


def divide(draft):
    """Divide the elements that have an error to speak of, red-green; returns whether any was divided."""
    marked = np.flatnonzero(
        draft.errors + draft.edge_errors() >= draft.settings.division.worthwhile * draft.errors.mean()
    )
    return _split(draft, *SPLITS["red-green"](draft.mesh, marked)[:3]) > 0


def bisect(draft, most):
    """Bisect elements of nearly the largest error at their longest edges; returns how many nodes are new.

    With an edge of an element its longest edge is bisected as well, so that angles
    stay large; where one would be below the limit nonetheless, fewer are bisected.

    Parameters
    ----------
    draft : Draft
    most : int
        New nodes at most.
    """
    order = draft.worst(most, draft.settings.insertion.worst)
    tried = [order[: len(order) >> k] for k in range(len(order).bit_length())]
    for marked in (*tried, *order[1 : draft.settings.division.tried_singly, None]):
        elements, parents, ends, _ = SPLITS["longest-edge"](draft.mesh, np.sort(marked))
        if len(ends) <= most and _are_allowed(draft, elements, parents, ends):
            return _split(draft, elements, parents, ends)
    return 0


def _are_allowed(draft, elements, parents, ends):
    new = np.bincount(parents, minlength=len(draft.elements))[parents] > 1
    nodes = np.concatenate([draft.nodes, draft.nodes[ends].mean(axis=1)])
    return draft.misfit.is_allowed(nodes[elements[new]]).all()


def _split(draft, elements, parents, ends):
    """Take over elements with new nodes in the middle of edges; returns how many nodes are new."""
    whole = np.bincount(parents, minlength=len(draft.elements)) == 1
    points = draft.nodes[ends].mean(axis=1)
    side = _sides(draft, ends)
    bound = side != INTERIOR
    points[bound] = draft.boundary.snapped(points[bound], side[bound])
    draft.elements = elements
    draft.nodes = np.concatenate([draft.nodes, points])
    draft.values = np.concatenate([draft.values, draft.misfit.values(*points.T.copy())])
    draft.side = np.concatenate([draft.side, side])
    kept = whole[parents]
    draft.settle(np.where(kept, draft.errors[parents], np.nan), ~kept | draft.fresh[parents])
    return len(ends)


def _sides(draft, ends):
    """The side of the middle of edges."""
    found = np.full(len(ends), INTERIOR)
    bound = np.flatnonzero(draft.mesh.boundary[draft.mesh.edge_numbers(np.sort(ends, axis=1))])
    found[bound] = draft.boundary.of_edges(ends[bound], draft.side)
    return found
