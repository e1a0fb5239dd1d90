"""How far u_h is from a known u: integrals of a power of the error over elements and along edges."""

from dataclasses import dataclass, field
from functools import cache

import numpy as np

from .. import checks
from ..mesh.quality import angles
from ..mesh.topology import HEADS, TAILS
from .settings import Quadrature

# Dunavant's rules of 1985 by degree, of 12 and 6 points: two coordinates, and the weight, of each orbit.
DUNAVANT = {
    6: (
        (0.24928674517091042, 0.24928674517091042, 0.11678627572637937),
        (0.06308901449150223, 0.06308901449150223, 0.05084490637020682),
        (0.31035245103378440, 0.63650249912139870, 0.08285107561837358),
    ),
    4: (
        (0.44594849091596489, 0.44594849091596489, 0.22338158967801147),
        (0.09157621350977073, 0.09157621350977073, 0.10995174365532187),
    ),
}
PERMUTATIONS = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2), (0, 2, 1), (2, 1, 0))


@cache
def rule(level, halvings=0):
    """Barycentric points and weights: twelve on a whole element, or six on each of its parts.

    The element is divided into 4^level equal parts, and each of these from its first
    corner into 2^halvings slices.

    Examples
    --------
    >>> [len(rule(level)[1]) for level in range(3)]
    [12, 24, 96]
    """
    points, weights = _points(DUNAVANT[4 if level + halvings else 6])
    parts = _all_parts(level, halvings)
    return _in_each(parts, points), np.tile(weights, len(parts)) / len(parts)


@cache
def places(level, halvings, n):
    """Barycentric points of a lattice of n intervals along each side of each part of a divided element."""
    i, j = np.array([(i, j) for i in range(n + 1) for j in range(n + 1 - i)]).T / n
    points = np.stack([i, j, 1 - i - j], axis=1)
    return _in_each(_all_parts(level, halvings), points)


def _in_each(parts, points):
    return np.einsum("qk,pkc->pqc", points, parts).reshape(-1, 3)


def _all_parts(level, halvings):
    """Corners of the slices of all parts, (n, 3, 3), in barycentric coordinates."""
    return np.einsum("sck,pkd->pscd", _slices(2**halvings), _parts(level)).reshape(-1, 3, 3)


def _slices(n):
    """Corners of n slices from the first corner, (n, 3, 3), in barycentric coordinates."""
    at = np.linspace(0, 1, n + 1)
    side = np.stack([np.zeros(n + 1), 1 - at, at], axis=1)
    return np.stack([np.tile([1.0, 0.0, 0.0], (n, 1)), side[:-1], side[1:]], axis=1)


def _points(orbits):
    points = {}
    for p, q, weight in orbits:
        for order in PERMUTATIONS:
            points[tuple(np.take((p, q, 1 - p - q), order).tolist())] = weight
    weights = np.array(list(points.values()))
    return np.array(list(points)), weights / weights.sum()


