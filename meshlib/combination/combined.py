"""Swapping and moving combined, patch by patch (Algorithm 7.5.1)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import checks, criteria
from .._typing import Function, Norm
from ..criteria import norms
from ..criteria.criterion import Criterion
from ..errors import InvalidInputError, UnknownNameError
from ..interpolation.record import Record
from ..mesh.mesh import Mesh
from ..mesh.topology import canonical
from ..mesh.validation import halved
from ..swapping.swapped import prepared
from .patch import Objective

WAYS = ("swap", "move")
NORMS = (1, 2)
LEAST_GAIN = 1e-6  # of the indicator at the start
ROUNDING = 1e-12  # of the indicator of a patch
MOST_SWEEPS = 1000
DEGREE = 12  # of the quadrature of the default indicator
STEP = np.dtype(
    [("sweep", np.int32), ("node", np.int32), ("way", "U4"), ("gain", np.float64), ("indicator", np.float64)]
)


@dataclass(frozen=True, repr=False, eq=False)
class Combination(Record):
    """A mesh swapped and moved, and how it came about.

    Attributes
    ----------
    mesh : Mesh
    values : (N,) ndarray of float64
        Values of u at its nodes.
    cost_before, cost_after : float
        Norm of the cost vector of the start mesh and of the new one.
    sweeps : int
        Number of sweeps over all interior nodes.
    period : int
        0 if the last sweep changed nothing; else the number of sweeps after which the
        procedure came back to a mesh that it had left, and would do so for ever; -1 if
        the largest number of sweeps was reached.
    indicator : float
        Indicator of the start mesh: the sum of its costs, or of their squares.
    history : (n,) structured ndarray
        Every accepted step, with the fields ``sweep``, ``node``, ``way`` (``"swap"`` or
        ``"move"``), the ``gain`` in the indicator of the patch, and the ``indicator`` of
        the whole mesh after it.
    """

    cost_before: float
    cost_after: float
    sweeps: int
    period: int
    indicator: float
    history: np.ndarray


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
    max_sweeps: int = MOST_SWEEPS,
) -> Combination:
    """The mesh after the combined strategy: on each patch the better of swapping and moving.

    Node by node, the patch of elements around an interior node is changed in two ways:
    its inner edges are swapped, or the node is moved to the best position found.  The
    way that lowers the indicator of the error more is kept, if it gains enough.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    function : callable
        Vectorised u(x, y), since nodes move to where no value was given.
    criterion : str or Criterion, optional
        The indicator is the sum of the costs of this criterion, or of their squares.  By
        default that of the min-error criterion, the square of the L2 error.
    norm : {"L1", "L2"}
        Also 1 and 2.
    ways : tuple of {"swap", "move"}
        Which ways to try.
    rim : bool
        Whether the indicator of a patch includes the costs on its rim, which a step
        changes too.  Without them each patch is a domain of its own, as the thesis has it.
    min_angle : float, optional
        Steps that create an angle below this many degrees are refused.
    min_relative_gain : float
        What a step must gain, relative to the indicator of the start mesh; above 0.
    max_sweeps : int
        Largest number of sweeps over all interior nodes.

    Returns
    -------
    Combination

    Raises
    ------
    MeshError
        If the mesh is not valid, a name is not known, or an argument out of range.

    Notes
    -----
    *It terminates* with ``rim``, or if costs live on elements, after at most
    ``1 / min_relative_gain`` steps: a step changes no cost outside what the indicator of its
    patch counts, so that the indicator of the mesh, which is never negative, falls by as
    much.  Without ``rim`` a criterion on edges or nodes may gain on a patch what it loses
    beside it, and the procedure can come back to where it was.  That is noticed after
    the sweep, and ends it.

    Made for meshes of a few hundred nodes, with any criterion; `approximate` is the
    fast way to a small L2 error.

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
    before, after = (of ** (1 / objective.norm) for of in (run.indicator, objective.of(result)))
    history = np.array(run.steps, dtype=STEP)
    return Combination(result, run.values, before, after, run.count, period, run.indicator, history)


def _objective(mesh, function, criterion, norm, rim, min_angle):
    if not callable(function):
        raise InvalidInputError(
            "type",
            f"u is a {type(function).__name__}; give a function u(x, y), "
            "since nodes move to where there is no value",
        )
    norm = norms.checked(norm, NORMS)
    criterion = criteria.min_error(function, degree=DEGREE) if criterion is None else criterion
    swap = prepared(mesh, function, criterion, norm, min_angle, None, None)
    return Objective(function, swap.criterion, norm, swap.tolerance, swap.limits, bool(rim))


def _ways(ways):
    ways = (ways,) if isinstance(ways, str) else tuple(ways)
    for way in ways:
        checks.choice(way, WAYS, "way")
    if not ways:
        raise UnknownNameError("unknown", "no way to change a patch is given; name 'swap', 'move' or both")
    return ways


class _Run:
    """A mesh on its way, and the steps taken."""

    def __init__(self, mesh, objective, ways, share):
        self.objective, self.ways = objective, ways
        self.nodes, self.elements = mesh.nodes.copy(), mesh.elements.copy()
        self.values = objective.function(*mesh.nodes.T).astype(float)
        self.inside = ~mesh.boundary_nodes
        self.due = self.inside.copy()  # not where nothing changed since a patch was found to gain nothing
        self.indicator = objective.of(mesh)
        noise = objective.tolerance[1] ** objective.norm
        self.least, self.steps, self.count = max(share * self.indicator, noise), [], 0

    def sweep(self, most):
        """Sweep until nothing changes or a mesh comes again; returns the period."""
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

    def _key(self):
        return self.nodes.tobytes() + canonical(self.elements).tobytes()

    def _improve(self, node):
        """Steps 2 (a) to (c) of the algorithm."""
        patch = self.objective.patch(self.nodes, self.elements, self.values, node)
        found = [getattr(patch, {"swap": "swapped", "move": "moved"}[way])() for way in self.ways]
        gains = [patch.error - changed.error for changed in found]
        k = int(np.argmax(gains))
        self.due[node] = gains[k] > max(self.least, ROUNDING * patch.error)
        if not self.due[node]:
            return
        self._take(found[k])
        after = self.objective.of(Mesh._trusted(self.nodes.copy(), self.elements.copy()))
        self.steps.append((self.count, node, self.ways[k], gains[k], after))

    def _take(self, patch):
        self.elements[patch.rows] = patch.own
        centre = patch.used[patch.centre]
        self.nodes[centre], self.values[centre] = patch.nodes[patch.centre], patch.values[patch.centre]
        self._wake(patch.own)

    def _wake(self, changed):
        """Patches whose costs depend on elements that changed are due again."""
        if self.objective.criterion.on != "element":
            here = np.zeros(len(self.nodes), dtype=bool)
            here[changed] = True
            changed = self.elements[here[self.elements].any(axis=1)]
        self.due[changed] = self.inside[changed]

    def untouched(self, mesh):
        """Green pairs whose elements are still in their rows."""
        return (self.elements[mesh.green] == mesh.elements[mesh.green]).all(axis=(1, 2))
