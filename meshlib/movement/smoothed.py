"""Node movement: edges as springs, patch by patch (sections 2.3.3, 2.4.3 and 3.3)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import ArrayLike, FloatArray
from ..errors import InvalidInputError
from ..interpolation.record import Record
from ..kernels import for_work
from ..mesh.boundary_sides import sides_of
from ..mesh.mesh import Mesh
from ..mesh.topology import HEADS, TAILS, around_nodes, grouped
from ..mesh.validation import halved

HALVINGS = 20  # number of times that a step by springs which follow the data is halved
STEPS = 3  # steps of plain Python, about a microsecond each, to move a node once


@dataclass(frozen=True, repr=False, eq=False)
class Smoothing(Record):
    """A mesh with moved nodes and how it came about.

    Attributes
    ----------
    mesh : Mesh
        The elements of the start mesh on moved nodes.
    values : (N,) ndarray of float64, or None
        Values at the moved nodes of the function that the springs follow; None without one.
    cost_before, cost_after : float
        Energy of the springs on the start mesh and on the new one: half the sum of ``k |e|^2``
        over the edges e, with the spring constants k on that mesh, scaled so that the
        largest is 1.  It falls if the constants do not depend on the mesh.
    sweeps : int
        Number of sweeps over all nodes that may move.
    movement : float
        Largest movement of a node in the last sweep, in the unit of the coordinates.
    refused : int
        Number of moves refused in the last sweep because they would tangle the mesh.
    """

    cost_before: float
    cost_after: float
    sweeps: int
    movement: float
    refused: int


def smoothed(
    mesh: Mesh,
    springs: ArrayLike | Callable[[Mesh], ArrayLike] | None = None,
    *,
    min_area: float | None = None,
    max_sweeps: int = 1000,
    min_movement: float = 1e-9,
    sliding: bool = False,
    halvings: int | None = None,
) -> Smoothing:
    """The mesh whose edges, taken as springs, are in equilibrium.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    springs : (E,) array_like of float, or callable, optional
        Spring constant of each edge of ``mesh.edges``, at least 0; only their ratios
        matter.  By default all are equal, which is Laplacian smoothing.  A function that
        returns the constants for a mesh, such as a `meshlib.DataSprings`, is called before
        every sweep.
    min_area : float, optional
        A move that makes an element smaller than this area counts as tangling
        (section 3.3); by default every move that keeps all areas positive is made.
    max_sweeps : int
        Largest number of sweeps.
    min_movement : float
        The iteration ends when no node moves further than this fraction of the longer
        side of the bounding box.
    sliding : bool
        Whether nodes on the boundary slide along its straight sides; corners are fixed
        in any case.
    halvings : int, optional
        How often a step that would tangle the mesh is halved before it is refused; by
        default never, as in section 3.3, and up to 20 times if ``springs`` is a function.

    Returns
    -------
    Smoothing

    Raises
    ------
    MeshError
        If the mesh is not valid, an argument is out of range, or a function does not
        return one constant of at least 0 for each edge.

    See Also
    --------
    DataSprings : Spring constants that follow the data.
    swapped, refined, combined : Other ways to lower the error.

    Notes
    -----
    Node by node, the centre of each patch moves to the mean of its neighbours weighted
    by the spring constants (section 2.3.3), where the springs at this node are in
    equilibrium.  Boundary nodes are fixed, or move to the nearest point of their side.  A
    step that would turn an element over (section 3.3) is halved or not made, so that the
    mesh is valid at all times.

    Examples
    --------
    >>> from meshlib import problems
    >>> result = smoothed(problems.mesh("81"))  # already in equilibrium
    >>> result.sweeps, bool(abs(result.mesh.nodes - problems.nodes("81")).max() < 1e-12)
    (1, True)
    """
    mesh = checks.a_mesh(mesh)
    constants = _spring_constants(mesh, springs(mesh) if callable(springs) else springs)
    area = _limit(min_area, "min_area")
    low, high = mesh.box
    still = _limit(min_movement, "min_movement") * (high - low).max()
    most = checks.whole(max_sweeps, 1, "max_sweeps")
    halvings = checks.whole(HALVINGS * callable(springs) if halvings is None else halvings, 0, "halvings")
    patches = _Patches(mesh, sliding, constants, most)
    for count in range(1, most + 1):
        if callable(springs) and count > 1:
            patches.follow(springs)
        movement, refused = patches.sweep(halvings, 2 * area)
        if movement <= still:
            break
    nodes = patches.nodes
    green = mesh.green[halved(nodes, mesh.elements, mesh.green)]  # the others can no longer be undone
    moved = Mesh._trusted(nodes, mesh.elements, green, connected_as=mesh)
    after = _spring_constants(moved, springs(moved)) if callable(springs) else constants
    function = getattr(springs, "function", None)
    values = checks.nodal_values(moved, function) if callable(function) else None
    before, rest = _energy(mesh, constants), _energy(moved, after)
    return Smoothing(moved, values, before, rest, count, float(movement), int(refused))


def _energy(mesh: Mesh, constants: FloatArray) -> float:
    """Half the sum of k |e|^2 over the edges e."""
    start, end = mesh.nodes[mesh.edges].transpose(1, 0, 2)
    return float(constants @ ((end - start) ** 2).sum(axis=1)) / 2


def _limit(value: float | None, what: str) -> float:
    """A finite number of at least 0, by default 0, or a MeshError."""
    return checks.number(0 if value is None else value, what, 0, np.inf, "a finite number of at least 0")


def _spring_constants(mesh: Mesh, given: ArrayLike | None) -> FloatArray:
    """One constant for each edge, the largest 1, or a MeshError."""
    if given is None:
        return np.ones(mesh.n_edges)
    springs = checks.numeric(given, "springs")
    if springs.shape != (mesh.n_edges,):
        raise InvalidInputError(
            "shape",
            f"springs have shape {springs.shape}; give one constant for each of the {mesh.n_edges} edges",
        )
    bad = np.flatnonzero(~(np.isfinite(springs) & (springs >= 0)))
    if bad.size:
        raise InvalidInputError(
            "range",
            f"the spring constant of edge {bad[0]} is {springs[bad[0]]}; give finite numbers of at least 0",
            bad,
            bad.size,
        )
    return springs / (springs.max(initial=0) or 1)  # only ratios matter, and sums stay finite


class _Patches:
    """The nodes that may move, with their springs and elements in compressed rows."""

    def __init__(self, mesh: Mesh, sliding: bool, constants: FloatArray, sweeps: int) -> None:
        rails = _rails(mesh) if sliding else np.zeros((mesh.n_nodes, 4))
        centres = np.flatnonzero(~mesh.boundary_nodes | rails.any(axis=1))
        likely = min(sweeps, len(centres))  # as long as the move of a node takes to reach all others
        self._kernels = for_work(STEPS * likely * len(centres))
        flat, springs = self._kernels.flat, self._kernels.springs
        self._mesh, self._place = mesh, flat(mesh.nodes)
        head, self._by_tail, edge_starts = around_nodes(mesh.edges, mesh.n_nodes)
        by_corner, element_starts = grouped(mesh.elements.ravel(), mesh.n_nodes)
        second, third = (mesh.elements[:, turn].ravel().take(by_corner) for turn in (TAILS, HEADS))
        pulls = np.tile(constants, 2).take(self._by_tail)
        self._springs = springs.Springs(*map(flat, (centres, rails[centres], edge_starts, head, pulls)))
        self._around = springs.Patches(*map(flat, (element_starts, second, third)))

    def follow(self, springs: Callable[[Mesh], ArrayLike]) -> None:
        """Recompute the spring constants, on the mesh as it is now."""
        moved = Mesh._trusted(self.nodes, self._mesh.elements, connected_as=self._mesh)
        pulls = np.tile(_spring_constants(moved, springs(moved)), 2).take(self._by_tail)
        self._springs = self._springs._replace(constants=self._kernels.flat(pulls))

    def sweep(self, halvings: int, least: float) -> tuple[float, int]:
        """Move every node once; the largest movement, and the number of refused moves."""
        return self._kernels.springs.sweep(self._springs, self._around, halvings, least, self._place)

    @property
    def nodes(self) -> FloatArray:
        """(N, 2) float64: the nodes where they are now."""
        return np.array(self._place, dtype=float).reshape(-1, 2)


def _rails(mesh: Mesh) -> FloatArray:
    """The side of each node, its start and the vector to its end, (N, 4); zeros inside and at corners."""
    sides = sides_of(mesh)
    start, end = sides.ends[:, 0], sides.ends[:, 1]
    rails = np.column_stack([start, end - start])
    return np.where((sides.of_node >= 0)[:, None], rails[sides.of_node], 0.0)
