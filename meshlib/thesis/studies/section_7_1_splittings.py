"""The three splittings side by side (section 7.1): error and smallest angle, round after round.

From the 33 nodes on, a fifth of the elements is marked and split in every round, until the
L2 error is a hundredth of that at the start, or the mesh too large.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from ... import Interpolant, criteria, problems, quality, refined
from ...mesh.quality import angles
from ...refinement.marking import MARKS
from ...refinement.splitting import SPLITS
from ..tables.numbered import grid, numbered

FUNCTIONS = ("SR1", "SR2", "SR3", "DD1")
START, SHARE, CRITERION = "33", 0.2, "abn"
AIM = 0.01  # of the error at the start
MOST_NODES = 10_000
TRUE_ERROR = "true error"  # marked are the elements on which the L2 error itself is largest
MARKINGS = (*MARKS, TRUE_ERROR)
SHOWN_FROM = 500  # nodes of the meshes that are shown


@dataclass(frozen=True)
class Rounds:
    """What becomes of a mesh in repeated refinement; the first entry is the start.

    Attributes
    ----------
    meshes : list of Mesh
    errors : (k,) ndarray of float64
        L2 errors, by quadrature on each element.
    changed : float
        Elements split, or put together again, for each one that was marked.
    """

    meshes: list
    errors: np.ndarray
    changed: float

    @property
    def nodes(self):
        """(k,) int64: numbers of nodes."""
        return np.array([mesh.n_nodes for mesh in self.meshes])

    @property
    def smallest_angles(self):
        """(k,) float64: the smallest angle of each mesh, in degrees."""
        return np.degrees([angles(mesh.corners).min() for mesh in self.meshes])

    @property
    def mean_largest_angle(self):
        """Of the elements of the last mesh, in degrees."""
        return quality(self.meshes[-1]).mean["maximum_angle"]

    @property
    def needed(self):
        """Nodes at which the error is a hundredth, interpolated between two rounds; NaN if it never is."""
        level = -np.log(AIM * self.errors[0])
        return np.exp(np.interp(level, -np.log(self.errors), np.log(self.nodes), right=np.nan))

    @property
    def shown(self):
        """The first mesh of a few hundred nodes."""
        return self.meshes[np.argmax(self.nodes >= SHOWN_FROM)]


@cache
def rounds(function, split, mark):
    """Refine again and again.

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
        changed += np.count_nonzero(np.bincount(done.parents, minlength=meshes[-1].n_elements) != 1)
        meshes.append(done.mesh)
        errors.append(_error(done.mesh, u))
    return Rounds(meshes, np.array(errors), changed / marked)


def _error(mesh, u):
    return Interpolant(mesh, u).l2_error(u, rule="exact")


# -- tables ----------------------------------------------------------------------------------


def table_needed():
    """Nodes at which the error is a hundredth, by splitting and marking."""
    rows = [
        (*names, *(_needed(rounds(function, split, mark)) for mark in MARKINGS))
        for names, function, split in _lines()
    ]
    caption = (
        "Nodes needed until the $L_2$ error is a hundredth of that on the 33 nodes; in brackets, "
        f"where a mesh of {MOST_NODES} nodes or more came first, the error there in per cent of it."
    )
    return numbered("tab-7-1-nodes", caption, grid(("", "", *(f"by {m}" for m in MARKINGS)), rows))


def _lines():
    """The first cells of each row, function and splitting."""
    for function in FUNCTIONS:
        for split in SPLITS:
            yield (function * (split == next(iter(SPLITS))), split), function, split


def _needed(found):
    share = 100 * found.errors[-1] / found.errors[0]
    return f"({share:.3g})" if np.isnan(found.needed) else str(int(float(f"{found.needed:.3g}")))


def table_reasons():
    """What the closure adds and what shapes come out, marked by element."""
    rows = []
    for names, function, split in _lines():
        found = rounds(function, split, "element")
        rows.append(
            (
                *names,
                f"{found.changed:.1f}",
                f"{found.smallest_angles[-1]:.2f}°",
                f"{found.mean_largest_angle:.0f}°",
                f"{largest_kink(function, split):.0f}°",
            )
        )
    head = (
        "",
        "",
        "Elements changed for each one marked",
        "Smallest angle",
        "Mean largest angle",
        "Largest kink",
    )
    return numbered(
        "tab-7-1-reasons",
        "Marked by element: what has to change with each marked element, the "
        "angles of the last mesh, and the largest angle between normals there.",
        grid(head, rows),
    )


def largest_kink(function, split, number=-1):
    """The largest ABN of one of the meshes marked by element, in degrees.

    Examples
    --------
    >>> [round(largest_kink("SR1", "centroid", k)) for k in (0, 4, -1)]
    [57, 174, 180]
    """
    mesh = rounds(function, split, "element").meshes[number]
    return np.degrees(criteria.costs(mesh, problems.functions[function], CRITERION).max())
