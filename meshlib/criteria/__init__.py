"""Criteria: a cost for each edge, element or node, and an order on cost vectors.

A criterion in the sense of section 2.2 is a cost function together with a norm.
The cost functions are registered here by name; the norm is chosen where they are used.

A user-defined criterion is a vectorised cost, together with the place that has it:

>>> import numpy as np
>>> def kink(p, q, left, right):
...     "Jump of the gradient along x, for edges p-q between two elements."
...     g, h = plane_gradients(p, q, left), plane_gradients(q, p, right)
...     return np.abs(g[:, 0] - h[:, 0])
>>> _ = register(Criterion("kink", "edge", kink))
>>> "kink" in names("edge")
True
>>> unregister("kink")

A cost on edges takes four (n, 3) arrays of points (x, y, u): the ends p, q of n edges
and the nodes opposite to them in the elements to their left and right.  A cost on
elements takes three such arrays, one for each corner; a cost on nodes takes the
`meshlib.Interpolant`.  Each returns n numbers, which must be at least 0 and larger
where the mesh is worse.
"""

from .criterion import Criterion
from .from_functions import min_error, pointwise
from .registry import costs, get, names, plane_gradients, prefers, register, unregister

__all__ = [
    "Criterion",
    "costs",
    "get",
    "min_error",
    "names",
    "plane_gradients",
    "pointwise",
    "prefers",
    "register",
    "unregister",
]
