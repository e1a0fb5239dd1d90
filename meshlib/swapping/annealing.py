"""Beyond the local optimum: simulated annealing over swaps (Schumaker 1993)."""

from collections.abc import Iterable, Iterator
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
from .procedure import Procedure
from .swapped import prepared
from .walk import _Compiled, _Plain, walk_from


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
        Temperature of each level, in the unit of the costs (L1) or of their squares (L2).
    history : (L,) ndarray of float64
        Norm of the cost vector at the end of each level.
    swaps : int
        Number of swaps made at all levels, not counting those of the local optimisation procedure.
    seed : int
        The seed given.
    """

    values: FloatArray
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
    levels: int = 200,
    tries: int = 20,
    progress: bool = False,
    **limits: float | None,
) -> Annealing:
    """The mesh of low cost that simulated annealing over swaps finds.

    Parameters
    ----------
    mesh, values, criterion
        As for `meshlib.swapped`.
    norm : {"L1", "L2"}
        Norm of the cost vector to lower; 1 and 2 are other names.
    seed : int
        Seed of the random numbers, at least 0.
    levels : int
        Number of temperatures.
    tries : int
        Number of times that each edge is tried at each temperature, on average.
    progress : bool
        Whether to show a progress bar, which counts temperatures.
    **limits
        ``min_angle``, ``min_area`` and ``min_gain``, as for `meshlib.swapped`.

    Returns
    -------
    Annealing

    Raises
    ------
    MeshError
        As `meshlib.swapped`, or if ``norm``, ``seed``, ``levels`` or ``tries`` is out of range.

    See Also
    --------
    swapped : The local optimisation procedure alone.
    local_optima : The best of many edge orders.
    optimal : The best of all meshes, proved, where there are few nodes.

    Notes
    -----
    Simulated annealing over swaps was proposed by Schumaker (1993).  It starts where the
    local optimisation procedure ends.  An edge is drawn at random; a swap that adds d to
    the sum of the costs (L2: of their squares) is made with probability min(1, exp(-d / t)).
    The temperature t falls geometrically to a thousandth of its first value.  The first
    value is the 90 % quantile of the positive d of all possible swaps at the local optimum.
    The procedure then runs twice more, from the last mesh and from the best mesh at the
    end of a level.  The result is the best of the three local optima, so that it never
    costs more than the first.  The random numbers are the same on every platform and with
    every version of NumPy.

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
    procedure = prepared(mesh, values, criterion, norm, **limits)
    local = _settled(procedure, procedure.mesh)
    walk = walk_from(replace(procedure, mesh=local))
    temperatures = _Cooling().temperatures(walk.differences(), levels)
    cooling = bar(temperatures, unit="temperature") if progress else temperatures
    reached = [local, *_levels(walk, cooling, tries, local.n_edges, Draws(seed))]
    history = np.array([procedure.cost(found) for found in reached])
    candidates = [local, *(_settled(procedure, found) for found in (reached[history.argmin()], reached[-1]))]
    best = min(candidates, key=procedure.cost)
    start, swapped, after = (procedure.cost(found) for found in (procedure.mesh, local, best))
    return Annealing(
        best, procedure.values, start, swapped, after, temperatures, history[1:], walk.swaps, seed
    )


@dataclass(frozen=True)
class _Cooling:
    """How the temperature falls, level by level."""

    start: float = 0.9  # first temperature, as a quantile of the rises by one swap at the local optimum
    end: float = 1e-3  # last temperature, as a fraction of the first

    def temperatures(self, differences: FloatArray, levels: int) -> FloatArray:
        """Falling temperatures; none where no swap would raise the cost."""
        rises = differences[differences > 0]
        if not len(rises):
            return np.empty(0)
        return np.quantile(rises, self.start) * np.geomspace(1, self.end, levels)


def _settled(procedure: Procedure, mesh: Mesh) -> Mesh:
    """The mesh after the local optimisation procedure, in the order of its edges."""
    return replace(procedure, mesh=mesh).swapped(np.arange(mesh.n_edges))


def _levels(
    walk: _Compiled | _Plain, temperatures: Iterable[float], tries: int, n_edges: int, draws: Draws
) -> Iterator[Mesh]:
    """The mesh at the end of each level."""
    for temperature in temperatures:
        edges = draws.indices(n_edges, tries * n_edges)
        rises = temperature * draws.exponential(len(edges))  # d < rise has probability exp(-d / t)
        walk.go(edges, rises)
        yield walk.mesh
