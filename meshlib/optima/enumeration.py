r"""Every mesh of a few nodes, by flips from one of them.

The flips of diagonals of strictly convex quadrilaterals lead from any mesh of a set of
nodes on a simply connected domain to any other (Lawson 1972)::

        c                c
       / \              /|\
      a---b     --->   a | b
       \ /              \|/
        d                d
"""

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np

from .. import checks
from .._typing import IntArray
from ..errors import InvalidInputError
from ..kernels.costs import from_smallest
from ..mesh.mesh import Mesh
from ..mesh.topology import canonical
from .empty_triangles import Candidates

Elements: TypeAlias = frozenset[tuple[int, ...]]  # a mesh: its elements, each from its smallest node


def enumerated(mesh: Mesh, most: int = 200_000) -> IntArray:
    """Elements of every mesh with the same nodes and the same domain.

    Parameters
    ----------
    mesh : Mesh
        Any mesh of these nodes, at most about 12; its domain has no holes.
    most : int
        Largest number of meshes.

    Returns
    -------
    (M, T, 3) ndarray of int32
        The elements of each mesh, smallest node first, in lexicographic order; the
        given mesh comes first, then the meshes one flip away from it, then those two away,
        and so on.

    Raises
    ------
    MeshError
        If there are more than ``most``, or the domain is not simply connected.

    See Also
    --------
    meshlib.optimal : finds the best of these meshes without listing them, for more nodes.

    Examples
    --------
    A convex pentagon has five meshes:

    >>> from meshlib import delaunay
    >>> len(enumerated(delaunay([[0, 0], [2, 0], [3, 2], [1, 3], [-1, 2]])))
    5
    """
    mesh, most = checks.a_mesh(mesh), checks.whole(most, 1, "most")
    nodes, edges, triangles = mesh.counts
    if nodes - edges + triangles != 1:  # Euler's formula for a disc
        raise InvalidInputError("domain", "the domain has a hole or is in parts; give one without")
    turns = Candidates(mesh).turns
    start: Elements = frozenset(map(tuple, canonical(mesh.elements).tolist()))
    found, known = [start], {start}
    for elements in found:  # the list grows during the loop
        new = [other for other in _flipped(elements, turns) if other not in known]
        known.update(new)
        found.extend(dict.fromkeys(new))
        if len(found) > most:
            raise InvalidInputError(
                "range", f"there are more than {most} meshes; give fewer nodes or raise most"
            )
    return np.array([sorted(elements) for elements in found], dtype=np.int32)


def _flipped(elements: Elements, turns: IntArray) -> Iterator[Elements]:
    """The meshes that are one flip away, in lexicographic order of the edges that are flipped."""
    opposite = {side: apex for a, b, c in elements for side, apex in (((b, c), a), ((c, a), b), ((a, b), c))}
    for (a, b), c in sorted(opposite.items()):
        d = opposite.get((b, a))
        if a < b and d is not None and turns[c, a, d] > 0 and turns[d, b, c] > 0:
            old = {from_smallest(c, a, b), from_smallest(d, b, a)}
            yield elements - old | {from_smallest(c, a, d), from_smallest(d, b, c)}
