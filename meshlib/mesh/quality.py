"""Geometric quality of a mesh (sections 4.5.2 and 7.2)."""

from dataclasses import dataclass

import numpy as np

from .._typing import FloatArray, IntArray
from ..checks import a_mesh
from .mesh import Mesh
from .topology import HEADS, TAILS

EQUILATERAL = np.pi / 3  # angle of an equilateral triangle, in radians
AT_ONCE = 4096  # number of elements whose coordinates fit a processor's nearest memory
MEASURES = {  # titles of the measures in tables
    "minimum_angle": "Minimum angle",
    "maximum_angle": "Maximum angle",
    "skewness": "Skewness",
    "aspect_ratio": "Aspect ratio",
    "shortest_edge": "Shortest edge",
    "longest_edge": "Longest edge",
}
LARGE_IS_GOOD = ("minimum_angle", "aspect_ratio", "shortest_edge")  # measures whose worst value is the least


@dataclass(frozen=True, repr=False, eq=False)
class Quality:
    """Measures of the shape of each element, with their mean and their worst value.

    Attributes
    ----------
    minimum_angle, maximum_angle : (T,) ndarray of float64
        Smallest and largest angle of each element, in degrees.
    skewness : (T,) ndarray of float64
        Mean deviation of the angles from 60 degrees, in radians; 0 if equilateral.
    aspect_ratio : (T,) ndarray of float64
        4 sqrt(3) area / sum of squared edge lengths; 1 if equilateral, 0 if flat.
    shortest_edge, longest_edge : (T,) ndarray of float64
        Lengths of the shortest and the longest edge of each element, in the unit of the
        coordinates.
    """

    minimum_angle: FloatArray
    maximum_angle: FloatArray
    skewness: FloatArray
    aspect_ratio: FloatArray
    shortest_edge: FloatArray
    longest_edge: FloatArray

    @property
    def mean(self) -> dict[str, float]:
        """Mean of each measure over the elements, by name."""
        return {name: float(getattr(self, name).mean()) for name in MEASURES}

    @property
    def min(self) -> dict[str, float]:
        """Minimum of each measure over the elements, by name."""
        return {name: float(getattr(self, name).min()) for name in MEASURES}

    @property
    def max(self) -> dict[str, float]:
        """Maximum of each measure over the elements, by name."""
        return {name: float(getattr(self, name).max()) for name in MEASURES}

    @property
    def worst(self) -> dict[str, float]:
        """Value of each measure at its worst element: the least where large is good, by name."""
        least, largest = self.min, self.max
        return {name: (least if name in LARGE_IS_GOOD else largest)[name] for name in MEASURES}

    def __str__(self) -> str:
        lines = [f"{'Measure':<14} {'mean':>10} {'worst':>10}"]
        mean, worst = self.mean, self.worst
        for name, title in MEASURES.items():
            lines.append(f"{title:<14} {mean[name]:10.4g} {worst[name]:10.4g}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        shown = (f"{name}={value:.4g}" for name, value in self.worst.items())
        return f"Quality({len(self.skewness)} elements, worst: {', '.join(shown)})"


def quality(mesh: Mesh) -> Quality:
    """Angles, skewness, aspect ratio and edge lengths of every element.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Quality

    Raises
    ------
    MeshError
        If the mesh is not valid.

    See Also
    --------
    uniformity, valence

    Notes
    -----
    Section 4.5.2 of the thesis has the largest angle, the skewness and the aspect ratio.
    With the angles in radians the skewness equals 2/3 max(largest - pi/3, pi/3 - smallest),
    and with the angles A, B, C the aspect ratio equals sqrt(3) / (cot A + cot B + cot C).

    Examples
    --------
    >>> from meshlib import delaunay
    >>> print(quality(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])))
    Measure              mean      worst
    Minimum angle          45         45
    Maximum angle          90         90
    Skewness           0.3491     0.3491
    Aspect ratio        0.866      0.866
    Shortest edge           1          1
    Longest edge        1.414      1.414
    """
    mesh = a_mesh(mesh)
    found = np.empty((len(MEASURES), mesh.n_elements))
    columns = np.ascontiguousarray(mesh.nodes.T)
    for start in range(0, mesh.n_elements, AT_ONCE):
        batch = slice(start, start + AT_ONCE)
        found[:, batch] = _measures(*(column[mesh.elements[batch].T] for column in columns))
    return Quality(*found)


def _measures(x: FloatArray, y: FloatArray) -> tuple[FloatArray, ...]:
    """Measures of elements with node coordinates x and y, (3, T) each, in the order of `Quality`."""
    angle, cross, squared_edges = _angles(x, y)
    return (
        np.degrees(angle.min(axis=0)),
        np.degrees(angle.max(axis=0)),
        np.abs(angle - EQUILATERAL).mean(axis=0),
        2 * np.sqrt(3) * np.abs(cross[0]) / squared_edges.sum(axis=0),
        np.sqrt(squared_edges.min(axis=0)),
        np.sqrt(squared_edges.max(axis=0)),
    )


def _angles(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Per node the angle, the cross product of both sides there, and the first side squared, (3, T) each."""
    ux, uy, vx, vy = x[TAILS] - x, y[TAILS] - y, x[HEADS] - x, y[HEADS] - y
    cross = ux * vy - uy * vx
    return np.arctan2(np.abs(cross), ux * vx + uy * vy), cross, ux**2 + uy**2


def uniformity(mesh: Mesh) -> FloatArray:
    """How much the area of each element differs from those of its neighbours.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (T,) ndarray of float64
        The largest ratio of areas, the larger to the smaller, of the element and a neighbour
        (section 7.2); 1 if all have the same area, or if there is no neighbour.

    Raises
    ------
    MeshError
        If the mesh is not valid.

    See Also
    --------
    quality, valence

    Examples
    --------
    >>> from meshlib import Mesh
    >>> uniformity(Mesh([[0, 0], [1, 0], [0, 1], [3, 3]], [[0, 1, 2], [1, 3, 2]])).tolist()
    [5.0, 5.0]
    """
    mesh = a_mesh(mesh)
    there = np.where(mesh.neighbours >= 0, mesh.areas[mesh.neighbours], mesh.areas[:, None])
    ratio = mesh.areas[:, None] / there
    return np.maximum(ratio, 1 / ratio).max(axis=1)


def valence(mesh: Mesh) -> IntArray:
    """Number of elements around each node (section 7.2).

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (N,) ndarray of int64
        Their sum is 3 T, whatever the mesh.

    Raises
    ------
    MeshError
        If the mesh is not valid.

    See Also
    --------
    quality, uniformity

    Examples
    --------
    >>> from meshlib import delaunay
    >>> valence(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])).tolist()
    [2, 1, 2, 1]
    """
    mesh = a_mesh(mesh)
    return np.bincount(mesh.elements.ravel(), minlength=mesh.n_nodes)


def angles(corners: FloatArray) -> FloatArray:
    """The three angles of each element, by arctan2 of cross and dot product.

    Parameters
    ----------
    corners : (T, 3, 2) ndarray of float

    Returns
    -------
    (T, 3) ndarray of float64
        In radians, at the node of the same column.

    Examples
    --------
    >>> np.degrees(angles(np.array([[[0., 0.], [1., 0.], [0., 1.]]]))).round(6).tolist()
    [[90.0, 45.0, 45.0]]
    """
    return np.ascontiguousarray(_angles(*np.moveaxis(corners, (2, 1), (0, 1)))[0].T)
