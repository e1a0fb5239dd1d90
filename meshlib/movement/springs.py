"""Spring constants that follow the data (section 2.4.3)."""

from dataclasses import KW_ONLY, dataclass

import numpy as np

from .. import checks
from .._typing import FloatArray, Function
from ..errors import InvalidInputError
from ..mesh.mesh import Mesh

NOISE = 1e-14  # rounding error of a difference of values, relative to the largest value
PARTS = 6  # parts of an edge between samples of u, enough to see a steep ramp across its middle


@dataclass(frozen=True)
class DataSprings:
    """Spring constants made from the first and second derivative of u along each edge.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y), finite in the whole domain.
    first, second : float
        Weights a and b of the two derivatives, at least 0; without unit.
    power : float
        The exponent p, at least 0.

    Raises
    ------
    MeshError
        If the function cannot be called, or a number is negative or not finite.

    See Also
    --------
    smoothed : Moves nodes until such springs are in equilibrium.

    Notes
    -----
    Section 2.4.3, after Malcolm.  With u_s and u_ss the derivatives along the edge, and
    bars for their means over all edges, weighted by length, the constant of an edge is::

        k = (1 + a |u_s| / mean |u_s| + b |u_ss| / mean |u_ss|)^p

    ``|u_s|`` is the difference quotient of the ends, and ``|u_ss|`` the mean of the
    absolute second differences along the edge.

    *The default exponent.*  In one dimension k h is equal for all edges, of length h,
    when the springs are at rest.  Among all meshes with the same number of nodes, the
    one with h in proportion to ``|u_ss|^(-2/5)`` has the least L2 error.

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
    first: float = 0.0
    second: float = 100.0
    power: float = 0.4

    def __post_init__(self) -> None:
        if not callable(self.function):
            raise InvalidInputError(
                "type",
                f"the function is {self.function!r}; give u(x, y), for nodes move to where no value is known",
            )
        for name in ("first", "second", "power"):
            checks.number(getattr(self, name), name, 0, np.inf, "a finite number of at least 0")

    def __call__(self, mesh: Mesh) -> FloatArray:
        """(E,) ndarray of float64: the constant of each edge of a mesh, without unit."""
        first, second, length = self.derivatives(mesh)
        weight = length / length.sum()
        steep, curved = _relative(first, weight), _relative(second, weight)
        return (1 + self.first * steep + self.second * curved) ** self.power

    def derivatives(self, mesh: Mesh) -> tuple[FloatArray, FloatArray, FloatArray]:
        """``|u_s|``, ``|u_ss|`` and the length of each edge, (E,) ndarrays of float64."""
        start, end = mesh.nodes[mesh.edges].transpose(1, 2, 0)
        share = np.linspace(0, 1, PARTS + 1)[:, None]
        x, y = start[:, None] + share * (end - start)[:, None]
        values, length = checks.function_values(self.function, x, y), np.hypot(*(end - start))
        noise = NOISE * np.abs(values).max()
        rise = _above(np.abs(values[-1] - values[0]), noise)
        bend = _above(np.abs(np.diff(values, 2, axis=0)).mean(axis=0), noise)
        return rise / length, bend * (PARTS / length) ** 2, length


def _above(sizes: FloatArray, noise: float) -> FloatArray:
    """Sizes, with 0 for those below the noise, so that linear data have no curvature."""
    return np.where(sizes > noise, sizes, 0)


def _relative(sizes: FloatArray, weight: FloatArray) -> FloatArray:
    """Sizes divided by their weighted mean, or all 0 if this is 0."""
    mean = weight @ sizes
    return sizes / mean if mean > 0 else sizes
