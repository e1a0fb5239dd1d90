"""The tables of an atlas.

Meshes of an atlas have most of their nodes and elements in common, so these are stored
once, and a mesh is the list of the numbers of its elements.
"""

from collections.abc import Sequence, Sized
from typing import Any

import numpy as np

from .._typing import IntArray
from ..criteria.norms import checked
from ..criteria.registry import get
from ..mesh.mesh import Mesh
from .cost_changes import CHANGE, LOCAL_COSTS, changes, has_formula
from .scene import Scene, truth

TRIED = ("a", "b", "c", "d", "accepted")
NOTHING_TRIED = np.empty((len(TRIED), 0), dtype=int)


class Tables:
    """Points, elements, meshes and scenes, each numbered in the order of first use."""

    def __init__(self) -> None:
        self.captions: list[dict[str, Any]] = []
        self._points: dict[tuple[float, ...], int] = {}
        self._elements: dict[tuple[int, ...], int] = {}
        self._meshes: dict[tuple[int, ...], int] = {}
        self._truths: dict[tuple[Any, ...], tuple[int, Scene]] = {}
        self._columns: dict[str, list[int]] = {"truth": [], "start": [], "swaps": []}
        # a row for each scene
        self._films: list[list[int]] = []
        self._tried: list[Any] = []
        self._changes: list[list[tuple[int | float, ...]]] = []
        self._local_costs: list[Any] = []

    def add(self, scene: Scene) -> None:
        """Take in a scene."""
        points = self._point_numbers(scene, scene.start)
        self._columns["truth"].append(self._truth_number(scene))
        self._columns["swaps"].append(scene.swaps)
        self._columns["start"].append(self._mesh_number(scene, scene.start))
        self._films.append([self._mesh_number(scene, mesh) for mesh in scene.film])
        self._tried.append(_tried(scene, points))
        self._add_costs(scene)

    def _add_costs(self, scene: Scene) -> None:
        """The caption of a scene, and costs that the scripts cannot compute."""
        criterion = get(scene.cost)
        caption = {"title": scene.title, "cost": criterion.name, "on": criterion.on}
        self.captions.append(caption | {"norm": str(checked(scene.norm))})
        if has_formula(criterion):
            self._changes.append([])
            self._local_costs.append([])
            return
        self.captions[-1]["given"] = True
        self._changes.append(changes(scene, criterion, lambda mesh: self._point_numbers(scene, mesh)))
        self._local_costs.append(scene.trace)

    def _truth_number(self, scene: Scene) -> int:
        name = getattr(scene.function, "name", None) or id(scene.function)
        box = tuple(np.ravel(scene.start.box).tolist())
        return self._truths.setdefault((name, box), (len(self._truths), scene))[0]

    def _point_numbers(self, scene: Scene, mesh: Mesh) -> IntArray:
        values = scene.function(*mesh.nodes.T)
        rows = np.column_stack([mesh.nodes, values]).tolist()
        return np.array([self._points.setdefault(tuple(row), len(self._points)) for row in rows])

    def _mesh_number(self, scene: Scene, mesh: Mesh) -> int:
        corners = self._point_numbers(scene, mesh)[mesh.elements]
        turn = corners.argmin(axis=1)[:, None]  # counter-clockwise from the smallest
        corners = np.take_along_axis(corners, (turn + np.arange(3)) % 3, axis=1)
        # in their order, since of elements that meet at a point of the grid the last decides
        numbers = [self._elements.setdefault(tuple(row), len(self._elements)) for row in corners.tolist()]
        return self._meshes.setdefault(tuple(numbers), len(self._meshes))

    def arrays(self) -> dict[str, np.ndarray]:
        """All that has been taken in, as flat arrays by name."""
        points = np.array(list(self._points))
        scenes = [scene for _, scene in self._truths.values()]
        meshes = list(self._meshes)
        return (
            {
                "x": points[:, 0],
                "y": points[:, 1],
                "u": points[:, 2],
                "grids": np.stack([truth(s.function, s.start) for s in scenes]).astype("f4"),
                "elements": np.array(list(self._elements)),
                "meshes": _starts(meshes),
                "members": np.concatenate([_steps(m) for m in meshes]),
                "films": _starts(self._films),
                "film": np.concatenate(self._films),
                "traces": _starts([t[0] for t in self._tried]),
            }
            | {name: np.array(column) for name, column in self._columns.items()}
            | dict(zip(TRIED, np.hstack(self._tried), strict=True))
            | self._given_costs()
        )

    def _given_costs(self) -> dict[str, np.ndarray]:
        """Tables of the costs that the scripts cannot compute; none if they can compute all."""
        if not any("given" in caption for caption in self.captions):
            return {}
        rows = np.array([row for rows in self._changes for row in rows], dtype=CHANGE)
        local = [[row[name] for rows in self._local_costs for row in rows] for name in LOCAL_COSTS]
        return (
            {"changes": _starts(self._changes), "tries": _starts(self._local_costs)}
            | {name: rows[name] for name in CHANGE.fields or ()}
            | {name: np.array(costs, dtype=float) for name, costs in zip(LOCAL_COSTS, local, strict=True)}
        )


def _tried(scene: Scene, points: IntArray) -> Any:
    """The columns of the trace, with numbers of points in place of those of nodes."""
    if not len(scene.trace):
        return NOTHING_TRIED
    return [points[scene.trace[field]] if field in "abcd" else scene.trace[field] for field in TRIED]


def _starts(rows: Sequence[Sized]) -> IntArray:
    """Where each row begins once they are joined, and where the last one ends."""
    return np.concatenate([[0], np.cumsum([len(row) for row in rows])])


def _steps(numbers: Sequence[int]) -> IntArray:
    """Differences of the numbers, 0, -1, 1, -2, ... as 0, 1, 2, 3, ...: they are small and often equal."""
    steps = np.diff(numbers, prepend=0)
    return np.where(steps < 0, -2 * steps - 1, 2 * steps)
