"""The one view of the explorer where a kernel is: it holds a scene and draws it in the browser."""

from ..errors import missing_extra
from . import scripts

try:
    import anywidget
    import traitlets
except ImportError as error:
    raise missing_extra("anywidget", "widgets") from error


class View(anywidget.AnyWidget):
    """Canvas panels and a table that show a frame of a scene.

    Attributes
    ----------
    atlas : bytes
        As made by `meshlib.explorer.atlas.packed` of one scene; nothing is drawn while it
        is empty.
    frame : int
        0 for the start mesh.
    """

    _esm = scripts.module()
    _css = scripts.styles()
    atlas = traitlets.Bytes().tag(sync=True)
    frame = traitlets.Int(0).tag(sync=True)
