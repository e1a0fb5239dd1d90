"""Spring constants that follow the data (section 2.4.3)."""

from dataclasses import KW_ONLY, dataclass

import numpy as np

from .. import checks
from .._typing import Function
from ..errors import InvalidInputError

FIRST, SECOND = 0.0, 100.0
POWER = 0.4
NOISE = 1e-14  # relative size of differences that are rounding
PARTS = 6  # of an edge, so that a steep ramp across its middle is seen


@dataclass(frozen=True)
class DataSprings:
    """Spring constants from the first and second derivative of u along each edge.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y), finite in the whole domain.
    first, second : float
        Weights a and b of the two derivatives, at least 0; without dimension.
    power : float
        The exponent p, at least 0.

    Raises
    ------
    MeshError
        If the function is none, or a number is negative or not finite.

    Notes
    -----
    Section 2.4.3, after Malcolm.  With u_s and u_ss the derivatives along the edge, and
    bars for their means over all edges, weighted by length, the constant of an edge is::

        k = (1 + a |u_s| / mean |u_s| + b |u_ss| / mean |u_ss|)^p

    ``|u_s|`` is the difference quotient of the ends, and ``|u_ss|`` the mean of second
    differences along the edge.  *The default exponent.*  At rest in one dimension k h
    is the same for all edges of length h, and of all meshes with so many nodes that with
    h in proportion to ``|u_ss|^(-2/5)`` has the least L2 error.

    Examples
    --------
    Nodes move to where u is curved, and the error falls:

    >>> from meshlib import Interpolant, problems, smoothed
    >>> u, mesh = problems.SR3, problems.mesh("81")
    >>> moved = smoothed(mesh, DataSprings(u), sliding=True).mesh
    >>> print(f"{Interpolant(mesh, u).l2_error(u):.3f} {Interpolant(moved, u).l2_error(u):.3f}")
    0.060 0.015
    """

    function: Function
    _: KW_ONLY
    first: float = FIRST
    second: float = SECOND
    power: float = POWER

    def __post_init__(self):
        if not callable(self.function):
            raise InvalidInputError(
                "type",
                f"the function is {self.function!r}; give u(x, y), for nodes move to where no value is known",
            )
        for name in ("first", "second", "power"):
            checks.number(getattr(self, name), name, 0, np.inf, "a finite number of at least 0")

    def __call__(self, mesh):
        """(E,) float64: the constant of each edge of a mesh."""
        first, second, length = self.derivatives(mesh)
        weight = length / length.sum()
        steep, curved = _relative(first, weight), _relative(second, weight)
        return (1 + self.first * steep + self.second * curved) ** self.power

    def derivatives(self, mesh):
        """``|u_s|``, ``|u_ss|`` and the length of each edge, (E,) float64 each."""
        start, end = mesh.nodes[mesh.edges].transpose(1, 2, 0)
        share = np.linspace(0, 1, PARTS + 1)[:, None]
        x, y = start[:, None] + share * (end - start)[:, None]
        values, length = checks.function_values(self.function, x, y), np.hypot(*(end - start))
        noise = NOISE * np.abs(values).max()
        rise = _above(np.abs(values[-1] - values[0]), noise)
        bend = _above(np.abs(np.diff(values, 2, axis=0)).mean(axis=0), noise)
        return rise / length, bend * (PARTS / length) ** 2, length


def _above(sizes, noise):
    """Sizes, and 0 for those that are rounding: linear data have no curvature."""
    return np.where(sizes > noise, sizes, 0)


def _relative(sizes, weight):
    """Sizes in units of their mean, all 0 if that is."""
    mean = weight @ sizes
    return sizes / mean if mean > 0 else sizes
