r"""Functions of one direction, u(x, y) = f(s) with s = d . (x, y): boundary nodes, in turn left and right.

Where a function is constant along parallel lines, strips between such lines are good
meshes, with an error of the order 1 / V^2. Nodes in turn do better than pairs of
nodes: each element still reaches over two spacings, but over a third as many products
of their squares, so that the error is 3/4 of that of strips::

    *---*---*---*         *-------*-------*
    | / | / | / |          \     / \     / \
    |/  |/  |/  |           \   /   \   /   \       s grows to the right
    *---*---*---*            *-------*-------*
"""

import numpy as np

from ..mesh.mesh import Mesh
from ..support.random_numbers import Draws


def in_turn(function, low, high, nodes, power, settings):
    """A mesh for a function of one direction on a rectangle, or None for another function.

    Parameters
    ----------
    function : callable
        Vectorised u(x, y).
    low, high : (2,) ndarray of float
        Corners of the rectangle.
    nodes : int
    power : int
        Of the error, whose integral is to be small.
    settings : OneDirection

    Returns
    -------
    Mesh or None

    Examples
    --------
    >>> import numpy as np
    >>> from meshlib.approximation.settings import OneDirection
    >>> unit = np.zeros(2), np.ones(2)
    >>> in_turn(lambda x, y: (x + 2 * y) ** 2, *unit, 20, 2, OneDirection()).counts
    (20, 37, 18)
    >>> in_turn(lambda x, y: x * y, *unit, 20, 2, OneDirection()) is None
    True
    """
    direction = _direction(function, low, high, settings) if nodes >= settings.fewest_nodes else None
    if direction is None:
        return None
    corners = low + np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * (high - low)  # counter-clockwise
    chains = _Chains(corners, direction)
    total = _total_density(function, chains, power, settings)
    if total is None:
        return None
    return chains.mesh(_equidistributed(chains, total, nodes - len(corners), settings.phases))


def _direction(function, low, high, settings):
    """The unit vector along which alone the function changes, or None."""
    share = settings.difference
    points = low + (share + (1 - 2 * share) * Draws(0).uniform((settings.points, 2))) * (high - low)
    step = share * (high - low).min()
    ahead, behind = (
        np.stack([function(*(points + e).T) for e in signed * np.eye(2)]) for signed in (step, -step)
    )
    slopes = (ahead - behind).T
    steepest = slopes[np.hypot(*slopes.T).argmax()]
    if not np.isfinite(slopes).all() or not steepest.any():
        return None
    direction = steepest / np.hypot(*steepest)
    direction[np.abs(direction) < settings.axis] = 0
    ahead = _across(points, low, high, direction)
    return direction if _is_constant(function, *ahead, settings.constant) else None


def _across(points, low, high, direction):
    """Points, and as many others on the lines across the direction through them."""
    across = np.array([-direction[1], direction[0]])
    away = (Draws(1).uniform(len(points)) - 0.5)[:, None] * 2 * np.hypot(*(high - low)) * across
    inside = ((points + away > low) & (points + away < high)).all(axis=1)
    return points[inside], (points + away)[inside]


def _is_constant(function, points, others, share):
    """Whether the function differs between points and others by at most a share of its range."""
    here, there = (function(*p.T) for p in (points, others))
    return np.abs(here - there).max() <= share * np.ptp(here)


def _total_density(function, chains, power, settings):
    """Points along s and the integral up to each of the density of nodes that is best, or None for a plane.

    An element at s has an area proportional to the length l of the line there and
    an error like f'' h^2: the integral of l f''^p h^(2p) is least where 1 / h is
    proportional to (l f''^p)^(1/(2p + 1)).
    """
    s = np.linspace(*chains.ends, settings.samples)
    right, left = (chains.points(s, side) for side in (0, 1))
    values = function(*((left + right) / 2).T)
    second = np.abs(np.diff(values, 2))
    if second.max() <= settings.rounding * np.abs(values).max():
        return None
    length = np.hypot(*(right - left)[1:-1].T)
    density = length ** (1 / (2 * power + 1)) * second ** (power / (2 * power + 1))
    density = np.pad(density + settings.background * density.mean(), 1, mode="edge")
    return s, np.append(0, np.cumsum((density[1:] + density[:-1]) / 2))


def _equidistributed(chains, total, number, n_phases):
    """Values of s with equal integrals of the density between them, none at that of a corner."""
    s, upto = total
    corners = np.interp(np.concatenate([c @ chains.direction for c in chains.corners]), s, upto)
    steps = upto[-1] / number
    phases = (np.arange(n_phases) + 0.5) / n_phases
    apart = np.abs((corners[:, None] / steps - phases + 0.5) % 1 - 0.5).min(axis=0)
    return np.interp((np.arange(number) + phases[apart.argmax()]) * steps, upto, s)


class _Chains:
    """The boundary of a rectangle as two chains along which s grows, right and left of the direction.

    Attributes
    ----------
    corners : list of two (m, 2) ndarray of float
        Of each chain, in order.
    ends : tuple of float
        Least and largest s.
    """

    def __init__(self, corners, direction):
        self.direction = direction
        at = corners @ direction
        first, last = at.argmin(), at.argmax()
        self.corners = [self._chain(corners, at, first, last, turn) for turn in (1, -1)]
        self.ends = float(at.min()), float(at.max())

    @staticmethod
    def _chain(corners, at, first, last, turn):
        count = (last - first) * turn % len(corners)
        return corners[(first + turn * np.arange(count + 1)) % len(corners)]

    def points(self, s, side):
        """Where the lines of s meet a chain."""
        corners = self.corners[side]
        return np.stack([np.interp(s, corners @ self.direction, x) for x in corners.T], axis=1)

    def mesh(self, inner):
        """The mesh of the corners and of nodes at these s, in turn on either chain."""
        right, left = (self._with(inner[side::2], side) for side in (0, 1))
        nodes = np.concatenate([right, left[1:-1]])
        of_right, of_left = np.split(np.arange(len(nodes)), [len(right)])
        of_left = np.concatenate([of_right[:1], of_left, of_right[-1:]])
        return Mesh(nodes, _zipped(of_right, of_left, nodes @ self.direction))

    def _with(self, s, side):
        points = np.concatenate([self.corners[side], self.points(s, side)])
        return points[np.argsort(points @ self.direction, kind="stable")]


def _zipped(right, left, s):
    """Elements between two chains of nodes that share their ends, (T, 3), node by node in the order of s."""
    heads = np.concatenate([right[2:-1], left[2:-1]])
    is_right = np.arange(len(heads)) < len(right) - 3
    order = np.lexsort((is_right, s[heads]))
    turn = is_right[order]
    i, j = 1 + np.cumsum(turn), 1 + np.cumsum(~turn)
    behind = np.where(turn, right[i - 1], left[j - 1])
    between = np.stack([behind, right[i], left[j]], axis=1)
    return np.concatenate([[[right[0], right[1], left[1]]], between, [[right[-2], right[-1], left[-2]]]])
