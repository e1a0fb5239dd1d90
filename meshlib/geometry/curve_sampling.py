"""Densities along a closed curve, from samples at equal steps of its parameter.

Samples are arrays whose last axis goes once round the curve: point i belongs to the parameter
t = i / n, and the first point follows the last.
"""

from collections.abc import Callable

import numpy as np

from .._typing import FloatArray
from ..errors import InvalidInputError


def refuse_open(points: FloatArray, gap: float = 1e-9) -> None:
    """Raise a MeshError if the last point is not the first, (2, n) from t = 0 to t = 1.

    They may differ along x and y by ``gap``, as a fraction of the extent of the curve.
    """
    first, last = points[:, 0], points[:, -1]
    if np.abs(last - first).max() > gap * np.ptp(points, axis=1).max():
        raise InvalidInputError(
            "closed",
            "the curve is at ({:g}, {:g}) for t = 0 and at ({:g}, {:g}) for t = 1; give a closed one".format(
                *first, *last
            ),
        )


def refuse_unordered(t: FloatArray, least: int) -> None:
    """Raise a MeshError if t is not an array of at least ``least`` numbers ascending within one period."""
    if t.ndim != 1 or len(t) < least:
        raise InvalidInputError(
            "shape", f"parameters have shape {t.shape}; give one number for each of at least {least} nodes"
        )
    bad = np.flatnonzero(~(np.diff(t, append=t[0] + 1) > 0))
    if bad.size:
        wrong = (bad + 1) % len(t)
        raise InvalidInputError(
            "order",
            f"parameter {wrong[0]} is {t[wrong[0]]:g}, which does not follow {t[bad[0]]:g}; "
            "give them ascending, within one period",
            wrong,
            wrong.size,
        )


def arc_parameters(start: FloatArray, parts: int = 256) -> FloatArray:
    """Equally spaced parameters from each of (n,) ascending ones to the next, (n, parts + 1).

    The last arc ends where the first begins; parameters are at least 0 and below 1.
    """
    end = np.append(start[1:], start[0] + 1)
    return (start[:, None] + (end - start)[:, None] * np.linspace(0, 1, parts + 1)) % 1


def derivative(values: FloatArray) -> FloatArray:
    """Derivative by t along the last axis, by central differences around the period."""
    return (np.roll(values, -1, axis=-1) - np.roll(values, 1, axis=-1)) * values.shape[-1] / 2


def second_derivative(values: FloatArray) -> FloatArray:
    """Second derivative by t along the last axis, by central differences around the period."""
    return (np.roll(values, -1, axis=-1) - 2 * values + np.roll(values, 1, axis=-1)) * values.shape[-1] ** 2


def above_noise(second: FloatArray, values: FloatArray, units: int = 8) -> FloatArray:
    """Absolute values of second derivatives, (n,); 0 where they may be nothing but rounding.

    The rounding error of a second difference is ``units`` units in the last place of the
    largest of the ``values`` from which it was computed.
    """
    noise = units * np.finfo(float).eps * second.shape[-1] ** 2 * np.abs(values).max()
    return np.where(np.abs(second) > noise, np.abs(second), 0)


def curvature_density(points: FloatArray, speed: FloatArray) -> FloatArray:
    """|k|^(1/3) ds/dt for points (2, n) and speed ds/dt; the speed cancels (affine arc length)."""
    (x, y), (xx, yy) = derivative(points), second_derivative(points)
    return above_noise(x * yy - y * xx, points * speed) ** (1 / 3)


def data_density(u: FloatArray, speed: FloatArray) -> FloatArray:
    """|u_ss|^(2/5) ds/dt for values u, (n,), where u_ss = (u_tt - u_t speed_t / speed) / speed^2."""
    u_ss = (second_derivative(u) - derivative(u) * derivative(speed) / speed) / speed**2
    return above_noise(u_ss, u / speed**2) ** (2 / 5) * speed


def sliver_areas(x: FloatArray, y: FloatArray) -> FloatArray:
    """Area between each arc and its chord, (m,); row i of x and y, (m, n), are points along arc i."""
    chord = np.stack([x[:, -1] - x[:, 0], y[:, -1] - y[:, 0]])[..., None]
    away = np.stack([x - x[:, :1], y - y[:, :1]])
    along = (away * chord).sum(axis=0)
    height = np.abs(chord[0] * away[1] - chord[1] * away[0])
    slivers = ((height[:, 1:] + height[:, :-1]) / 2 * np.diff(along)).sum(axis=1)
    return slivers / (chord**2).sum(axis=0)[:, 0]


DENSITIES: dict[str, Callable[[FloatArray, FloatArray], FloatArray]] = {
    "curvature": curvature_density,
    "length": lambda points, speed: speed,
    "parameter": lambda points, speed: np.ones_like(speed),
}  # densities by t, from points (2, n) and speed (n,)
