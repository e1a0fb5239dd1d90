"""The mesh with which the search for a better one begins."""

import numpy as np

from .. import checks
from ..errors import InvalidInputError
from ..mesh.delaunay import delaunay
from ..mesh.mesh import Mesh
from ..support.random_numbers import Draws
from .collapse import collapsed

LARGEST_STRETCH = 1e3  # largest ratio of the sides of a rectangle


def start(domain, nodes, seed, settings):
    """The first mesh."""
    if isinstance(domain, Mesh):
        return checks.a_mesh(domain)
    low, high = corners(domain)
    size = high - low
    most = max(1, int(np.sqrt(nodes)) - 1)  # cells
    shape = np.minimum(np.ceil(settings.cells * size / size.min()), most).astype(int)
    lattice = np.stack(np.meshgrid(*(np.arange(n + 1.0) for n in shape)), axis=-1).reshape(-1, 2)
    inner = ((lattice > 0) & (lattice < shape)).all(axis=1)
    lattice[inner] += settings.jitter * (2 * Draws(seed).uniform((inner.sum(), 2)) - 1)
    return delaunay(low + lattice / shape * size)


def regular(domain, nodes):
    """The lattice of nearly square cells on a rectangle with at most ``nodes`` nodes, and nearly as many."""
    low, high = corners(domain)
    width, height = high - low
    rows = max(2, min(int(np.sqrt(nodes * height / width)), nodes // 2))
    columns = max(2, nodes // rows)
    ticks = np.linspace(0, 1, columns), np.linspace(0, 1, rows)
    lattice = np.stack(np.meshgrid(*ticks), axis=-1).reshape(-1, 2)
    return delaunay(low + lattice * (high - low)) if rows * columns <= nodes else None


def corners(domain):
    """Lower left and upper right corner of a rectangle."""
    try:
        low, high = np.asarray(domain, dtype=float).reshape(2, 2)
    except (TypeError, ValueError):
        raise InvalidInputError(
            "domain",
            f"the domain is {domain!r}; give the lower left and the upper right corner "
            "of a rectangle, or a mesh",
        ) from None
    size = high - low
    if not (np.isfinite(size).all() and (size > 0).all() and size.max() <= LARGEST_STRETCH * size.min()):
        raise InvalidInputError(
            "domain",
            f"the rectangle from {low.tolist()} to {high.tolist()} has no area or is "
            "too long; give the lower left and the upper right corner",
        )
    return low, high


def fitted(draft, nodes):
    """The draft without the nodes that a start mesh has too many."""
    while draft.n_nodes > nodes:
        before, draft = draft, collapsed(draft, 1 - nodes / draft.n_nodes)
        if draft.n_nodes == before.n_nodes:
            raise InvalidInputError(
                "nodes", f"{nodes} nodes are too few for this domain, {draft.n_nodes} are left; give more"
            )
    return draft
