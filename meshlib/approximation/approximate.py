"""The mesh for a known function: nodes in, the best piecewise linear function out."""
from dataclasses import dataclass, field, replace

import numpy as np

from .. import checks
from ..delaunay import delaunay
from ..draws import Draws
from ..errors import Interrupted, MeshError
from ..interpolant import Interpolant
from ..mesh import Mesh
from ..sides import sides_of
from ..watching import Watch
from .collapse import collapse
from .draft import Draft
from .misfit import Misfit
from .samples import Samples
from .sizes import least
from .strategy import steps, strategy

UNIT_SQUARE = ((0.0, 0.0), (1.0, 1.0))
CELLS = 3  # of the first lattice along the shorter side of a rectangle
JITTER = 0.2  # of a cell, by which its inner nodes are moved at random
RESOLUTION = 40  # spacings along a square as large as the domain, in which features are looked for
FEWEST, MOST_NODES = 4, 200_000  # nodes between which a tolerance is sought
LARGEST_MIN_ANGLE = 30.0
LARGEST_STRETCH = 1e3  # of a rectangle
STEP = np.dtype([("step", "U8"), ("nodes", np.int64), ("elements", np.int64), ("error", np.float64),
                 ("evaluations", np.int64)])


@dataclass(frozen=True)
class Approximation:
    """A mesh made for a function.

    Attributes
    ----------
    mesh : Mesh
    values : (N,) ndarray of float64
        The function at the nodes.
    error : float
        L2 norm of u - u_h over the domain, by the quadrature that led the search.
    evaluations : int
        Points at which the function was evaluated.
    history : structured ndarray
        A row for each step: ``step`` (``"grown"``, ``"moved"`` or ``"renewed"``), and what
        there was after it: ``nodes``, ``elements``, ``error``, ``evaluations``.
    seed : int
    """

    mesh: Mesh
    values: np.ndarray = field(repr=False)
    error: float
    evaluations: int
    history: np.ndarray = field(repr=False)
    seed: int

    @property
    def interpolant(self):
        """The continuous piecewise linear function."""
        return Interpolant(self.mesh, self.values)


def approximate(function, nodes=None, domain=UNIT_SQUARE, min_angle=None, seed=0, progress=False, *,
                tolerance=None):
    """The mesh of so many nodes, or of such an error, whose interpolant is nearest to a function.

    Nodes go in where the error is largest, out where they serve least, and move and
    change their edges to where it is least, in rounds, until little is left to gain.

    Parameters
    ----------
    function : callable, or (rows, columns) array_like of float
        Vectorised u(x, y), finite in the whole domain; or samples on a regular grid that fills
        the domain's box, rows from its lower to its upper side, bilinear between them.
    nodes : int, optional
        Number of nodes of the mesh. Give this or the tolerance.
    domain : pair of corners, or Mesh
        The rectangle from the lower left to the upper right corner, or a start mesh:
        its domain is kept, holes included; its nodes need not stay, but for those where
        the boundary turns.
    min_angle : float, optional
        No change makes an element with an angle below this many degrees, at most 30.
        A mesh adapted without it has very long elements along fronts.
    seed : int
        Of the first nodes, which are a lattice moved at random.
    progress : bool
        Whether to show a progress bar.
    tolerance : float, optional
        L2 norm of the error that is to be reached with as few nodes as possible, at most
        MOST_NODES. Meshes are made with several numbers of nodes, so that this takes a few
        times as long.

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

    What lowers the error by quadrature might raise the error itself, were features
    missed between its points: elements are divided for quadrature until these lie as
    densely as a fortieth of the domain has it, and long elements along their length.

    References
    ----------
    .. [mirebeau2010] J.-M. Mirebeau, Optimal meshes for finite elements of arbitrary
       order, Constr. Approx. 32 (2010).

    Examples
    --------
    >>> def front(x, y):
    ...     return np.tanh(20 * (np.hypot(x, y) - 0.7))
    >>> found = approximate(front, 60)
    >>> found.mesh.n_nodes, bool(found.error < 0.02)
    (60, True)
    >>> lattice = np.stack(np.meshgrid(np.arange(8), np.arange(8)), axis=-1).reshape(-1, 2) / 7
    >>> bool(Interpolant(delaunay(lattice), front).l2_error(front, "exact") > 0.06)
    True
    """
    seed = checks.whole(seed, 0, "seed")
    angle = checks.number(min_angle or 0, "min_angle", 0, LARGEST_MIN_ANGLE + 1e-9, "degrees from 0 to 30")
    function = function if callable(function) else Samples(function, *_box(domain))
    if (nodes is None) == (tolerance is None):
        raise MeshError("nodes", f"nodes is {nodes} and tolerance is {tolerance}; give one of them")
    if tolerance is None:
        return _with_nodes(function, checks.whole(nodes, 3, "nodes"), domain, angle, seed, progress)
    return _within(function, _tolerance(tolerance), domain, angle, seed, progress)


