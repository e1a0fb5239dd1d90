"""The mesh for a known function: nodes in, the best piecewise linear function out."""

from dataclasses import dataclass, field, replace

import numpy as np

from .. import checks
from .._typing import ArrayLike, Function, Norm
from ..criteria import norms
from ..errors import Interrupted, InvalidInputError, NotReachedError
from ..interpolation.record import Record
from ..mesh.boundary_sides import sides_of
from ..mesh.mesh import Mesh
from ..support.progress import Watch
from .error_integrals import Counted, Misfit
from .node_count import least
from .one_direction import in_turn
from .samples import Samples
from .settings import Settings
from .start_mesh import corners, fitted, regular, start
from .strategy import most_steps, polished, strategy
from .working_mesh import Draft

UNIT_SQUARE = ((0.0, 0.0), (1.0, 1.0))
LARGEST_MIN_ANGLE = 30.0
NORMS = {2: "L2", "max": "max"}
STEP = np.dtype(
    [
        ("step", "U8"),
        ("nodes", np.int64),
        ("elements", np.int64),
        ("error", np.float64),
        ("evaluations", np.int64),
    ]
)


@dataclass(frozen=True, repr=False, eq=False)
class Approximation(Record):
    """A mesh made for a function.

    Attributes
    ----------
    mesh : Mesh
    values : (N,) ndarray of float64
        The function at the nodes.
    error : float
        Norm of u - u_h over the domain, by a quadrature finer than the one that led the
        search, or at more points.
    evaluations : int
        Number of points at which the function was evaluated.
    history : structured ndarray
        A row for each step: ``step`` (``"grown"``, ``"moved"``, ``"renewed"``, ``"compared"`` with
        a regular mesh, and at last ``"measured"`` by a finer quadrature), and what there was
        after it: ``nodes``, ``elements``, ``error``, ``evaluations``.
    seed : int
    norm : {2, "max"}
    """

    error: float
    evaluations: int
    history: np.ndarray
    seed: int
    norm: Norm = 2

    @property
    def cost_before(self) -> float:
        """Norm of the error of the first mesh, by the quadrature of the search."""
        return float(self.history["error"][0])

    @property
    def cost_after(self) -> float:
        """Norm of the error of the mesh, which is ``error``."""
        return self.error


def approximate(
    function: Function | ArrayLike,
    *,
    nodes: int | None = None,
    tolerance: float | None = None,
    norm: Norm = "L2",
    domain: ArrayLike | Mesh = UNIT_SQUARE,
    min_angle: float | None = None,
    seed: int = 0,
    progress: bool = False,
) -> Approximation:
    """The mesh with a given number of nodes, or error, that best approximates a function.

    In rounds, until little is left to gain, nodes are inserted where the error is largest,
    taken out where they serve least, and moved, and edges are swapped, so that the error falls.

    Parameters
    ----------
    function : callable, or (rows, columns) array_like of float
        Vectorised u(x, y), finite in the whole domain; or samples on a regular grid that fills
        the domain's box, rows from its lower to its upper side, bilinear between them.
    nodes : int, optional
        Number of nodes of the mesh. Give this or the tolerance.
    tolerance : float, optional
        Norm of the error that is allowed; it is reached with as few nodes as possible, at
        most 200,000. Meshes are made with several numbers of nodes, so that this takes a few
        times as long.
    norm : {"L2", "max"}
        Whether the mean square of the error or the largest error is to be small; 2 and
        infinity are other names. The largest is found by lowering the integral of the
        sixteenth power, after the square.
    domain : pair of corners, or Mesh
        The rectangle from the lower left to the upper right corner, or a start mesh:
        its domain is kept, holes included; its nodes need not stay, but for those where
        the boundary turns.
    min_angle : float, optional
        No change makes an element with an angle below this many degrees, at most 30.
        A mesh adapted without it has very long elements along fronts.
    seed : int
        Seed of the first nodes, which are a lattice moved at random.
    progress : bool
        Whether to show a progress bar.

    Returns
    -------
    Approximation

    Raises
    ------
    MeshError
        If an argument is out of range, the mesh not valid, or the function not finite.
    Interrupted
        At an interrupt (Ctrl-C), with the mesh so far.

    Notes
    -----
    No piecewise linear interpolant on T elements has an L2 error much below
    ``B / T`` with ``B = (integral of (c |det D2 u|)^(1/3))^(3/2)``, ``c`` = 4/45 where the
    Hessian is definite and 1/90 where it is not [mirebeau2010]_.

    *Number of evaluations.* To avoid missing features, quadrature points are spaced at
    most 1/40 of the side of a square as large as the domain apart. The function is therefore
    evaluated at many points, whatever the number of nodes: some tens of millions in all for
    a mesh of 20 nodes, which is ``evaluations`` in the result.

    A function that is constant along parallel lines gets a mesh of its own on a
    rectangle, unless angles are limited: all its nodes are on the boundary. On a
    rectangle a lattice is tried as well: of x^2 - y^2 no mesh is better.

    Gains are rounded before they are compared, and so are steps of nodes: the mesh does
    not depend on how a processor rounds.

    References
    ----------
    .. [mirebeau2010] J.-M. Mirebeau, Optimal meshes for finite elements of arbitrary
       order, Constr. Approx. 32 (2010).

    Examples
    --------
    >>> from meshlib import Interpolant, delaunay
    >>> def front(x, y):
    ...     return np.tanh(20 * (np.hypot(x, y) - 0.7))
    >>> found = approximate(front, nodes=60)
    >>> found.mesh.n_nodes, bool(found.error < 0.02)
    (60, True)
    >>> lattice = np.stack(np.meshgrid(np.arange(8), np.arange(8)), axis=-1).reshape(-1, 2) / 7
    >>> bool(Interpolant(delaunay(lattice), front).l2_error(front) > 0.06)
    True
    """
    seed = checks.whole(seed, 0, "seed")
    angle = checks.number(min_angle or 0, "min_angle", 0, LARGEST_MIN_ANGLE + 1e-9, "degrees from 0 to 30")
    function = function if callable(function) else Samples(function, *_box(domain))
    kind = NORMS[norms.checked(norm, (2, "max"))]
    task = Task(function, domain, float(np.radians(angle)), kind, seed, progress)
    if (nodes is None) == (tolerance is None):
        raise InvalidInputError("nodes", f"nodes is {nodes} and tolerance is {tolerance}; give one of them")
    if nodes is not None:
        return task.with_nodes(checks.whole(nodes, 3, "nodes"))
    return task.within(_tolerance(tolerance))


