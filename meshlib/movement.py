"""Node movement: edges as springs, patch by patch (sections 2.3.3 and 3.3)."""
from dataclasses import dataclass

import numpy as np

from . import checks
from .errors import MeshError
from .mesh import Mesh
from .topology import HEADS, TAILS, around_nodes, grouped
from .validation import halved

MOST_SWEEPS = 1000
STILL = 1e-9  # movement, relative to the extent of the domain, that ends the iteration


@dataclass(frozen=True)
class Smoothing:
    """A mesh with moved nodes and how it came about.

    Attributes
    ----------
    mesh : Mesh
        The same elements on moved nodes.
    sweeps : int
        Sweeps over all interior nodes.
    movement : float
        Largest movement of a node in the last sweep.
    refused : int
        Moves refused in the last sweep, because they would tangle the mesh.
    """

    mesh: Mesh
    sweeps: int
    movement: float
    refused: int


def smoothed(mesh, springs=None, min_area=None, sweeps=MOST_SWEEPS, tolerance=STILL):
    """The mesh whose edges, taken as springs, are in equilibrium.

    Parameters
    ----------
    mesh : Mesh
        Start mesh; not changed.
    springs : (E,) array_like of float, optional
        Spring constant of each edge of ``mesh.edges``, at least 0.  Equal ones, the
        default, give Laplacian smoothing.
    min_area : float, optional
        A move that makes an element smaller than this is refused as nearly tangling
        (section 3.3); by default every move that keeps all areas positive is made.
    sweeps : int
        Largest number of sweeps.
    tolerance : float
        The iteration ends when no node moves further than this share of the extent
        of the domain.

    Returns
    -------
    Smoothing

    Raises
    ------
    MeshError
        If the mesh is not valid or an argument out of range.

    Notes
    -----
    Section 2.3.3: node by node, the centre of each patch moves to the mean of its
    neighbours weighted by the spring constants, the equilibrium of the springs at
    that node.  Boundary nodes are fixed.  A move that would turn an element over
    (section 3.3) is not made.

    Examples
    --------
    >>> from meshlib import problems
    >>> result = smoothed(problems.mesh("81"))  # already in equilibrium
    >>> result.sweeps, bool(abs(result.mesh.nodes - problems.nodes("81")).max() < 1e-12)
    (1, True)
    """
    mesh = checks.a_mesh(mesh)
    springs = _spring_constants(mesh, springs)
    area = _limit(min_area, "min_area")
    low, high = mesh.box
    still = _limit(tolerance, "tolerance") * (high - low).max()
    sweeps = checks.whole(sweeps, 1, "sweeps")
    from .kernels import springs as kernel
    from .kernels.backend import flat
    place = flat(mesh.nodes)
    arrays = [flat(v) for v in _patches(mesh, springs)]
    for count in range(1, sweeps + 1):  # noqa: B007 (the result tells how many it took)
        movement, refused = kernel.sweep(*arrays, 2 * area, place)
        if movement <= still:
            break
    nodes = np.reshape(place, (-1, 2))
    green = mesh.green[halved(nodes, mesh.elements, mesh.green)]  # the others can no longer be undone
    moved = Mesh._trusted(nodes, mesh.elements, green)
    return Smoothing(moved, count, float(movement), int(refused))


def _limit(value, what):
    return checks.number(0 if value is None else value, what, 0, np.inf, "a finite number of at least 0")


def _spring_constants(mesh, springs):
    if springs is None:
        return np.ones(mesh.n_edges)
    springs = checks.numeric(springs, "springs")
    if springs.shape != (mesh.n_edges,):
        raise MeshError("shape", f"springs have shape {springs.shape}; give one constant "
                        f"for each of the {mesh.n_edges} edges")
    bad = np.flatnonzero(~(np.isfinite(springs) & (springs >= 0)))
    if bad.size:
        raise MeshError("range", f"the spring constant of edge {bad[0]} is {springs[bad[0]]}; "
                        "give finite numbers of at least 0", bad)
    return springs / (springs.max(initial=0) or 1)  # only ratios matter, and sums stay finite


def _patches(mesh, springs):
    """Interior nodes; their springs and elements, in compressed rows.

    Returns centres, spring starts, neighbours, constants, element starts, and the
    two other nodes of each element, counter-clockwise after the centre.
    """
    n, centres = mesh.n_nodes, np.flatnonzero(~mesh.boundary_nodes)
    head, by_tail, edge_starts = around_nodes(mesh.edges, n)
    by_corner, element_starts = grouped(mesh.elements.ravel(), n)
    springs = np.tile(springs, 2).take(by_tail)
    second, third = (mesh.elements[:, turn].ravel().take(by_corner) for turn in (TAILS, HEADS))
    return centres, edge_starts, head, springs, element_starts, second, third