def _parts(level):
    """Corners of the parts, (4^level, 3, 3), in barycentric coordinates."""
    n = 2**level
    i, j = (k.ravel() for k in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    up = np.stack([i, j, i + 1, j, i, j + 1], axis=1)[i + j < n]
    down = np.stack([i + 1, j + 1, i, j + 1, i + 1, j], axis=1)[i + j < n - 1]
    second_third = np.concatenate([up, down]).reshape(-1, 3, 2) / n
    return np.concatenate([1 - second_third.sum(axis=2, keepdims=True), second_third], axis=2)


class Counted:
    """A function that counts the points at which it is evaluated.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).

    Attributes
    ----------
    evaluations : int
        Points so far.

    Examples
    --------
    >>> u = Counted(np.hypot)
    >>> u(np.array([3.0, 5.0]), np.array([4.0, 12.0])).tolist(), u.evaluations
    ([5.0, 13.0], 2)
    """

    def __init__(self, function):
        self.function, self.evaluations = function, 0

    def __call__(self, x, y):
        """Values, finite and of the shape of x and y, or a MeshError."""
        found = checks.function_values(self.function, x, y)
        self.evaluations += found.size
        return found


@dataclass(frozen=True)
class Misfit:
    """The error of linear interpolants of a function, and integrals of its square or of a higher power.

    Parameters
    ----------
    function : Counted
    spacing : float
        Elements of twice its square or more are divided for quadrature, so that what
        happens between the nodes of a coarse mesh is seen.
    sharpest : float
        Smallest angle of an element that is allowed, in radians.
    settings : Quadrature
    squarings : int
        How often the error is squared: once for the L2 norm, four times for its 16th power.
    unit : float
        Unit of values and errors, a power of two near the largest error, so that high
        powers neither vanish nor overflow.
    """

    function: Counted
    spacing: float
    sharpest: float = 0.0
    settings: Quadrature = field(default_factory=Quadrature)
    squarings: int = 1
    unit: float = 1.0

    def values(self, x, y):
        """Values of the function in units, finite and of the shape of x and y, or a MeshError."""
        found = self.function(x, y)
        return found if self.unit == 1 else found / self.unit

    def on_elements(self, corners, values, is_new=True):
        """Integral of the power of the error over each element; infinity for one that is refused.

        Parameters
        ----------
        corners : (m, 3, 2) ndarray of float
        values : (m, 3) ndarray of float
        is_new : bool
            Whether elements may be refused: one that a mesh has must have an error.

        Returns
        -------
        (m,) ndarray of float64
        """
        return self._integrals(corners, values, 1, self._powers, is_new)[:, 0]

    def moments(self, corners, values, is_new=True):
        """Integrals and half their slopes in the nodal values, (m, 3): for squares the integrals of e phi."""
        found = self._integrals(corners, values, 4, self._powers_and_moments, is_new)
        return found[:, 0], found[:, 1:]

    def _integrals(self, corners, values, columns, integrand, is_new):
        areas, sides = doubled_areas(corners) / 2, squared_sides(corners)
        found = np.full((len(corners), columns), np.inf)
        allowed = self.is_allowed(corners) if is_new else np.ones(len(corners), dtype=bool)
        divided = np.where(allowed, self._divisions(areas, sides), -1)
        for kind in np.unique(divided[allowed]):
            points, weights = rule(*self._level_and_halvings(kind))
            rows = np.flatnonzero(divided == kind)
            for part in _at_once(rows, len(weights), self.settings.batch):
                turn = _from_longest(sides[part])
                miss = self._misses(_turned(corners[part], turn), _turned(values[part], turn), points)
                found[part] = areas[part, None] * integrand(miss, points, weights, turn)
        return found

    def _powers(self, miss, points, weights, turn):
        return (powers(miss, self.squarings) @ weights)[:, None]

    def _powers_and_moments(self, miss, points, weights, turn):
        found = np.empty((len(miss), 4))
        found[:, 0] = powers(miss, self.squarings) @ weights
        moments = half_slopes(miss, self.squarings) @ (points * weights[:, None])
        np.put_along_axis(found[:, 1:], turn, moments, axis=1)
        return found

    def largest(self, corners, values):
        """Largest absolute error of all elements, at points that lie on their sides as well."""
        kinds = self._divisions(doubled_areas(corners) / 2, squared_sides(corners))
        found = 0.0
        for kind in np.unique(kinds):
            points = places(*self._level_and_halvings(kind), self.settings.intervals)
            rows = np.flatnonzero(kinds == kind)
            for part in _at_once(rows, len(points), self.settings.batch):
                turn = _from_longest(squared_sides(corners[part]))
                miss = self._misses(_turned(corners[part], turn), _turned(values[part], turn), points)
                found = max(found, np.abs(miss).max())
        return float(found)

    def _misses(self, corners, values, points):
        x, y = corners[..., 0] @ points.T, corners[..., 1] @ points.T
        return values @ points.T - self.values(x, y)

    def misses(self, corners, values):
        """Barycentric points, (q, 3), and how far u_h is from u there in each element, (m, q)."""
        points, _ = rule(0)
        return points, self._misses(corners, values, points)

    def _divisions(self, areas, sides):
        """Level and halvings for each element in one number."""
        settings = self.settings
        level = np.ceil(np.log2((2 * np.abs(areas) / self.spacing**2).clip(min=1)) / 2)
        level = level.clip(max=settings.most_quarterings)
        length = np.sqrt(sides.max(axis=1)) / 2**level / (settings.longest_part * self.spacing)
        halvings = np.ceil(np.log2(length.clip(min=1))).clip(max=settings.most_halvings)
        return (level * (settings.most_halvings + 1) + halvings).astype(int)

    def _level_and_halvings(self, kind):
        return divmod(int(kind), self.settings.most_halvings + 1)

    def is_allowed(self, corners):
        """Whether an element is neither too flat nor too sharp."""
        allowed = doubled_areas(corners) > 2 * self.settings.flattest * squared_sides(corners).max(axis=1)
        if self.sharpest > 0:
            allowed &= angles(corners).min(axis=1) >= self.sharpest
        return allowed

    def on_edges(self, ends, values):
        """Integral of the power of the error along each edge; ends (m, 2, 2), values (m, 2)."""
        return self.moments_on_edges(ends, values)[0]

    def moments_on_edges(self, ends, values):
        """Integrals and half their slopes in the two nodal values, (m, 2)."""
        at, weights = _gauss(self.settings.boundary_points)
        share = np.stack([1 - at, 1 + at]) / 2
        x, y = ends[..., 0] @ share, ends[..., 1] @ share
        miss, length = values @ share - self.values(x, y), np.hypot(*(ends[:, 1] - ends[:, 0]).T)
        moments = half_slopes(miss, self.squarings) @ (share * weights / 2).T
        return length * (powers(miss, self.squarings) @ (weights / 2)), length[:, None] * moments


@cache
def _gauss(n):
    """The n points and weights of Gauss on [-1, 1]."""
    return np.polynomial.legendre.leggauss(n)


def powers(miss, squarings):
    """miss ** (2 ** squarings), by multiplications, which are the same everywhere."""
    for _ in range(squarings):
        miss = miss * miss
    return miss


def half_slopes(miss, squarings):
    """Half the derivative of the same: miss itself for squares."""
    found = miss * 2.0 ** (squarings - 1)
    for _ in range(squarings - 1):
        miss = miss * miss
        found = found * miss
    return found


def doubled_areas(corners):
    """Twice the signed area of each element."""
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]


def squared_sides(corners):
    """Squared length of the side opposite each corner, (m, 3)."""
    sides = corners.take(TAILS, axis=1) - corners.take(HEADS, axis=1)
    sides *= sides
    return sides[..., 0] + sides[..., 1]


def _at_once(rows, points, batch):
    """The rows, each with the given number of points, in parts."""
    return np.array_split(rows, min(len(rows), -(-len(rows) * points // batch)))


def _from_longest(sides):
    """The order of the corners that begins opposite the longest side."""
    return (sides.argmax(axis=1)[:, None] + np.arange(3)) % 3


def _turned(array, turn):
    return np.take_along_axis(array, turn[..., None] if array.ndim == 3 else turn, axis=1)
