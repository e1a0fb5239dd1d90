"""The three splittings side by side (section 7.1): error and smallest angle, round after round.

A run starts from the 33 nodes.  In every round a fifth of the elements is marked and split,
until the L2 error is a hundredth of that at the start or the mesh has ten thousand nodes.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Interpolant, Mesh, criteria, problems, quality, refined
from ...mesh.quality import angles
from ...refinement.marking import MARKS
from .measures import Function

FUNCTIONS = ("SR1", "SR2", "SR3", "DD1")
START, SHARE, CRITERION = "33", 0.2, "abn"
AIM = 0.01  # L2 error at which a run ends, relative to that at the start
MOST_NODES = 10_000  # nodes at which a run ends
TRUE_ERROR = "true error"  # marks the elements on which the L2 error itself is largest
MARKINGS = (*MARKS, TRUE_ERROR)
SHOWN_FROM = 500  # nodes that a mesh has at least if it is shown


@dataclass(frozen=True)
class Rounds:
    """The meshes of a run; the first is the start mesh.

    Attributes
    ----------
    meshes : list of Mesh
    errors : (k,) ndarray of float64
        L2 errors, by quadrature on each element.
    changed : float
        Number of elements that were split, or put together again, for each one that was marked.
    """

    meshes: list[Mesh]
    errors: np.ndarray
    changed: float

    @property
    def nodes(self) -> np.ndarray:
        """(k,) int64: numbers of nodes."""
        return np.array([mesh.n_nodes for mesh in self.meshes])

    @property
    def smallest_angles(self) -> np.ndarray:
        """(k,) float64: the smallest angle of each mesh, in degrees."""
        return np.degrees([angles(mesh.corners).min() for mesh in self.meshes])

    @property
    def mean_largest_angle(self) -> float:
        """Mean of the largest angles of the elements of the last mesh, in degrees."""
        return quality(self.meshes[-1]).mean["maximum_angle"]

    @property
    def needed(self) -> float:
        """Number of nodes at which the error reaches its aim, interpolated between two rounds, or NaN."""
        level = -np.log(AIM * self.errors[0])
        return float(np.exp(np.interp(level, -np.log(self.errors), np.log(self.nodes), right=np.nan)))

    @property
    def shown(self) -> Mesh:
        """The first mesh of at least `SHOWN_FROM` nodes."""
        return self.meshes[np.argmax(self.nodes >= SHOWN_FROM)]


@cache
def rounds(function: str, split: str, mark: str) -> Rounds:
    """Refine the mesh of the 33 nodes until a run ends.

    Parameters
    ----------
    function : str
        Name of u in `meshlib.problems`.
    split : {"red-green", "centroid", "longest-edge"}
    mark : {"element", "edge", "node", "density", "true error"}

    Returns
    -------
    Rounds

    Examples
    --------
    >>> found = rounds("SR1", "longest-edge", "element")
    >>> len(found.meshes), f"{found.needed:.0f}", f"{found.smallest_angles[-1]:.1f}"
    (14, '2255', '15.1')
    """
    u = problems.functions[function]
    criterion, mark = (criteria.min_error(u), "element") if mark == TRUE_ERROR else (CRITERION, mark)
    meshes, marked, changed = [problems.mesh(START)], 0, 0
    errors = [_error(meshes[0], u)]
    while errors[-1] > AIM * errors[0] and meshes[-1].n_nodes < MOST_NODES:
        done = refined(meshes[-1], u, criterion, fraction=SHARE, mark=mark, split=split)
        marked += len(done.marked)
        parts = np.bincount(done.parents, minlength=meshes[-1].n_elements)
        changed += int(np.count_nonzero(parts != 1))
        meshes.append(done.mesh)
        errors.append(_error(done.mesh, u))
    return Rounds(meshes, np.array(errors), changed / marked)


def _error(mesh: Mesh, u: Function) -> float:
    return Interpolant(mesh, u).l2_error(u, rule="exact")


def largest_kink(function: str, split: str, number: int = -1) -> float:
    """Largest angle between normals on a mesh of the run that marks by element, in degrees.

    Examples
    --------
    >>> [round(largest_kink("SR1", "centroid", k)) for k in (0, 4, -1)]
    [57, 174, 180]
    """
    mesh = rounds(function, split, "element").meshes[number]
    return float(np.degrees(criteria.costs(mesh, problems.functions[function], CRITERION).max()))
