"""User-defined criteria of every kind, for the tests of explorers."""

from contextlib import contextmanager
from math import hypot

import numpy as np

from meshlib.criteria import Criterion, plane_gradients, pointwise, register, unregister


def kink(p, q, left, right):
    """Jump of the gradient along x."""
    return np.abs(plane_gradients(p, q, left)[:, 0] - plane_gradients(q, p, right)[:, 0])


def slope(a, b, c):
    """Length of the gradient."""
    return np.hypot(*plane_gradients(a, b, c).T)


def valence(u_h):
    """Squared difference of the number of edges at a node from six."""
    return (np.bincount(u_h.mesh.edges.ravel(), minlength=u_h.mesh.n_nodes) - 6.0) ** 2


def length(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
    """Length of the edge, from numbers."""
    return hypot(px - qx, py - qy)


def height(ax, ay, au, bx, by, bu, cx, cy, cu):
    """Difference of the largest and the smallest value, from numbers."""
    return max(au, bu, cu) - min(au, bu, cu)


def nothing(p, q, left, right):
    """No edge costs anything, so nothing is swapped."""
    return np.zeros(len(p))


def made():
    """A criterion of each kind."""
    return (
        Criterion("kink", "edge", kink, "jump along x"),
        Criterion("slope", "element", slope),
        Criterion("valence", "node", valence, "edges too many or too few", geometric=True),
        pointwise("edge-length", "edge", length),
        pointwise("height", "element", height),
        Criterion("nothing", "edge", nothing),
    )


NAMES = tuple(criterion.name for criterion in made())


@contextmanager
def registered(*criteria):
    """Criteria that are registered for a while, by default all of these."""
    for criterion in criteria or made():
        register(criterion)
    try:
        yield
    finally:
        for criterion in criteria or made():
            unregister(criterion.name)
