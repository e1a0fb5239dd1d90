"""The one view of the explorer: it holds a state as plain data and draws it in the browser."""
from pathlib import Path

import numpy as np

from ..errors import missing_extra
from ..plotting import spaced, value_limits

try:
    import anywidget
    import traitlets
except ImportError as error:
    raise missing_extra("anywidget", "widgets") from error

HERE = Path(__file__).parent
SCRIPTS = ("drawing.js", "view.js")
STAGES = ("start", "adapted")


class View(anywidget.AnyWidget):
    """Canvas panels and a table that show one stage of a packed state.

    Attributes
    ----------
    state : dict
        As made by `packed`; nothing is drawn while it is empty.
    shown : int
        0 for the start mesh, 1 for the adapted one.
    """

    _esm = "\n".join((HERE / name).read_text(encoding="utf-8") for name in SCRIPTS)
    _css = (HERE / "view.css").read_text(encoding="utf-8")
    state = traitlets.Dict().tag(sync=True)
    shown = traitlets.Int(1).tag(sync=True)


def packed(state):
    """A state as numbers, text and bytes, all that the browser needs to draw it.

    Parameters
    ----------
    state : meshlib.explorer.engine.State

    Returns
    -------
    dict
        ``title``, ``rows`` (the quality table), ``limits`` and ``levels`` of the
        values, ``worst`` (the largest error of both stages), and ``stages``: two
        dicts of little-endian arrays, ``nodes``, ``values`` and ``error`` of
        float32, ``elements`` and ``edges`` of uint16.
    """
    stages = state.start, state.adapted
    limits = value_limits(*(stage.interpolant for stage in stages))
    return {"title": str(state), "rows": [list(row) for row in state.rows], "limits": list(limits),
            "levels": spaced(limits).tolist(), "worst": state.worst,
            "stages": list(map(_packed_stage, STAGES, stages))}


def _packed_stage(name, stage):
    mesh = stage.mesh
    floats = {"nodes": mesh.nodes, "values": stage.interpolant.values, "error": np.abs(stage.error)}
    integers = {"elements": mesh.elements, "edges": mesh.edges}
    return ({"name": name} | {key: array.astype("<f4").tobytes() for key, array in floats.items()}
            | {key: array.astype("<u2").tobytes() for key, array in integers.items()})
