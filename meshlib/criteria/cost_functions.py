"""The cost functions: vectorised definitions, one formula each.

A cost on edges takes points (x, y, u) in space, four (n, 3) arrays: the ends p, q of n
edges and the nodes opposite to them in the elements to their left and right.  A cost on
elements takes three such arrays, one for each corner; a cost on nodes takes the
``Interpolant``.  All return one number of at least 0 for each edge, element or node.

The compiled forms in `meshlib.kernels.costs` are tested against these.
"""

import numpy as np

from .._typing import FloatArray, Function
from ..interpolation.interpolant import Interpolant
from ..interpolation.on_elements import gradients, squared_errors
from ..mesh.quality import EQUILATERAL, angles


def plane_gradients(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Gradients of the planes through three points in space each.

    Parameters
    ----------
    a, b, c : (n, 3) ndarray of float
        Points (x, y, u) on n planes.

    Returns
    -------
    (n, 2) ndarray of float64
        Derivatives of u by x and by y.

    See Also
    --------
    meshlib.Interpolant.gradients

    Examples
    --------
    >>> a, b, c = np.array([[[0, 0, 1]], [[1, 0, 3]], [[0, 1, 4]]], dtype=float)
    >>> plane_gradients(a, b, c).tolist()
    [[2.0, 3.0]]
    """
    points = np.stack([a, b, c], axis=1)
    return gradients(points[..., :2], points[..., 2])


def jump_in_normal_derivatives(
    p: FloatArray, q: FloatArray, left: FloatArray, right: FloatArray
) -> FloatArray:
    """JND (section 3.1.2): the size of n . (g1 - g2), n the unit normal of the edge."""
    jump = plane_gradients(p, q, left) - plane_gradients(q, p, right)
    along = (q - p)[:, :2]
    normal = along[:, ::-1] * [1, -1] / np.hypot(*along.T)[:, None]
    return np.abs((normal * jump).sum(axis=1))


def angle_between_normals(p: FloatArray, q: FloatArray, left: FloatArray, right: FloatArray) -> FloatArray:
    """ABN (section 3.1.3), by arctan2, which is accurate for small angles too."""
    g, h = plane_gradients(p, q, left), plane_gradients(q, p, right)
    first, second = (np.column_stack([-v, np.ones(len(v))]) for v in (g, h))
    cross = np.linalg.norm(np.cross(first, second), axis=1)
    return np.arctan2(cross, (first * second).sum(axis=1))


def deviations_from_linear_polynomials(
    p: FloatArray, q: FloatArray, left: FloatArray, right: FloatArray
) -> FloatArray:
    """DLP: how far each plane misses the opposite node of the other element.

    This cost is due to Dyn, Levin & Rippa (1990).  The 2-norm of the two deviations is
    our choice; it equals JND sqrt(d^2 + e^2), with d and e the distances of the opposite
    nodes from the edge.
    """
    return np.hypot(*_misses(p, q, left, right))


def distances_from_planes(p: FloatArray, q: FloatArray, left: FloatArray, right: FloatArray) -> FloatArray:
    """DFP: the distance in space of each plane from the opposite node of the other element.

    This cost, too, is due to Dyn, Levin & Rippa (1990).  It differs from DLP in that
    distances are measured at right angles to the planes, not along the axis of u.
    """
    g, h = plane_gradients(p, q, left), plane_gradients(q, p, right)
    over, under = _misses(p, q, left, right)
    return np.hypot(over / np.sqrt(1 + (g**2).sum(axis=1)), under / np.sqrt(1 + (h**2).sum(axis=1)))


def _misses(
    p: FloatArray, q: FloatArray, left: FloatArray, right: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Heights of the plane on either side of an edge over the opposite node of the other element."""
    g, h = plane_gradients(p, q, left), plane_gradients(q, p, right)
    over = p[:, 2] + (g * (right - p)[:, :2]).sum(axis=1) - right[:, 2]
    under = p[:, 2] + (h * (left - p)[:, :2]).sum(axis=1) - left[:, 2]
    return over, under


def smallest_angle(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Max-min criterion (section 2.3.1): radians by which the smallest angle is below 60 degrees."""
    smallest = angles(np.stack([a, b, c], axis=1)[..., :2]).min(axis=1)
    return np.maximum(EQUILATERAL - smallest, 0)  # not below 0 by rounding


def largest_angle(a: FloatArray, b: FloatArray, c: FloatArray) -> FloatArray:
    """Min-max criterion (section 2.3.1): radians by which the largest angle is above 60 degrees."""
    largest = angles(np.stack([a, b, c], axis=1)[..., :2]).max(axis=1)
    return np.maximum(largest - EQUILATERAL, 0)  # not below 0 by rounding


def element_errors(
    a: FloatArray, b: FloatArray, c: FloatArray, function: Function, degree: int
) -> FloatArray:
    """Min error (section 2.4.1): the L2 norm of u - u_h on each element, for a known function u."""
    points = np.stack([a, b, c], axis=1)
    return np.sqrt(squared_errors(points[..., :2], points[..., 2], function, degree))


def gradient_spread(u_h: Interpolant) -> FloatArray:
    """Root mean square deviation of the gradients in the patch of a node from their mean.

    Both means are weighted by the areas of the elements.
    """
    nodes, mesh = u_h.mesh.elements.ravel(), u_h.mesh
    weights = np.repeat(np.abs(mesh.areas), 3)
    area = np.bincount(nodes, weights, mesh.n_nodes)
    spread = np.zeros(mesh.n_nodes)
    for g in u_h.gradients.T:
        mean = np.bincount(nodes, weights * np.repeat(g, 3), mesh.n_nodes) / area
        spread += np.bincount(nodes, weights * (np.repeat(g, 3) - mean[nodes]) ** 2, mesh.n_nodes) / area
    return np.sqrt(spread)
