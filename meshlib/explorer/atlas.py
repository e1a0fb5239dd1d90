"""Scenes as bytes that a browser can read: an atlas holds one scene, or all of a page."""

import json
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from ..criteria.registry import get
from .controls import Control, Exploration
from .scene import Scene
from .tables import Tables

ALIGNED = 8  # bytes to a multiple of which each array begins: the size of the largest item
LITTLE_ENDIAN = {"f8": "<f8", "f4": "<f4", "u1": "<u1", "u2": "<u2", "u4": "<u4"}


def packed(exploration: Exploration, scenes: Sequence[Scene], index: Sequence[int] | None = None) -> bytes:
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
    tables = Tables()
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


def pages(exploration: Exploration, map: Callable[..., Iterable[Scene]] = map) -> bytes:
    """The atlas of all settings on a page.

    Settings that lead to the same scene, such as rules that mark no element, share it.

    Parameters
    ----------
    exploration : Exploration
    map : callable, optional
        In place of Python's own, to compute scenes in parallel.

    Returns
    -------
    bytes
        As made by `packed`.
    """
    scenes: dict[tuple[str, str], Scene] = {}
    numbers: dict[tuple[str, str], int] = {}
    index = []
    for scene in map(exploration.computed, exploration.pages()):
        shown = scene.title, get(scene.cost).name
        scenes.setdefault(shown, scene)
        index.append(numbers.setdefault(shown, len(numbers)))
    return packed(exploration, list(scenes.values()), index)


def _described(control: Control) -> dict[str, Any]:
    texts = control.texts_by_value
    return {
        "name": control.name,
        "label": control.label,
        "kind": control.kind,
        "values": [str(value) for value in control.paged],
        "texts": [texts[value] for value in control.paged],
    }


def _joined(header: dict[str, Any], arrays: dict[str, np.ndarray]) -> bytes:
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


def _smallest_type(array: np.ndarray) -> str:
    if array.dtype == "f4":
        return "f4"
    if array.dtype.kind == "f":
        return "f8"
    return next(kind for kind in ("u1", "u2", "u4") if array.max(initial=0) <= np.iinfo(kind).max)
