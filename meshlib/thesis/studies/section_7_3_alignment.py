"""Alignment of the nodes with the data (section 7.3), and springs that repair it (section 7.4).

A ramp is turned over the lattice of the 81 nodes.  Since the ramp is turned and not the
nodes, the unit square, its mesh and its boundary nodes are the same at every angle.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np

from ... import DataSprings, Interpolant, Mesh, checks, delaunay, problems, refined, smoothed, swapped
from ...movement.smoothed import MOST_SWEEPS
from ...support.random_numbers import Draws
from .measures import GRID_POINTS, L2, Function, Remembered, measured

CRITERION, NORM = "jnd", 2  # as in section 5.2
STEEPNESS = 9 * np.sqrt(2)  # slope of the argument of tanh in SR1 and SR2, across the contours
CENTRE = 0.5  # both coordinates of the point about which the ramp is turned
SPACING = 1 / 8
SLOPES = ((0, 1), (1, 3), (1, 2), (1, 1), (2, 1), (3, 1), (1, 0))  # rise and run of contours
ANGLES = tuple(range(91))  # degrees
BESIDE = 0.5  # degrees from an angle of exact alignment
FINER = 2  # bisections of the lattice that show how it does far from its boundary
JITTERS = (0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)  # largest movements of a node along x and y, in spacings
SEEDS = range(5)
SMALLEST_ANGLE = 8.0  # degrees, the limit of section 6.1
SETTLED = 1e-4  # movement of the nodes at which a smoothing ends, relative to the domain
SKEWNESS = "skewness", "mean"  # measure and statistic


@dataclass(frozen=True)
class Ramp:
    """The ramp of SR2 with its contours at an angle to the x-axis, through the centre of the square.

    Parameters
    ----------
    degrees : float
        Angle of the contours; 45 gives 9/2 times SR1, 135 gives 1 - SR2.
    steepness : float
        Slope of the argument of tanh across the contours.

    Examples
    --------
    >>> x, y = problems.nodes("81").T
    >>> bool(np.allclose(Ramp(45)(x, y), 4.5 * problems.SR1(x, y)))
    True
    """

    degrees: float
    steepness: float = STEEPNESS

    def __call__(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Values at points."""
        return self.profile(self.across(x, y))

    def across(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Distance from the contour through the centre, positive uphill."""
        angle = np.radians(self.degrees)
        return np.cos(angle) * (y - CENTRE) - np.sin(angle) * (x - CENTRE)

    def profile(self, distance: np.ndarray) -> np.ndarray:
        """The value at a distance from the contour through the centre."""
        return (1 + np.tanh(self.steepness * distance)) / 2


def angle_of(rise: int, run: int) -> float:
    """The angle of contours with this slope, in degrees."""
    return float(np.degrees(np.arctan2(rise, run)))


ALIGNED = tuple(angle_of(*slope) for slope in SLOPES)
ALL_ANGLES = tuple(sorted({*ANGLES, *ALIGNED}))


@cache
def lattice(jitter: float = 0.0, seed: int = 0) -> Mesh:
    """The mesh of the 81 nodes, each moved at random.

    Parameters
    ----------
    jitter : float
        Largest movement along x and along y as a fraction of the spacing, from 0 to 0.5.
        Nodes of a side stay on it, and corners where they are.
    seed : int

    Returns
    -------
    Mesh
        A Delaunay mesh.

    Examples
    --------
    >>> lattice(0.5, 1)
    Mesh(81 nodes, 208 edges, 128 elements)
    """
    jitter = checks.number(jitter, "jitter", 0, np.nextafter(0.5, 1), "a share from 0 to 0.5")
    start = problems.mesh("81")
    if jitter == 0:
        return start
    steps = jitter * SPACING * (2 * Draws(seed).uniform(start.nodes.shape) - 1)
    return delaunay(start.nodes + steps * ((start.nodes > 0) & (start.nodes < 1)))


# -- strategies --------------------------------------------------------------------------------


def as_it_is(mesh: Mesh, u: Function) -> Mesh:
    """The mesh itself."""
    return mesh


def only_swapped(mesh: Mesh, u: Function, min_angle: float | None = None) -> Mesh:
    """Edges swapped by JND-L2; on the lattice without jitter in its natural order."""
    order = problems.order("81") if mesh is problems.mesh("81") else None
    return swapped(mesh, u, CRITERION, norm=NORM, order=order, min_angle=min_angle).mesh


def only_moved(
    mesh: Mesh, u: Function, sliding: bool = True, sweeps: int = MOST_SWEEPS, **constants: float
) -> Mesh:
    """Nodes moved by springs that follow the data, to rest or for the given number of sweeps."""
    springs = DataSprings(u, **constants)
    return smoothed(mesh, springs, max_sweeps=sweeps, min_movement=SETTLED, sliding=sliding).mesh


def moved_and_swapped(
    mesh: Mesh, u: Function, sliding: bool = True, min_angle: float | None = None, **constants: Any
) -> Mesh:
    """Nodes moved by springs that follow the data, then edges swapped."""
    return only_swapped(only_moved(mesh, u, sliding, **constants), u, min_angle)


STRATEGIES: dict[str, Callable[[Mesh, Function], Mesh]] = {
    "start": as_it_is,
    "swapped": only_swapped,
    "swapped, 8°": partial(only_swapped, min_angle=SMALLEST_ANGLE),
    "springs": only_moved,
    "springs, boundary fixed, swapped": partial(moved_and_swapped, sliding=False),
    "springs, swapped": moved_and_swapped,
    "springs, swapped, 8°": partial(moved_and_swapped, min_angle=SMALLEST_ANGLE),
}


def adapted(strategy: str, degrees: float, jitter: float = 0.0, seed: int = 0) -> Mesh:
    """The mesh that a strategy makes for the ramp at an angle."""
    return STRATEGIES[strategy](lattice(jitter, seed), Ramp(degrees))


@cache
def measures(strategy: str, degrees: float, jitter: float = 0.0, seed: int = 0) -> tuple[float, float]:
    """L2 error and mean skewness of the mesh that a strategy makes for the ramp at an angle."""
    found = measured(adapted(strategy, degrees, jitter, seed), _remembered(degrees))
    return found[L2], found[SKEWNESS]


@cache
def _remembered(degrees: float) -> Remembered:
    return Remembered(Ramp(degrees))


def curve(
    strategy: str,
    angles: Sequence[float] = ALL_ANGLES,
    jitter: float = 0.0,
    seeds: Iterable[int] = (0,),
) -> np.ndarray:
    """L2 errors and mean skewness at each angle, averaged over the seeds.

    Returns
    -------
    (2, n) ndarray of float64
        Errors, skewness.

    Examples
    --------
    >>> errors, skewness = curve("swapped", (44.5, 45))
    >>> errors.round(4).tolist(), skewness.round(2).tolist()
    ([0.0172, 0.0195], [1.07, 0.35])
    """
    return np.mean([[measures(strategy, a, jitter, seed) for a in angles] for seed in seeds], axis=0).T


# -- lines of nodes ------------------------------------------------------------------------------


def lines_apart(rise: int, run: int) -> float:
    """Distance between the lines of lattice nodes along this slope in lowest terms, in spacings.

    Examples
    --------
    >>> lines_apart(0, 1), round(lines_apart(1, 2), 3)
    (1.0, 0.447)
    """
    return float(1 / np.hypot(rise, run))


def error_between_lines(rise: int, run: int) -> float:
    """L2 error on the square if the ramp is interpolated linearly between its contours through nodes."""
    u, apart = Ramp(angle_of(rise, run)), SPACING * lines_apart(rise, run)
    x = np.linspace(0, 1, GRID_POINTS)
    distance = u.across(*np.meshgrid(x, x, indexing="ij"))
    lines = apart * np.arange(-np.ceil(1 / apart), np.ceil(1 / apart) + 1)
    squares = (u.profile(distance) - np.interp(distance, lines, u.profile(lines))) ** 2
    return float(np.sqrt(np.trapezoid(np.trapezoid(squares, x), x)))


@cache
def error_far_from_boundary(rise: int, run: int) -> float:
    """L2 error after swapping on a lattice refined `FINER` times, for a ramp that is narrower by as much.

    The narrow ramp covers a smaller part of the square; the error is multiplied such that it
    can be compared with that of the wide one.
    """
    scale, mesh = 2**FINER, problems.mesh("81")
    for _ in range(FINER):
        mesh = refined(mesh, np.zeros(mesh.n_nodes), fraction=1).mesh
    u = Ramp(angle_of(rise, run), scale * STEEPNESS)
    found = Interpolant(only_swapped(mesh, u), u)
    return float(found.l2_error(u, points=scale * (GRID_POINTS - 1) + 1, rule="trapezium") * np.sqrt(scale))


# -- other constants, other orders of steps ---------------------------------------------------------

DEFAULT = (0, 100, 0.4)  # first, second, power, as in `DataSprings`
CONSTANTS = (  # first, second, power
    (0, 1, 0.4),
    (0, 10, 0.4),
    DEFAULT,
    (0, 1000, 0.4),
    (100, 0, 0.4),
    (0, 10, 1.0),
    (10, 0, 1.0),
)
TRIAL_ANGLES = tuple(range(0, 91, 5))  # degrees
ROUNDS = (1, 2, 5)  # times that springs and swaps take turns


@cache
def trial(first: float, second: float, power: float, rounds: int = 1) -> np.ndarray:
    """L2 errors at `TRIAL_ANGLES` after the last movement by these springs and after the last swaps.

    Returns
    -------
    (angles, 2) ndarray of float64
    """
    rows = []
    for degrees in TRIAL_ANGLES:
        u, mesh = _remembered(degrees), lattice()
        for _ in range(rounds):
            moved = only_moved(mesh, Ramp(degrees), first=first, second=second, power=power)
            mesh = only_swapped(moved, Ramp(degrees))
        rows.append([measured(m, u)[L2] for m in (moved, mesh)])
    return np.array(rows)


ELSEWHERE = (
    ("SR1", "81"),
    ("SR2", "81"),
    ("SR3", "81"),
    ("SR1", "33"),
    ("SR2", "33"),
    ("franke", "81"),
    ("DD1", "33-refined"),
)
WEIGHTS = 1, 10, 100  # weights of the second derivative in the springs
STOPS = MOST_SWEEPS, MOST_SWEEPS - 5  # sweeps after which springs are stopped
REST = 1e-3  # relative difference of the errors after either up to which springs are at rest


@cache
def elsewhere(function: str, nodes: str) -> tuple[float, ...]:
    """L2 errors on a problem of the thesis: start, swapped, and swapped after springs of all `WEIGHTS`.

    An error is NaN if the springs find no rest, since it depends on when they are stopped.
    """
    u, mesh = problems.functions[function], problems.mesh(nodes)
    known = (measured(found, u)[L2] for found in (mesh, only_swapped(mesh, u)))
    return *known, *(_error_at_rest(mesh, u, weight) for weight in WEIGHTS)


def _error_at_rest(mesh: Mesh, u: Function, weight: float) -> float:
    stopped = (moved_and_swapped(mesh, u, sweeps=most, second=weight) for most in STOPS)
    error, earlier = (measured(found, u)[L2] for found in stopped)
    return error if np.isclose(error, earlier, rtol=REST) else np.nan
