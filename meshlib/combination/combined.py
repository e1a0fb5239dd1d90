"""Swapping and moving combined, patch by patch (Algorithm 7.5.1)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import checks, criteria
from .._typing import BoolArray, Function, IntArray, NDArray, Norm
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..errors import InvalidInputError, UnknownNameError
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from ..mesh.topology import canonical
from ..mesh.validation import halved
from ..swapping.swapped import prepared
from .patch import Objective, Patch

WAYS = ("swap", "move")
LEAST_GAIN = 1e-6  # gain that a step must exceed, as a fraction of the indicator of the start mesh
STEP = np.dtype(
    [("sweep", np.int32), ("node", np.int32), ("way", "U4"), ("gain", np.float64), ("indicator", np.float64)]
)


@dataclass(frozen=True, repr=False, eq=False)
class Combination(Record):
    """A mesh that was swapped and moved, and the steps that led to it.

    Attributes
    ----------
    mesh : Mesh
        The new mesh.
    values : (N,) ndarray of float64
        Values of u at the nodes of the new mesh.
    cost_before, cost_after : float
        Norm of the cost vector of the start mesh and of the new one.
    sweeps : int
        Number of sweeps over all interior nodes.
    period : int
        0 if the last sweep changed nothing; -1 if the largest number of sweeps was reached;
        else the procedure came back to an earlier mesh, and would do so again every
        ``period`` sweeps.
    indicator : float
        Indicator of the start mesh: the sum of its costs, or of their squares.
    history : (n,) structured ndarray
        A row for each accepted step, with the fields ``sweep``, ``node``, ``way`` (``"swap"``
        or ``"move"``), ``gain``, by which the indicator of the patch fell, and
        ``indicator``, that of the whole mesh after the step.

    See Also
    --------
    combined : makes such records.
    """

    cost_before: float
    cost_after: float
    sweeps: int
    period: int
    indicator: float
    history: NDArray[Any]


def combined(
    mesh: Mesh,
    function: Function,
    criterion: str | Criterion | None = None,
    *,
    norm: Norm = "L2",
    ways: str | Sequence[str] = WAYS,
    rim: bool = True,
    min_angle: float | None = None,
    min_relative_gain: float = LEAST_GAIN,
    max_sweeps: int = 1000,
) -> Combination:
    """The mesh after the combined strategy: on each patch the better of swapping and moving.

    For one interior node after the other, two changes of the patch of elements around it
    are tried: its inner edges are swapped, or the node is moved to the best position found.
    The change that lowers the indicator of the error more is made, if it gains enough.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    function : callable
        Vectorised u(x, y).  Nodal values are not enough, since nodes move.
    criterion : str or Criterion, optional
        The indicator is the sum of the costs of this criterion, or of their squares.  By
        default that of the min-error criterion, the square of the L2 error.
    norm : {"L1", "L2"}
        Whether costs or their squares are summed; also 1 and 2.
    ways : sequence of {"swap", "move"}, or one of them
        Changes to try.
    rim : bool
        Whether the indicator of a patch includes the costs on its rim, which a step
        changes too.  Without them each patch is treated as a separate domain, as in the
        thesis.
    min_angle : float, optional
        Smallest angle, in degrees, that a step may create.
    min_relative_gain : float
        Gain that a step must exceed, as a fraction of the indicator of the start mesh; above
        0 and below 1.
    max_sweeps : int
        Largest number of sweeps over all interior nodes, at least 1.

    Returns
    -------
    Combination

    Raises
    ------
    MeshError
        If the mesh is not valid, a name is not known, or an argument is out of range.

    See Also
    --------
    meshlib.swapped, meshlib.smoothed : swapping alone, and moving nodes alone.
    meshlib.approximate : the fast way to a small L2 error, for large meshes.

    Notes
    -----
    *Termination.*  With ``rim``, or if costs belong to elements, there are at most
    ``1 / min_relative_gain`` steps.  All costs that a step changes are part of the indicator
    of its patch; so the indicator of the mesh, which is never negative, falls by the same
    gain.  Without ``rim`` a criterion on edges or nodes may lose beside a patch what it gains
    inside, and the procedure can come back to an earlier mesh.  This is checked after each
    sweep, and ends the procedure.

    The procedure is meant for meshes of a few hundred nodes, with any criterion.

    Examples
    --------
    >>> from meshlib import problems
    >>> result = combined(problems.mesh("33"), problems.SR1, max_sweeps=2)
    >>> bool(result.history["indicator"][-1] < 0.1 * result.indicator)
    True
    """
    mesh = checks.a_mesh(mesh)
    objective = _objective(mesh, function, criterion, norm, rim, min_angle)
    ways = _ways(ways)
    share = checks.number(
        min_relative_gain,
        "min_relative_gain",
        np.nextafter(0, 1),
        1,
        "a share above 0 and below 1, since ever smaller gains need never end",
    )
    run = _Run(mesh, objective, ways, share)
    period = run.sweep(checks.whole(max_sweeps, 1, "max_sweeps"))
    green = mesh.green[halved(run.nodes, run.elements, mesh.green) & run.untouched(mesh)]
    result = Mesh._trusted(run.nodes, run.elements, green)
    before, after = (of ** (1 / objective.norm) for of in (run.indicator, run.reached))
    history = np.array(run.steps, dtype=STEP)
    return Combination(result, run.values, before, after, run.count, period, run.indicator, history)


def _objective(
    mesh: Mesh,
    function: Function,
    criterion: str | Criterion | None,
    norm: Norm,
    rim: bool,
    min_angle: float | None,
    degree: int = 12,
) -> Objective:
    """The indicator, from checked arguments of `combined`; ``degree`` is that of the default quadrature."""
    if not callable(function):
        raise InvalidInputError(
            "type",
            f"u is a {type(function).__name__}; give a function u(x, y), "
            "since nodes move to where there is no value",
        )
    power = int(norms.checked(norm, (1, 2)))
    criterion = criteria.min_error(function, degree=degree) if criterion is None else criterion
    swap = prepared(mesh, function, criterion, power, min_angle, None, None)
    return Objective(function, swap.criterion, power, swap.tolerance, swap.limits, bool(rim))


def _ways(ways: str | Sequence[str]) -> tuple[str, ...]:
    """The ways to change a patch as a tuple, or a MeshError."""
    ways = (ways,) if isinstance(ways, str) else tuple(ways)
    for way in ways:
        checks.choice(way, WAYS, "way")
    if not ways:
        raise UnknownNameError("unknown", "no way to change a patch is given; name 'swap', 'move' or both")
    return ways


class _Run:
    """The arrays of a mesh that is being changed, and the steps so far."""

    rounding = 1e-12  # rounding error of the indicator of a patch, as a fraction of it

    def __init__(self, mesh: Mesh, objective: Objective, ways: tuple[str, ...], share: float) -> None:
        self.objective, self.ways = objective, ways
        self.nodes, self.elements = mesh.nodes.copy(), mesh.elements.copy()
        self.values = objective.function(*mesh.nodes.T).astype(float)
        self.inside = ~mesh.boundary_nodes
        self.due = self.inside.copy()  # nodes whose patch changed since no step was found for it
        self.indicator = objective.of(mesh)
        noise = objective.tolerance[1] ** objective.norm
        self.least, self.count = max(share * self.indicator, noise), 0
        self.steps: list[tuple[int, int, str, float, float]] = []  # rows of the history

    def sweep(self, most: int) -> int:
        """Sweep until nothing changes or an earlier mesh comes back; returns the period."""
        seen = {self._key(): 0}
        for self.count in range(1, most + 1):
            before = len(self.steps)
            for node in range(len(self.due)):
                if self.due[node]:
                    self._improve(node)
            if len(self.steps) == before:
                return 0
            key = self._key()
            if key in seen:
                return self.count - seen[key]
            seen[key] = self.count
        return -1

    def _key(self) -> bytes:
        return self.nodes.tobytes() + canonical(self.elements).tobytes()

    def _improve(self, node: int) -> None:
        """Steps 2 (a) to (c) of the algorithm, for the patch around a node."""
        patch = self.objective.patch(self.nodes, self.elements, self.values, node)
        found = [getattr(patch, {"swap": "swapped", "move": "moved"}[way])() for way in self.ways]
        gains = [patch.error - changed.error for changed in found]
        k = int(np.argmax(gains))
        self.due[node] = gains[k] > max(self.least, self.rounding * patch.error)
        if not self.due[node]:
            return
        self._take(found[k])
        after = self.objective.of(Mesh._trusted(self.nodes.copy(), self.elements.copy()))
        self.steps.append((self.count, node, self.ways[k], gains[k], after))

    def _take(self, patch: Patch) -> None:
        """Make the step that leads to this patch."""
        self.elements[patch.rows] = patch.own
        centre = patch.used[patch.centre]
        self.nodes[centre], self.values[centre] = patch.nodes[patch.centre], patch.values[patch.centre]
        self._wake(patch.own)

    def _wake(self, changed: IntArray) -> None:
        """Mark the nodes whose patches have costs that depend on elements that changed, (n, 3)."""
        if self.objective.criterion.on != "element":
            here = np.zeros(len(self.nodes), dtype=bool)
            here[changed] = True
            changed = self.elements[here[self.elements].any(axis=1)]
        self.due[changed] = self.inside[changed]

    @property
    def reached(self) -> float:
        """Indicator of the mesh as it is."""
        return self.steps[-1][-1] if self.steps else self.indicator

    def untouched(self, mesh: Mesh) -> BoolArray:
        """For each green pair of the start mesh whether both elements are still in their rows."""
        return (self.elements[mesh.green] == mesh.elements[mesh.green]).all(axis=(1, 2))
