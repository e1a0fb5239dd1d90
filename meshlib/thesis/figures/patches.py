"""Small meshes for the drawings of chapters 2 and 3, and operations on them."""

import numpy as np
from numpy.typing import ArrayLike

import meshlib as ml
from meshlib.refinement.refined import Refinement
from meshlib.support.random_numbers import Draws

ROW = 0.866  # height of a row of almost equilateral elements
SEED = 3
NEAR = 1e-9  # distance up to which a node lies in the middle of an edge
TRIANGLE = np.array([[0.0, 0.3], [4.2, 0.0], [1.6, 3.4]])
BULGES = [[0.0, -0.25], [0.3, 0.2], [-0.3, 0.25]]  # movements of the midpoints of its three sides
SQUARE = np.array([[0, 0], [0.45, 0], [1, 0], [1, 0.55], [1, 1], [0.55, 1], [0, 1], [0, 0.5], [0.74, 0.3]])


def hexagon(rings: int, jitter: float = 0.0) -> ml.Mesh:
    """Rings of elements around a node, with the inner nodes moved a little at random."""
    i, j = np.mgrid[-rings : rings + 1, -rings : rings + 1].reshape(2, -1)
    nodes = np.column_stack([i + j / 2, ROW * j])[abs(i + j) <= rings]
    mesh = ml.delaunay(nodes)
    moves = jitter * (2 * Draws(SEED).uniform(nodes.shape) - 1)
    return ml.Mesh(nodes + moves * ~mesh.boundary_nodes[:, None], mesh.elements).validate()


def four_elements() -> tuple[ml.Mesh, int]:
    """An element with a neighbour at each side: the mesh, and the number of the element."""
    start = ml.Mesh(TRIANGLE, np.array([[0, 1, 2]]))
    parts = split(start, [0]).mesh
    nodes = parts.nodes + np.vstack([np.zeros((start.n_nodes, 2)), BULGES])
    middle = int((parts.elements >= start.n_nodes).all(axis=1).argmax())
    return ml.Mesh(nodes, parts.elements).validate(), middle


def flipped(mesh: ml.Mesh, edge: int | np.integer) -> ml.Mesh:
    r"""The mesh with an edge a-b replaced by c-d, whether that is allowed or not.

    ::

            c                 c
           /|\               / \
          / | \             / t \
         a--+--b  is  a-b   a   b   --->   (a, d, c) and (d, b, c)
          \ | /             \ s /
           \|/               \ /
            d                 d
    """
    a, b = mesh.edges[edge]
    t, s = mesh.edge_elements[edge]
    c, d = (np.setdiff1d(mesh.elements[k], (a, b))[0] for k in (t, s))
    elements = mesh.elements.copy()
    elements[[t, s]] = [[a, d, c], [d, b, c]]
    return ml.Mesh(mesh.nodes, elements)


def split(mesh: ml.Mesh, chosen: ArrayLike, how: str = "red-green") -> Refinement:
    """Refinement of the chosen elements, by a criterion whose cost is 0 on all others."""
    marked = np.asarray(chosen)

    def cost(*_: np.ndarray) -> np.ndarray:
        return np.isin(np.arange(mesh.n_elements), marked).astype(float)

    criterion = ml.criteria.Criterion("chosen", "element", cost)
    share = len(marked) / mesh.n_elements
    return ml.refined(mesh, np.zeros(mesh.n_nodes), criterion, fraction=share, split=how)


def unclosed(mesh: ml.Mesh, refinement: Refinement) -> ml.Mesh:
    """The mesh with its marked elements split and no others, so that nodes may hang."""
    children = np.isin(refinement.parents, refinement.marked)
    others = np.setdiff1d(np.arange(mesh.n_elements), refinement.marked)
    elements = np.vstack([refinement.mesh.elements[children], mesh.elements[others]])
    return ml.Mesh(refinement.mesh.nodes, elements)


def hanging(mesh: ml.Mesh) -> np.ndarray:
    """Numbers of the nodes that lie in the middle of an edge."""
    middles = mesh.nodes[mesh.edges].mean(axis=1)
    found = np.flatnonzero((abs(mesh.nodes[:, None] - middles).max(axis=2) < NEAR).any(axis=1))
    return np.intersect1d(found, mesh.elements)


def cuts(mesh: ml.Mesh, refinement: Refinement) -> tuple[np.ndarray, np.ndarray]:
    """Edges that divide the elements of a mesh: those of its refinement, those of the closure."""
    new, parents = refinement.mesh, refinement.parents
    t, s = new.edge_elements.T
    inside = (s >= 0) & (parents[t] == parents[s])
    wanted = np.isin(parents[t], refinement.marked) | (new.edges >= mesh.n_nodes).all(axis=1)
    return np.flatnonzero(inside & wanted), np.flatnonzero(inside & ~wanted)
