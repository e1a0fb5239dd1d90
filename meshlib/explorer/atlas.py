"""Scenes as bytes that a browser can read: an atlas holds one scene, or all of a page.

Meshes of an atlas have most of their nodes and elements in common, so these are stored
once, and a mesh is the list of the numbers of its elements.
"""

import json

import numpy as np

from ..criteria.registry import get
from .scene import truth

ALIGNED = 8  # bytes, the size of the largest item
LITTLE_ENDIAN = {"f8": "<f8", "f4": "<f4", "u1": "<u1", "u2": "<u2", "u4": "<u4"}
TRIED = ("a", "b", "c", "d", "accepted")
NOTHING_TRIED = np.empty((len(TRIED), 0), dtype=int)


def packed(exploration, scenes, index=None):
    """The atlas of some scenes.

    Parameters
    ----------
    exploration : Exploration
    scenes : sequence of Scene
    index : sequence of int, optional
        Number of the scene for each setting of a page.

    Returns
    -------
    bytes
        A header in JSON, preceded by its length (uint32), and the little-endian arrays
        that it lists by name, type, offset and length.
    """
    tables = _Tables()
    for scene in scenes:
        tables.add(scene)
    header = {
        "name": exploration.name,
        "film": exploration.film,
        "scenes": tables.captions,
        "initial": {name: str(value) for name, value in exploration.initial.items()},
        "controls": [_described(control) for control in exploration.controls],
    }
    return _joined(header, tables.arrays() | {"index": np.array(index or [0])})


def pages(exploration, map=map):
    """The atlas of all settings on a page; a parallel ``map`` may compute them.

    Settings that lead to the same scene, such as rules for a share of nothing, share it.
    """
    scenes, numbers, index = {}, {}, []
    for scene in map(exploration.computed, exploration.pages()):
        scenes.setdefault(scene.title, scene)
        index.append(numbers.setdefault(scene.title, len(numbers)))
    return packed(exploration, list(scenes.values()), index)


def _described(control):
    return {
        "name": control.name,
        "label": control.label,
        "kind": control.kind,
        "values": [str(value) for value in control.paged],
        "texts": [control.text(value) for value in control.paged],
    }


class _Tables:
    """Nodes, elements, meshes and scenes, each met for the first time at its number."""

    def __init__(self):
        self.captions = []
        self._points, self._elements, self._meshes, self._truths = {}, {}, {}, {}
        self._films, self._tried = [], []
        self._columns = {name: [] for name in ("truth", "start", "swaps")}

    def add(self, scene):
        """Take in a scene."""
        cost = get(scene.cost)
        self.captions.append(
            {"title": scene.title, "cost": cost.name, "on": cost.on, "norm": str(scene.norm)}
        )
        name = getattr(scene.function, "name", None) or id(scene.function)
        points = self._point_numbers(scene, scene.start)
        truth_number = self._truths.setdefault(name, (len(self._truths), scene))[0]
        for column, value in (
            ("truth", truth_number),
            ("swaps", scene.swaps),
            ("start", self._mesh_number(scene, scene.start)),
        ):
            self._columns[column].append(value)
        self._films.append([self._mesh_number(scene, mesh) for mesh in scene.film])
        self._tried.append(
            [points[scene.trace[field]] if field in "abcd" else scene.trace[field] for field in TRIED]
            if len(scene.trace)
            else NOTHING_TRIED
        )

    def _point_numbers(self, scene, mesh):
        values = scene.function(*mesh.nodes.T)
        rows = np.column_stack([mesh.nodes, values]).tolist()
        return np.array([self._points.setdefault(tuple(row), len(self._points)) for row in rows])

    def _mesh_number(self, scene, mesh):
        corners = self._point_numbers(scene, mesh)[mesh.elements]
        turn = corners.argmin(axis=1)[:, None]  # counter-clockwise from the smallest
        corners = np.take_along_axis(corners, (turn + np.arange(3)) % 3, axis=1)
        # in their order, since of elements that meet at a point of the grid the last decides
        numbers = [self._elements.setdefault(tuple(row), len(self._elements)) for row in corners.tolist()]
        return self._meshes.setdefault(tuple(numbers), len(self._meshes))

    def arrays(self):
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
        )


def _starts(rows):
    """Where each row begins once they are joined, and where the last one ends."""
    return np.concatenate([[0], np.cumsum([len(row) for row in rows])])


def _steps(numbers):
    """Differences, which are small and repeat themselves: 0, -1, 1, -2, ... as 0, 1, 2, 3, ..."""
    steps = np.diff(numbers, prepend=0)
    return np.where(steps < 0, -2 * steps - 1, 2 * steps)


def _joined(header, arrays):
    listed, blocks, offset = {}, [], 0
    for name, array in arrays.items():
        kind = _smallest_type(array)
        block = array.ravel().astype(LITTLE_ENDIAN[kind]).tobytes()
        listed[name] = [kind, offset, array.size]
        blocks.append(block + bytes(-len(block) % ALIGNED))
        offset += len(blocks[-1])
    text = json.dumps(header | {"arrays": listed}, ensure_ascii=False).encode()
    text += b" " * (-(len(text) + 4) % ALIGNED)
    return len(text).to_bytes(4, "little") + text + b"".join(blocks)


def _smallest_type(array):
    if array.dtype == "f4":
        return "f4"
    if array.dtype.kind == "f":
        return "f8"
    return next(kind for kind in ("u1", "u2", "u4") if array.max(initial=0) <= np.iinfo(kind).max)
