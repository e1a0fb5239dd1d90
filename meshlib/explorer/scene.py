"""What an explorer shows: a start mesh and what becomes of it, without widgets or pictures."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from .._typing import FloatArray, Function, Norm
from ..criteria.criterion import Criterion
from ..interpolation.interpolant import Interpolant
from ..mesh.mesh import Mesh
from ..mesh.quality import MEASURES, Quality, quality
from ..swapping.procedure import TRACE

GRID = 101  # points along each side of the grid on which the thesis measures errors
SHAPES = ("maximum_angle", "skewness", "aspect_ratio")  # measures of shape in the quality table
UNITS = {"maximum_angle": " (°)"}


@dataclass(frozen=True)
class Scene:
    """A start mesh and the meshes that a procedure makes of it.

    Attributes
    ----------
    title : str
    function : callable
        The vectorised u(x, y) that is interpolated.
    start : Mesh
    film : tuple of Mesh
        The meshes after the start, at least one; the last is the adapted mesh.
    trace : structured array
        Tried swaps as in `meshlib.swapping.swapped.Swapping.history`, which lead from the start to
        the only mesh of the film; then each try is a frame.
    swaps : int
    cost : str or Criterion
        The criterion whose costs are told.
    norm : {1, 2, "max", "lexicographic"}
        The norm by which tried swaps were compared.
    """

    title: str
    function: Function
    start: Mesh
    film: tuple[Mesh, ...]
    trace: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=TRACE))
    swaps: int = 0
    cost: str | Criterion = "jnd"
    norm: Norm = 2

    @property
    def frames(self) -> int:
        """Number of frames; frame 0 is the start mesh."""
        return 1 + (len(self.trace) or len(self.film))

    @property
    def meshes(self) -> list[Mesh]:
        """Every mesh of the frames: the start mesh, and that after each swap of the trace or of the film."""
        if not len(self.trace):
            return [self.start, *self.film]
        return [self.start, *_swapped(self.start, self.trace[self.trace["accepted"]])]

    @cached_property
    def before(self) -> "Stage":
        """The start mesh as a `Stage`."""
        return Stage(self.function, self.start)

    @cached_property
    def after(self) -> "Stage":
        """The adapted mesh as a `Stage`."""
        return Stage(self.function, self.film[-1], self.swaps)

    @property
    def rows(self) -> list[tuple[str, str, str]]:
        """The quality table: rows of a label and the numbers before and after, as text."""
        before, after = (column(stage) for stage in (self.before, self.after))
        return [(label, before[label], after[label]) for label in after]

    def __str__(self) -> str:
        edges = self.film[-1].n_edges
        return (
            f"{self.title}: {edges} edges, {self.swaps} swap{'s' * (self.swaps != 1)}, "
            f"L2 error {significant(self.after.l2_error)}"
        )


#       b                  b
#     / | \              /   \
#    c  |  d    -->     c --- d
#     \ | /              \   /
#       a                  a
def _swapped(mesh: Mesh, swaps: np.ndarray) -> Iterator[Mesh]:
    """The mesh after each of some swaps, which are rows of a trace."""
    elements = mesh.elements.copy()
    for a, b, c, d in swaps[["a", "b", "c", "d"]].tolist():
        at_edge = np.isin(elements, (a, b)).sum(axis=1) == 2
        elements[at_edge] = [c, a, d], [d, b, c]
        yield Mesh(mesh.nodes, elements)


@dataclass(frozen=True)
class Stage:
    """A mesh, what it represents, and how well.

    Attributes
    ----------
    function : callable
    mesh : Mesh
    swaps : int
        Swaps made since the start mesh.
    """

    function: Function
    mesh: Mesh
    swaps: int = 0

    @cached_property
    def interpolant(self) -> Interpolant:
        """The piecewise linear interpolant of the function."""
        return Interpolant(self.mesh, self.function)

    @cached_property
    def error(self) -> FloatArray:
        """(101, 101) float64: |u - u_h| on a regular grid over the domain."""
        return np.abs(self.interpolant.error_on_grid(self.function, GRID)[2])

    @cached_property
    def l2_error(self) -> float:
        """L2 norm of the error, by the trapezium rule on that grid."""
        x, y = _grid(self.mesh)
        # As Interpolant.l2_error, which would search the grid points a second time.
        return float(np.sqrt(np.trapezoid(np.trapezoid(self.error**2, x, axis=1), y)))

    @property
    def largest_error(self) -> float:
        """Largest absolute error on the grid."""
        return float(self.error.max())

    @cached_property
    def quality(self) -> Quality:
        """Shapes of the elements."""
        return quality(self.mesh)


def numbers(stage: Stage) -> dict[str, float]:
    """The numbers of the quality table, by label."""
    counts = zip(("Nodes", "Edges", "Elements", "Swaps"), (*stage.mesh.counts, stage.swaps), strict=True)
    found: dict[str, float] = dict(counts)
    found |= {"L2 error": stage.l2_error, "Largest error": stage.largest_error}
    mean, largest = stage.quality.mean, stage.quality.max
    for name in SHAPES:
        for kind, values in (("mean", mean), ("max", largest)):
            found[f"{MEASURES[name]}{UNITS.get(name, '')}, {kind}"] = values[name]
    return found


def column(stage: Stage) -> dict[str, str]:
    """One column of the quality table: texts by label."""
    return {label: _text(label, number) for label, number in numbers(stage).items()}


def _text(label: str, number: float) -> str:
    if label.endswith("error"):
        return significant(number)
    return str(number) if isinstance(number, int) else f"{number:.{1 if '(°)' in label else 3}f}"


def significant(error: float) -> str:
    """An error with four decimals, or three digits where four decimals would say less."""
    return f"{error:.4f}" if error >= 0.01 or error == 0 else f"{error:.2e}"


def truth(function: Function, mesh: Mesh) -> FloatArray:
    """(101, 101) float64: the function on the grid of the errors, a row for each y."""
    x, y = _grid(mesh)
    return np.broadcast_to(function(x[None, :], y[:, None]), (GRID, GRID))


def _grid(mesh: Mesh) -> FloatArray:
    """(2, 101) float64: x of the columns and y of the rows of the grid over a mesh."""
    low, high = mesh.box
    return np.linspace(low, high, GRID).T
