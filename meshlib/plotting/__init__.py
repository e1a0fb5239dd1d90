"""Pictures of meshes and of piecewise linear interpolants, with matplotlib.

Most functions draw on axes that they are given; `panels`, `representation` and
`function_view` make a new figure.  All colours and sizes are in `LOOK`.
"""

from .look import bare, framed, panels, style
from .meshes import edges_not_in, highlight_edges, mark_nodes, number_nodes, plot_mesh, shade_elements
from .rows import function_view, representation
from .settings import ACCENT, FAINT, INK, LEVELS, LOOK, PALETTE, SECOND, SHADE, VIEW, WIDTH, Look
from .surfaces import plot_contours, plot_surface, spaced, value_limits

__all__ = [
    "ACCENT",
    "FAINT",
    "INK",
    "LEVELS",
    "LOOK",
    "PALETTE",
    "SECOND",
    "SHADE",
    "VIEW",
    "WIDTH",
    "Look",
    "bare",
    "edges_not_in",
    "framed",
    "function_view",
    "highlight_edges",
    "mark_nodes",
    "number_nodes",
    "panels",
    "plot_contours",
    "plot_mesh",
    "plot_surface",
    "representation",
    "shade_elements",
    "spaced",
    "style",
    "value_limits",
]