def _with_nodes(function, nodes, domain, angle, seed, progress):
    start = _start(domain, nodes, seed)
    spacing = np.sqrt(start.domain_area) / RESOLUTION
    draft = Draft(Misfit(function, float(spacing), float(np.radians(angle))), start)
    _fit(draft, nodes)
    return _run(draft, nodes, seed, progress)


def _within(function, tolerance, domain, angle, seed, progress):
    spent = []

    def trial(nodes):
        found = _with_nodes(function, nodes, domain, angle, seed, progress)
        spent.append(found.evaluations)
        return found
    smallest = len(sides_of(_start(domain, FEWEST, seed)).corners)
    found = least(trial, tolerance, smallest, MOST_NODES)
    if found is None:
        raise MeshError("tolerance", f"the tolerance {tolerance} is not reached with {MOST_NODES} nodes; "
                        "give a larger one")
    return replace(found, evaluations=sum(spent))


def _tolerance(tolerance):
    found = checks.number(tolerance, "tolerance", 0, np.inf, "a number above 0")
    if not found > 0:
        raise MeshError("tolerance", f"the tolerance is {tolerance}; give a number above 0")
    return found


def _box(domain):
    return domain.box if isinstance(domain, Mesh) else _corners(domain)


def _run(draft, nodes, seed, progress):
    history, total = [], steps(draft, nodes)
    with Watch(progress, total, "step") as watch:
        def note(step):
            history.append((step, *_state(draft)))
            watch.report(len(history))
            if watch.stopped:
                raise Interrupted(_result(draft, history, seed))
        strategy(draft, nodes, note)
    return _result(draft, history, seed)


def _state(draft):
    return draft.n_nodes, len(draft.elements), draft.error, draft.misfit.evaluations


def _result(draft, history, seed):
    return Approximation(draft.mesh, draft.values, draft.error, draft.misfit.evaluations,
                         np.array(history, dtype=STEP), seed)


def _start(domain, nodes, seed):
    """The first mesh."""
    if isinstance(domain, Mesh):
        return checks.a_mesh(domain)
    low, high = _corners(domain)
    size = high - low
    most = max(1, int(np.sqrt(nodes)) - 1)  # cells
    shape = np.minimum(np.ceil(CELLS * size / size.min()), most).astype(int)
    lattice = np.stack(np.meshgrid(*(np.arange(n + 1.0) for n in shape)), axis=-1).reshape(-1, 2)
    inner = ((lattice > 0) & (lattice < shape)).all(axis=1)
    lattice[inner] += JITTER * (2 * Draws(seed).uniform((inner.sum(), 2)) - 1)
    return delaunay(low + lattice / shape * size)


def _corners(domain):
    try:
        low, high = np.asarray(domain, dtype=float).reshape(2, 2)
    except (TypeError, ValueError):
        raise MeshError("domain", f"the domain is {domain!r}; give the lower left and the upper right corner "
                        "of a rectangle, or a mesh") from None
    size = high - low
    if not (np.isfinite(size).all() and (size > 0).all() and size.max() <= LARGEST_STRETCH * size.min()):
        raise MeshError("domain", f"the rectangle from {low.tolist()} to {high.tolist()} has no area or is "
                        "too long; give the lower left and the upper right corner")
    return low, high


def _fit(draft, nodes):
    """Take nodes out of a start mesh that has too many."""
    while draft.n_nodes > nodes:
        if not collapse(draft, 1 - nodes / draft.n_nodes):
            raise MeshError("nodes", f"{nodes} nodes are too few for this domain, {draft.n_nodes} are left; "
                            "give more")
