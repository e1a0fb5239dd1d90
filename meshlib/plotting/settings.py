"""The look of all figures in one object: the unit and the meaning of each value."""

from dataclasses import dataclass, field
from typing import Any

# Okabe and Ito's palette, which readers with any kind of colour vision can tell apart.
PALETTE = {
    "black": "#000000",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "green": "#009E73",
    "yellow": "#F0E442",
    "blue": "#0072B2",
    "vermillion": "#D55E00",
    "purple": "#CC79A7",
}


@dataclass(frozen=True)
class Page:
    """Sizes of figures, and the space between their parts."""

    width: float = 9.0  # width of a figure, in inches: 800 pixels on the page
    resolution: int = 120  # dots per inch
    margin: float = 0.03  # space around a mesh, as a fraction of its longer side
    row_height: float = 0.3  # height of a row of `representation`, as a fraction of the width
    surface_share: float = 1.25  # width of a surface in such a row, in widths of the plane panels
    left: float = 0.05  # left end of a row, as a fraction of the width of the figure
    right: float = 0.98  # right end of a row, as a fraction of the width of the figure
    below: float = 0.09  # space below the last row, in heights of a row
    above: float = 0.03  # space above the first row, in heights of a row
    between_panels: float = 0.2  # space between two panels, in mean widths of a panel
    between_rows: float = 0.15  # space between two rows, in mean heights of a panel


@dataclass(frozen=True)
class Colours:
    """Colours by meaning, as matplotlib reads them."""

    ink: str = "#3a3a3a"  # edges of the mesh itself, axes and ticks
    faint: str = "#c4c4c4"  # edges of a mesh in the background, and guides
    shade: str = PALETTE["yellow"]  # shaded elements
    accent: str = PALETTE["vermillion"]  # what a figure is about
    second: str = PALETTE["blue"]  # what the accent is compared with
    paper: str = "white"  # background of figures and axes, in dark mode too
    text: str = "black"  # titles and labels
    shade_opacity: float = 0.55  # opacity of shaded elements, between 0 and 1
    values: str = "viridis"  # colour map of nodal values
    brightest: float = 0.9  # largest part of the colour map in use: beyond it lines on white are too bright


@dataclass(frozen=True)
class Lines:
    """Widths of lines and sizes of marks, in points."""

    edge: float = 0.9  # width of the edges of a mesh
    thin: float = 0.45  # width of edges behind lines of constant value, and on a surface
    thick: float = 2.2  # width of highlighted edges
    contour: float = 1.35  # width of lines of constant value
    node: float = 5.0  # diameter of a marked node


@dataclass(frozen=True)
class Text:
    """Fonts, numbers of nodes, and ticks."""

    family: str = "DejaVu Sans"  # comes with matplotlib
    size: float = 10  # font size of titles, labels and numbers, in points
    tick_size: float = 9  # font size of the coordinates, in points
    number_distance: float = 9.0  # distance of a number from its node, in points
    ticks: int = 3  # largest number of intervals between coordinates along an axis
    tick_digits: int = 9  # decimal places to which coordinates are rounded
    tick_length: float = 2  # length of the marks along an axis, in points
    tick_pad: float = 2  # distance of the coordinates from these marks, in points


@dataclass(frozen=True)
class Surface:
    """The eye, the light and the axes of surfaces, and the number of lines of constant value."""

    view: tuple[float, float] = (32, -60)  # elevation and azimuth of the eye, in degrees
    height: float = 0.62  # height of a surface, as a fraction of the longer side of its domain
    zoom: float = 1.22  # magnification, which fills the space that matplotlib leaves
    tick_pad: float = -2  # distance of the coordinates from the axes, in points
    label_pad: float = -11  # distance of the letters x and y from the coordinates, in points
    light: tuple[float, float, float] = (0.1, -0.55, 0.83)  # direction towards the lamp, of any length
    shadow: float = 0.55  # loss of brightness, as a fraction, of a facet turned away from the lamp
    levels: int = 10  # number of lines of constant value
    refinements: int = 4  # refinements of the 81-node mesh on which functions are drawn


@dataclass(frozen=True)
class Look:
    """All numbers and colours of the figures, in sections.

    The look is the same in all figures; what a single figure needs is said where
    it is drawn, by arguments such as ``colour`` and ``width``.

    Attributes
    ----------
    page : Page
        Sizes of figures and the space between their parts.
    colours : Colours
        Colours by meaning.
    lines : Lines
        Widths of lines and sizes of marks, in points.
    text : Text
        Fonts, numbers of nodes, and ticks.
    surface : Surface
        View, light and axes of surfaces.

    See Also
    --------
    style : Have matplotlib draw in this look.

    Examples
    --------
    >>> LOOK.lines.edge, LOOK.colours.accent
    (0.9, '#D55E00')
    """

    page: Page = field(default_factory=Page)
    colours: Colours = field(default_factory=Colours)
    lines: Lines = field(default_factory=Lines)
    text: Text = field(default_factory=Text)
    surface: Surface = field(default_factory=Surface)

    def settings(self) -> dict[str, Any]:
        """Settings of matplotlib, by the names of ``matplotlib.rcParams``."""
        ink, paper, text = self.colours.ink, self.colours.paper, self.text
        return {
            "figure.dpi": self.page.resolution,
            "savefig.dpi": self.page.resolution,
            **dict.fromkeys(("figure.facecolor", "savefig.facecolor", "axes.facecolor"), paper),
            "text.color": self.colours.text,
            "font.family": text.family,
            **dict.fromkeys(("font.size", "axes.titlesize", "axes.labelsize"), text.size),
            **dict.fromkeys(("xtick.labelsize", "ytick.labelsize"), text.tick_size),
            **dict.fromkeys(("axes.edgecolor", "xtick.color", "ytick.color"), ink),
            "axes.grid": False,
            "svg.hashsalt": "meshlib",  # names in SVG files do not differ from run to run
        }


LOOK = Look()
INK, FAINT = LOOK.colours.ink, LOOK.colours.faint
SHADE, ACCENT, SECOND = LOOK.colours.shade, LOOK.colours.accent, LOOK.colours.second
WIDTH, VIEW, LEVELS = LOOK.page.width, LOOK.surface.view, LOOK.surface.levels
