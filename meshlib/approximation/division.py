"""Elements divided into four: what is well arranged stays so at half the size."""

import numpy as np

from ..mesh.boundary_sides import INTERIOR
from ..refinement.splitting import SPLITS


def divided(draft):
    """The draft with the elements that have an error to speak of divided, red-green."""
    marked = np.flatnonzero(
        draft.errors + draft.edge_errors() >= draft.settings.division.worthwhile * draft.errors.mean()
    )
    return _split(draft, *SPLITS["red-green"](draft.mesh, marked)[:3])


def bisected(draft, most):
    """The draft with elements of nearly the largest error bisected at their longest edges.

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
    return draft


def _are_allowed(draft, elements, parents, ends):
    new = np.bincount(parents, minlength=len(draft.elements))[parents] > 1
    nodes = np.concatenate([draft.nodes, draft.nodes[ends].mean(axis=1)])
    return draft.misfit.is_allowed(nodes[elements[new]]).all()


def _split(draft, elements, parents, ends):
    """The draft with other elements, and with new nodes in the middle of edges."""
    whole = np.bincount(parents, minlength=len(draft.elements)) == 1
    points = draft.nodes[ends].mean(axis=1)
    side = _sides(draft, ends)
    bound = side != INTERIOR
    points[bound] = draft.boundary.snapped(points[bound], side[bound])
    kept = whole[parents]
    return draft.changed(
        np.concatenate([draft.nodes, points]),
        elements,
        values=np.concatenate([draft.values, draft.misfit.values(*points.T.copy())]),
        side=np.concatenate([draft.side, side]),
        errors=np.where(kept, draft.errors[parents], np.nan),
        fresh=~kept | draft.fresh[parents],
    )


def _sides(draft, ends):
    """The side of the middle of edges."""
    found = np.full(len(ends), INTERIOR)
    bound = np.flatnonzero(draft.mesh.boundary[draft.mesh.edge_numbers(np.sort(ends, axis=1))])
    found[bound] = draft.boundary.of_edges(ends[bound], draft.side)
    return found
