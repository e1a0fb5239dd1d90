"""Node movement: edges as springs, patch by patch (sections 2.3.3, 2.4.3 and 3.3)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import checks
from .._typing import ArrayLike
from ..errors import InvalidInputError
from ..interpolation.record import Record
from ..kernels import for_work
from ..mesh.boundary_sides import sides_of
from ..mesh.mesh import Mesh
from ..mesh.topology import HEADS, TAILS, around_nodes, grouped
from ..mesh.validation import halved

MOST_SWEEPS = 1000
STILL = 1e-9  # movement, relative to the extent of the domain, that ends the iteration
HALVINGS = 20  # of a step by springs that follow the data
STEPS = 3  # of plain Python, to move a node once
FREE = (0.0, 0.0, 0.0, 0.0)  # the rail of a node that is on none


@dataclass(frozen=True, repr=False, eq=False)
class Smoothing(Record):
    """A mesh with moved nodes and how it came about.

    Attributes
    ----------
    mesh : Mesh
        The elements of the start mesh on moved nodes.
    values : (N,) ndarray of float64, or None
        Values at the moved nodes of the function that the springs follow, if there is one.
    cost_before, cost_after : float
        Energy of the springs, half the sum of k |e|^2 over the edges e, with their constants
        k on that mesh, of which the largest is 1.  It falls if the constants stay.
    sweeps : int
        Number of sweeps over all nodes that may move.
    movement : float
        Largest movement of a node in the last sweep, in the unit of the coordinates.
    refused : int
        Number of moves refused in the last sweep, because they would tangle the mesh.
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
    max_sweeps: int = MOST_SWEEPS,
    min_movement: float = STILL,
    sliding: bool = False,
    halvings: int | None = None,
) -> Smoothing:
    """The mesh whose edges, taken as springs, are in equilibrium.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    springs : (E,) array_like of float, or callable, optional
        Spring constant of each edge of ``mesh.edges``, at least 0.  Equal ones, the
        default, give Laplacian smoothing.  A function that returns them for a mesh,
        such as `meshlib.DataSprings`, is asked before every sweep.
    min_area : float, optional
        A move that makes an element smaller than this counts as tangling
        (section 3.3); by default every move that keeps all areas positive is made.
    max_sweeps : int
        Largest number of sweeps.
    min_movement : float
        The iteration ends when no node moves further than this share of the extent
        of the domain.
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
        If the mesh is not valid, an argument out of range, or a function of the mesh does
        not return such constants.

    Notes
    -----
    Section 2.3.3: node by node, the centre of each patch moves to the mean of its
    neighbours weighted by the spring constants, the equilibrium of the springs at
    that node.  Boundary nodes are fixed, or move to the nearest point of their side.  A
    step that would turn an element over (section 3.3) is halved or not made, so that the
    mesh is valid at every moment.

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
    for count in range(1, most + 1):  # noqa: B007 (the result tells how many it took)
        if callable(springs) and count > 1:
            patches.follow(springs)
        movement, refused = patches.sweep(halvings, 2 * area)
        if movement <= still:
            break
    nodes = patches.nodes
    green = mesh.green[halved(nodes, mesh.elements, mesh.green)]  # the others can no longer be undone
    moved = Mesh._trusted(nodes, mesh.elements, green)
    after = _spring_constants(moved, springs(moved)) if callable(springs) else constants
    function = getattr(springs, "function", None)
    values = checks.nodal_values(moved, function) if callable(function) else None
    energies = _energy(mesh, constants), _energy(moved, after)
    return Smoothing(moved, values, *energies, count, float(movement), int(refused))


def _energy(mesh, constants):
    """Half the sum of k |e|^2 over the edges e."""
    start, end = mesh.nodes[mesh.edges].transpose(1, 0, 2)
    return float(constants @ ((end - start) ** 2).sum(axis=1)) / 2


def _limit(value, what):
    return checks.number(0 if value is None else value, what, 0, np.inf, "a finite number of at least 0")


def _spring_constants(mesh, springs):
    if springs is None:
        return np.ones(mesh.n_edges)
    springs = checks.numeric(springs, "springs")
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

    def __init__(self, mesh, sliding, constants, sweeps):
        rails = _rails(mesh) if sliding else np.tile(FREE, (mesh.n_nodes, 1))
        centres = np.flatnonzero(~mesh.boundary_nodes | rails.any(axis=1))
        likely = min(sweeps, len(centres))  # what one node does takes as long to reach the others
        self._kernels = for_work(STEPS * likely * len(centres))
        flat, springs = self._kernels.flat, self._kernels.springs
        self._mesh, self._place = mesh, flat(mesh.nodes)
        head, self._by_tail, edge_starts = around_nodes(mesh.edges, mesh.n_nodes)
        by_corner, element_starts = grouped(mesh.elements.ravel(), mesh.n_nodes)
        second, third = (mesh.elements[:, turn].ravel().take(by_corner) for turn in (TAILS, HEADS))
        pulls = np.tile(constants, 2).take(self._by_tail)
        self._springs = springs.Springs(*map(flat, (centres, rails[centres], edge_starts, head, pulls)))
        self._around = springs.Patches(*map(flat, (element_starts, second, third)))

    def follow(self, springs):
        """Ask for the constants of the springs anew, on the mesh as it is."""
        moved = Mesh._trusted(self.nodes, self._mesh.elements)
        moved.__dict__["_edge_table"] = self._mesh._edge_table  # which moving does not change
        pulls = np.tile(_spring_constants(moved, springs(moved)), 2).take(self._by_tail)
        self._springs = self._springs._replace(constants=self._kernels.flat(pulls))

    def sweep(self, halvings, least):
        """Move every node once; the largest movement, and how many moves were refused."""
        return self._kernels.springs.sweep(self._springs, self._around, halvings, least, self._place)

    @property
    def nodes(self):
        """(N, 2) float64: where the nodes are."""
        return np.array(self._place, dtype=float).reshape(-1, 2)


def _rails(mesh):
    """For each node the start of its side and what leads to the end, (N, 4); zeros inside and at corners."""
    sides = sides_of(mesh)
    start, end = sides.ends[:, 0], sides.ends[:, 1]
    rails = np.column_stack([start, end - start])
    return np.where((sides.of_node >= 0)[:, None], rails[sides.of_node], FREE)
