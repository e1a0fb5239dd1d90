"""Geometric quality of a mesh: as the thesis's tables print it (section 4.5.2), and more (7.2)."""

from dataclasses import dataclass

import numpy as np

from ..checks import a_mesh

EQUILATERAL = np.pi / 3
NEXT, PREVIOUS = [1, 2, 0], [2, 0, 1]
AT_ONCE = 4096  # elements, whose coordinates fit a processor's nearest memory
MEASURES = {"maximum_angle": "Maximum angle", "skewness": "Skewness", "aspect_ratio": "Aspect ratio"}


@dataclass(frozen=True)
class Quality:
    """Three measures of each element, and their mean and maximum.

    Attributes
    ----------
    maximum_angle : (T,) ndarray of float64
        Largest angle of each element, in degrees.
    skewness : (T,) ndarray of float64
        Mean deviation of the angles from 60 degrees, in radians; 0 if equilateral.
    aspect_ratio : (T,) ndarray of float64
        4 sqrt(3) area / sum of squared edge lengths; 1 if equilateral, 0 if flat.
    """

    maximum_angle: np.ndarray
    skewness: np.ndarray
    aspect_ratio: np.ndarray

    @property
    def mean(self):
        """Mean of each measure over the elements, by name."""
        return {name: float(getattr(self, name).mean()) for name in MEASURES}

    @property
    def max(self):
        """Maximum of each measure over the elements, by name."""
        return {name: float(getattr(self, name).max()) for name in MEASURES}

    def __str__(self):
        lines = [f"{'Measure':<14} {'mean':>9} {'max':>9}"]
        for name, title in MEASURES.items():
            lines.append(f"{title:<14} {self.mean[name]:9.4f} {self.max[name]:9.4f}")
        return "\n".join(lines)


def quality(mesh):
    """Maximum angle, skewness and aspect ratio of every element.

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

    Notes
    -----
    Section 4.5.2 of the thesis.  With the angles in radians the skewness equals
    2/3 max(largest - pi/3, pi/3 - smallest), and with the angles A, B, C the aspect
    ratio equals sqrt(3) / (cot A + cot B + cot C).

    Examples
    --------
    >>> from meshlib import delaunay
    >>> print(quality(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])))
    Measure             mean       max
    Maximum angle    90.0000   90.0000
    Skewness          0.3491    0.3491
    Aspect ratio      0.8660    0.8660
    """
    mesh = a_mesh(mesh)
    found = np.empty((len(MEASURES), mesh.n_elements))
    columns = np.ascontiguousarray(mesh.nodes.T)
    for start in range(0, mesh.n_elements, AT_ONCE):
        batch = slice(start, start + AT_ONCE)
        found[:, batch] = _measures(*(column[mesh.elements[batch].T] for column in columns))
    return Quality(*found)


def _measures(x, y):
    """The measures of elements with the coordinates x, y, (3, T) each, in the order of `Quality`."""
    angle, cross, squared_edges = _angles(x, y)
    return (
        np.degrees(angle.max(axis=0)),
        np.abs(angle - EQUILATERAL).mean(axis=0),
        2 * np.sqrt(3) * np.abs(cross[0]) / squared_edges.sum(axis=0),
    )


def _angles(x, y):
    """Angles, cross products of the sides that meet there, and squares of one of them, (3, T) each."""
    ux, uy, vx, vy = x[NEXT] - x, y[NEXT] - y, x[PREVIOUS] - x, y[PREVIOUS] - y
    cross = ux * vy - uy * vx
    return np.arctan2(np.abs(cross), ux * vx + uy * vy), cross, ux**2 + uy**2


def uniformity(mesh):
    """How much the area of each element differs from those of its neighbours.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (T,) ndarray of float64
        The largest ratio, larger to smaller area, of an element and another that shares an
        edge with it (section 7.2); 1 if all are alike, or if there is no other.

    Raises
    ------
    MeshError
        If the mesh is not valid.

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


def valence(mesh):
    """Number of elements that have each node in common (section 7.2).

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (N,) ndarray of int64
        Of sum 3 T, whatever the mesh.

    Raises
    ------
    MeshError
        If the mesh is not valid.

    Examples
    --------
    >>> from meshlib import delaunay
    >>> valence(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])).tolist()
    [2, 1, 2, 1]
    """
    mesh = a_mesh(mesh)
    return np.bincount(mesh.elements.ravel(), minlength=mesh.n_nodes)


def angles(corners):
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
