"""Beyond the local optimum: simulated annealing over swaps (Schumaker 1993)."""

from dataclasses import dataclass, replace

import numpy as np

from .. import checks
from .._typing import FloatArray, Norm, Values
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from ..support.progress import bar
from ..support.random_numbers import Draws
from .swapped import prepared
from .walk import walk_from

LEVELS, TRIES = 200, 20
HIGH = 0.9  # quantile of what a swap adds at the local optimum, where the temperature starts
COLDEST = 1e-3  # of that, where it ends


@dataclass(frozen=True, repr=False, eq=False)
class Annealing(Record):
    """An annealed mesh and how it came about.

    Attributes
    ----------
    mesh : Mesh
        The best mesh found, locally optimal (Definition 3.1.3).
    values : (N,) ndarray of float64
        The nodal values given.
    cost_before, cost_swapped, cost_after : float
        Norm of the cost vector of the start mesh, after the local optimisation procedure
        alone, and of ``mesh``; none is above the one before it.
    temperatures : (L,) ndarray of float64
        From level to level, in units of what the norm sums.
    history : (L,) ndarray of float64
        Norm of the cost vector at the end of each level.
    swaps : int
        Swaps made on the way.
    seed : int
    """

    cost_before: float
    cost_swapped: float
    cost_after: float
    temperatures: FloatArray
    history: FloatArray
    swaps: int
    seed: int


def annealed(
    mesh: Mesh,
    values: Values,
    criterion: str | Criterion = "jnd",
    *,
    norm: Norm = "L2",
    seed: int = 0,
    levels: int = LEVELS,
    tries: int = TRIES,
    min_angle: float | None = None,
    min_area: float | None = None,
    min_gain: float | None = None,
    progress: bool = False,
) -> Annealing:
    """The mesh of low cost that simulated annealing over swaps finds.

    Parameters
    ----------
    mesh, values, criterion, min_angle, min_area, min_gain
        As for `meshlib.swapped`.
    norm : {"L1", "L2"}
        Also 1 and 2.
    seed : int
        Seed of the random numbers, at least 0.
    levels : int
        Number of temperatures.
    tries : int
        Number of times that each edge is tried at each temperature, on average.
    progress : bool
        Whether to show a progress bar: temperatures done.

    Returns
    -------
    Annealing

    Raises
    ------
    MeshError
        As `meshlib.swapped`, or if ``norm``, ``seed``, ``levels`` or ``tries`` is out of range.

    Notes
    -----
    Simulated annealing over swaps, as proposed by Schumaker (1993).  It starts where the
    local optimisation procedure ends.  An edge is drawn at random; a swap that adds d to
    the sum of costs, or of their squares, is made with probability min(1, exp(-d / t)).  The
    temperature t falls geometrically, a thousandfold, from where it is exceeded by a tenth
    of what the possible swaps add at the local optimum.  The procedure then runs once more,
    from the last mesh and from the best at the end of a level; the result is the best of
    three local optima, the first among them, so that it never costs more.  The random
    numbers are the same on every platform and with every version of NumPy.

    Examples
    --------
    >>> from meshlib import optimal, problems
    >>> mesh, u = problems.mesh("33"), problems.SR2
    >>> result, best = annealed(mesh, u, "abn", norm="L1"), optimal(mesh, u, "abn", norm="L1")
    >>> print(f"{result.cost_swapped:.2f} {result.cost_after:.2f} {best.cost_after:.2f}")
    21.74 16.77 16.77
    """
    norm = norms.checked(norm, (1, 2))
    seed, levels = checks.whole(seed, 0, "seed"), checks.whole(levels, 1, "levels")
    tries = checks.whole(tries, 1, "tries")
    procedure = prepared(mesh, values, criterion, norm, min_angle, min_area, min_gain)
    local = _settled(procedure, procedure.mesh)
    walk = walk_from(replace(procedure, mesh=local))
    temperatures = _temperatures(walk.differences(), levels)
    cooling = bar(temperatures, unit="temperature") if progress else temperatures
    reached = [local, *_levels(walk, cooling, tries, local.n_edges, Draws(seed))]
    history = np.array([procedure.cost(found) for found in reached])
    candidates = [local, *(_settled(procedure, found) for found in (reached[history.argmin()], reached[-1]))]
    best = min(candidates, key=procedure.cost)
    costs = (procedure.cost(found) for found in (procedure.mesh, local, best))
    return Annealing(best, procedure.values, *costs, temperatures, history[1:], walk.swaps, seed)


def _settled(procedure, mesh):
    """The mesh after the local optimisation procedure, in the order of its edges."""
    return replace(procedure, mesh=mesh).swapped(np.arange(mesh.n_edges))


def _temperatures(differences, levels):
    """Falling temperatures; none where no swap would change the cost."""
    rises = differences[differences > 0]
    return np.quantile(rises, HIGH) * np.geomspace(1, COLDEST, levels) if len(rises) else np.empty(0)


def _levels(walk, temperatures, tries, n_edges, draws):
    """The mesh at the end of each level."""
    for temperature in temperatures:
        edges = draws.indices(n_edges, tries * n_edges)
        rises = temperature * draws.exponential(len(edges))  # d < rise has probability exp(-d / t)
        walk.go(edges, rises)
        yield walk.mesh
