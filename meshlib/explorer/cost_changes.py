"""Costs of user-defined criteria for the scripts of a page, which know the built-in ones alone.

From one mesh of a scene to the next most costs stay as they are, so an atlas lists those
that change.
"""

from collections.abc import Callable

import numpy as np

from .._typing import IntArray
from ..criteria.criterion import Criterion
from ..mesh.mesh import Mesh
from .scene import Scene

CHANGE = np.dtype([("stage", "u4"), ("p", "u4"), ("q", "u4"), ("r", "u4"), ("cost", "f8")])
LOCAL_COSTS = ("old", "new")  # fields of a trace: local costs before and after a tried swap


def has_formula(criterion: Criterion) -> bool:
    """Whether ``js/costs.js`` computes the costs of a criterion."""
    return not criterion.is_user_defined


def changes(
    scene: Scene, criterion: Criterion, numbers: Callable[[Mesh], IntArray]
) -> list[tuple[int | float, ...]]:
    """The costs that change from mesh to mesh.

    Parameters
    ----------
    scene : Scene
    criterion : Criterion
    numbers : callable
        Gives the number in the atlas of each node of a mesh.

    Returns
    -------
    list of tuple
        Number of the mesh in ``scene.meshes``; three numbers of points, in ascending
        order, that stand for a part (the corners of an element, the ends of an edge with the
        second one twice, or a node three times); and its cost from that mesh on. Before
        its first row a part has cost 0.
    """
    known: dict[tuple[int, ...], float] = {}
    rows = []
    for stage, mesh in enumerate(scene.meshes):
        parts = np.sort(numbers(mesh)[_parts(mesh, criterion.on)], axis=1)
        costs = criterion.costs(mesh, scene.function)
        for part, cost in zip(map(tuple, parts.tolist()), costs.tolist(), strict=True):
            if known.get(part, 0.0) != cost:
                known[part] = cost
                rows.append((stage, *part, cost))
    return rows


def _parts(mesh: Mesh, place: str) -> IntArray:
    """Three nodes for each edge, element or node."""
    if place == "element":
        return mesh.elements
    return mesh.edges[:, [0, 1, 1]] if place == "edge" else np.arange(mesh.n_nodes)[:, None].repeat(3, axis=1)
