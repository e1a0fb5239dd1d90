"""Elements divided into four: what is well arranged stays so at half the size."""
import numpy as np

from ..sides import INTERIOR
from ..splitting import SPLITS

WORTH = 0.1  # of the mean error of an element, from which on it is divided


def divide(draft):
    """Divide the elements that have an error to speak of, red-green; returns whether any was divided."""
    mesh = draft.mesh
    marked = np.flatnonzero(draft.errors + draft.edge_errors() >= WORTH * draft.errors.mean())
    elements, parents, ends, _ = SPLITS["red-green"](mesh, marked)
    whole = np.bincount(parents, minlength=mesh.n_elements) == 1
    points = mesh.nodes[ends].mean(axis=1)
    side = _sides(draft, ends)
    bound = side != INTERIOR
    points[bound] = draft.boundary.snapped(points[bound], side[bound])
    draft.elements = elements
    draft.nodes = np.concatenate([draft.nodes, points])
    draft.values = np.concatenate([draft.values, draft.misfit.values(*points.T.copy())])
    draft.side = np.concatenate([draft.side, side])
    kept = whole[parents]
    draft.settle(np.where(kept, draft.errors[parents], np.nan), ~kept | draft.fresh[parents])
    return len(ends) > 0


def _sides(draft, ends):
    """The side of the middle of edges."""
    found = np.full(len(ends), INTERIOR)
    bound = np.flatnonzero(draft.mesh.boundary[draft.mesh.edge_numbers(np.sort(ends, axis=1))])
    found[bound] = draft.boundary.of_edges(ends[bound], draft.side)
    return found
