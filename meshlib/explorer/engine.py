"""From settings to a state: the mathematics of the explorer, without widgets or pictures."""
from dataclasses import dataclass
from functools import cache

import numpy as np

from .. import checks, criteria, norms, problems
from ..errors import MeshError
from ..interpolant import Interpolant
from ..marking import MARKS
from ..quality import MEASURES, Quality, quality
from ..refinement import refined
from ..splitting import SPLITS
from ..swapping import swapped

NO_SWAPS = "none"
NORM_NAMES = {1: "L1", 2: "L2", "max": "max", "lexicographic": "lexicographic"}
LARGEST_ANGLE_LIMIT = 30  # degrees; beyond it hardly a swap is left
UNITS = {"maximum_angle": " (°)"}


@dataclass(frozen=True)
class Settings:
    """What the controls of the explorer choose; the names are those of the library."""

    problem: str = "SR1"
    nodes: str = "33"
    criterion: str = "jnd"
    norm: int | str = 2
    min_angle: int = 0
    fraction: float = 0.0
    refine_by: str = "abn"
    mark: str = "element"
    split: str = "centroid"

    def __post_init__(self):
        checks.choice(self.problem, tuple(problems.functions), "function")
        checks.choice(self.nodes, problems.names, "node set")
        checks.choice(self.criterion, (NO_SWAPS, *criteria.names()), "criterion")
        checks.choice(self.norm, norms.NORMS, "norm")
        if self.min_angle not in range(LARGEST_ANGLE_LIMIT + 1):
            raise MeshError("range", f"min_angle is {self.min_angle!r}; give whole degrees "
                            f"from 0 to {LARGEST_ANGLE_LIMIT}")
        checks.fraction(self.fraction)
        checks.choice(self.refine_by, criteria.names(), "criterion")
        checks.choice(self.mark, MARKS, "mark")
        checks.choice(self.split, tuple(SPLITS), "split")

    def __str__(self):
        """As in "SR1 on 33 nodes, JND-L2, angles from 10°, then 20% by ABN (edge, centroid)"."""
        parts = [f"{self.problem} on {self.nodes} nodes"]
        if self.criterion != NO_SWAPS:
            parts.append(f"{self.criterion.upper()}-{NORM_NAMES[self.norm]}")
            parts += [f"angles from {self.min_angle}°"] * bool(self.min_angle)
        if self.fraction:
            parts.append(f"then {self.fraction:.0%} by {self.refine_by.upper()} "
                         f"({self.mark}, {self.split})")
        return ", ".join(parts)


@dataclass(frozen=True)
class Stage:
    """A mesh, what it represents, and how well.

    Attributes
    ----------
    interpolant : Interpolant
    error : (101, 101) ndarray of float64
        u - u_h on a regular grid over the domain.
    l2_error : float
        By the trapezium rule on that grid.
    quality : Quality
    swaps : int
        Swaps made since the start mesh.
    """

    interpolant: Interpolant
    error: np.ndarray
    l2_error: float
    quality: Quality
    swaps: int = 0

    @property
    def mesh(self):
        """The mesh of the interpolant."""
        return self.interpolant.mesh

    @property
    def largest_error(self):
        """Largest absolute error on the grid."""
        return float(np.abs(self.error).max())


@dataclass(frozen=True)
class State:
    """The settings, and the stages before and after the adaptation they ask for."""

    settings: Settings
    start: Stage
    adapted: Stage

    def __str__(self):
        mesh, swaps = self.adapted.mesh, self.adapted.swaps
        return (f"{self.settings}: {mesh.n_edges} edges, {swaps} swap{'s' * (swaps != 1)}, "
                f"L2 error {self.adapted.l2_error:.4f}")

    @property
    def worst(self):
        """Largest error of both stages, at which their colours end."""
        return max(self.start.largest_error, self.adapted.largest_error)

    @property
    def rows(self):
        """The quality table: rows of a label and the numbers before and after, as text."""
        before, after = (_column(stage) for stage in (self.start, self.adapted))
        return [(label, before[label], after[label]) for label in after]


def state(settings):
    """The state that the settings lead to: first edges are swapped, then elements split.

    Parameters
    ----------
    settings : Settings

    Returns
    -------
    State

    Examples
    --------
    >>> found = state(Settings("SR2", "81", criterion="jnd"))
    >>> found.adapted.swaps, round(found.start.l2_error, 6)
    (56, 0.043844)
    """
    start, order = _start(settings.problem, settings.nodes)
    u, mesh, swaps = problems.functions[settings.problem], start.mesh, 0
    if settings.criterion != NO_SWAPS:
        swapping = swapped(mesh, u, settings.criterion, settings.norm, order, settings.min_angle)
        mesh, swaps = swapping.mesh, swapping.swaps
    if settings.fraction:
        mesh = refined(mesh, u, settings.refine_by, settings.fraction, settings.mark,
                       settings.split).mesh
    return State(settings, start, start if mesh is start.mesh else _stage(mesh, u, swaps))


@cache
def _start(problem, nodes):
    return _stage(problems.mesh(nodes), problems.functions[problem]), problems.order(nodes)


def _stage(mesh, u, swaps=0):
    u_h = Interpolant(mesh, u)
    x, y, error = u_h.error_on_grid(u)
    # As Interpolant.l2_error, which would search the grid points a second time.
    l2_error = float(np.sqrt(np.trapezoid(np.trapezoid(error ** 2, x, axis=1), y)))
    return Stage(u_h, error, l2_error, quality(mesh), swaps)


def _column(stage):
    """One column of the quality table, by label."""
    counts = map(str, (*stage.mesh.counts, stage.swaps))
    column = dict(zip(("Nodes", "Edges", "Elements", "Swaps"), counts, strict=True))
    column |= {"L2 error": f"{stage.l2_error:.4f}", "Largest error": f"{stage.largest_error:.4f}"}
    for name, title in MEASURES.items():
        digits = 1 if name in UNITS else 3
        for kind, values in (("mean", stage.quality.mean), ("max", stage.quality.max)):
            column[f"{title}{UNITS.get(name, '')}, {kind}"] = f"{values[name]:.{digits}f}"
    return column
