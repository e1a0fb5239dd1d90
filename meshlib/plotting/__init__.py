"""Pictures of meshes and of piecewise linear interpolants, with matplotlib.

Every function draws on axes that it is given; `panels` and `representation` make
a figure of their own, in the look that `style` sets.
"""

from .look import ACCENT, FAINT, INK, PALETTE, SECOND, SHADE, WIDTH, bare, framed, panels, style
from .meshes import edges_not_in, highlight_edges, mark_nodes, number_nodes, plot_mesh, shade_elements
from .rows import function_view, representation
from .surfaces import LEVELS, VIEW, plot_contours, plot_surface, spaced, value_limits

__all__ = [
    "ACCENT",
    "FAINT",
    "INK",
    "LEVELS",
    "PALETTE",
    "SECOND",
    "SHADE",
    "VIEW",
    "WIDTH",
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