@dataclass(frozen=True)
class Task:
    """What is to be approximated, where and how."""

    function: object
    domain: object
    sharpest: float
    norm: str
    seed: int
    progress: bool
    settings: Settings = field(default_factory=Settings)

    def with_nodes(self, nodes):
        """The mesh with a given number of nodes."""
        settings = self.settings
        first = start(self.domain, nodes, self.seed, settings.start)
        spacing = float(np.sqrt(first.domain_area) / settings.quadrature.resolution)
        misfit = Misfit(Counted(self.function), spacing, self.sharpest, settings.quadrature)
        ridge = self._ridge(misfit, nodes)
        if ridge is not None:
            draft = Draft.of(misfit, ridge, self.norm, settings)
            if self.norm == "max":
                draft = draft.measured(settings.objective.squarings)
            return self._run(polished(draft), settings.rounds.last_moves + 1)
        draft = fitted(Draft.of(misfit, first, self.norm, settings), nodes)
        lattice = None if isinstance(self.domain, Mesh) else regular(self.domain, nodes)
        return self._run(strategy(draft, nodes, lattice), most_steps(draft, nodes))

    def within(self, tolerance):
        """The mesh of about the fewest nodes whose error is within the tolerance."""
        spent = []

        def trial(nodes):
            found = self.with_nodes(nodes)
            spent.append(found.evaluations)
            return found

        settings = self.settings.node_count
        coarsest = start(self.domain, settings.fewest, self.seed, self.settings.start)
        found = least(trial, tolerance, len(sides_of(coarsest).corners), settings)
        if found is None:
            raise NotReachedError(
                "tolerance",
                f"the tolerance {tolerance} is not reached with {settings.most} nodes; give a larger one",
            )
        return replace(found, evaluations=sum(spent))

    def _ridge(self, misfit, nodes):
        """A mesh for a function of one direction, or None."""
        if isinstance(self.domain, Mesh) or self.sharpest:
            return None
        power = 2 ** (self.settings.objective.squarings if self.norm == "max" else 1)
        return in_turn(misfit.values, *corners(self.domain), nodes, power, self.settings.one_direction)

    def _run(self, steps, most_steps):
        history = []
        with Watch(self.progress, most_steps, "step") as watch:
            for step, draft in _and_measured(steps, self.settings.quadrature.final_refinement):
                history.append((step, *_state(draft)))
                watch.report(len(history))
                if watch.stopped:
                    raise Interrupted(self._result(draft, history))
        return self._result(draft, history)

    def _result(self, draft, history):
        values = draft.values * draft.misfit.unit
        return Approximation(
            draft.mesh,
            values,
            draft.error,
            draft.misfit.function.evaluations,
            np.array(history, dtype=STEP),
            self.seed,
            2 if self.norm == "L2" else "max",
        )


def _and_measured(steps, refinement):
    """The steps, and a last one that measures the error by a finer quadrature."""
    draft = yield from steps
    yield "measured", draft.measured_finely(refinement)


def _state(draft):
    return draft.n_nodes, draft.n_elements, draft.error, draft.misfit.function.evaluations


def _tolerance(tolerance):
    found = checks.number(tolerance, "tolerance", 0, np.inf, "a number above 0")
    if not found > 0:
        raise NotReachedError("tolerance", f"the tolerance is {tolerance}; give a number above 0")
    return found


def _box(domain):
    return domain.box if isinstance(domain, Mesh) else corners(domain)
