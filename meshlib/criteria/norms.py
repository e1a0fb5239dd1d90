"""Orders on cost vectors (section 2.2): L1, L2, maximum and lexicographic."""

from collections.abc import Hashable
from typing import NamedTuple, TypeAlias, cast

import numpy as np

from .. import checks
from .._typing import ArrayLike, Norm

Measure: TypeAlias = float | tuple[float, ...]  # of a cost vector, as the orders compare it

NORMS = (1, 2, "max", "lexicographic")
SPELLINGS: dict[Hashable, Norm] = {"L1": 1, "L2": 2, np.inf: "max"}  # other names of the first three


class Tolerance(NamedTuple):
    """Gain that a norm must exceed to count as one: the sum of two parts."""

    relative: float = 1e-12  # fraction of the old norm, more than the rounding of a sum of five costs
    absolute: float = 1e-11  # gain in the unit of the costs, if a typical cost is 1


def checked(norm: Norm, allowed: tuple[Norm, ...] = NORMS) -> Norm:
    """The norm under its name in ``NORMS``, or a MeshError if it is not among those allowed.

    Examples
    --------
    >>> checked("L2"), checked(float("inf")), checked(1)
    (2, 'max', 1)
    """
    plain = SPELLINGS.get(norm, norm) if isinstance(norm, Hashable) else norm
    if np.isscalar(plain) and plain in allowed:
        return cast("Norm", plain)
    spelt = {short: name for name, short in SPELLINGS.items() if isinstance(name, str)}
    return checks.choice(norm, tuple(spelt.get(n, n) for n in allowed), "norm")


def measure(costs: ArrayLike, norm: Norm, grain: float = 0.0) -> Measure:
    """What an order compares: the sum, the sum of squares, the maximum, or all costs, largest first.

    The L2 norm is compared by its square, which needs no root.  For the
    lexicographic order costs are rounded to multiples of ``grain``: costs that differ by
    rounding noise are then equal, and the order is transitive.

    Examples
    --------
    >>> measure(np.array([3.0, 4.0]), 2)
    25.0
    >>> measure(np.array([3.0, 4.0]), "lexicographic")
    (4.0, 3.0)
    """
    costs = np.asarray(costs, dtype=float)
    if checked(norm) == "lexicographic":
        costs = np.rint(costs / grain) * grain if grain > 0 else costs
        return tuple(np.sort(costs)[::-1].tolist())
    return {
        1: lambda: float(costs.sum()),
        2: lambda: float((costs**2).sum()),
        "max": lambda: float(costs.max(initial=0.0)),
    }[checked(norm)]()


def norm_of(costs: ArrayLike, norm: Norm) -> float:
    """The norm of a cost vector; for the lexicographic order its largest entry.

    Examples
    --------
    >>> norm_of(np.array([3.0, 4.0]), 2), norm_of(np.array([3.0, 4.0]), 1)
    (5.0, 7.0)
    """
    found = measure(costs, norm)
    if isinstance(found, tuple):
        return found[0]
    return found**0.5 if norm == 2 else found


def tolerance(scale: float) -> Tolerance:
    """The gain of a norm that a swap must exceed, where a typical cost is ``scale``."""
    unit = Tolerance()
    return unit._replace(absolute=unit.absolute * scale)


def is_below(new: Measure, old: Measure, norm: Norm, relative: float, absolute: float) -> bool:
    """Whether a measure is below another by more than the tolerance.

    For the L2 norm the roots are compared.  An error d of a cost h is an error 2 h d of
    its square, so that no fixed tolerance would do for squares.  With a negative
    ``absolute`` the measure may also rise, by less than ``-absolute``.

    Examples
    --------
    >>> is_below(1.0, 2.0, 2, *tolerance(1.0)), is_below(1.0, 1.0 + 1e-15, 2, *tolerance(1.0))
    (True, False)
    """
    if isinstance(new, tuple) and isinstance(old, tuple):
        return new < old
    after, before = cast("tuple[float, float]", (new, old))
    if after >= before:
        return after - before < -absolute
    if norm == 2:
        after, before = after**0.5, before**0.5
    return after < before * (1 - relative) - absolute


def precedes(first: ArrayLike, second: ArrayLike, norm: Norm, scale: float = 0.0) -> bool:
    """Whether the first cost vector comes strictly before the second.

    Examples
    --------
    >>> precedes([2, 1], [2, 3], "max"), precedes([2, 1], [3, 0], "lexicographic")
    (True, True)
    """
    relative, absolute = tolerance(scale)
    new, old = (measure(costs, norm, absolute) for costs in (first, second))
    return is_below(new, old, norm, relative, absolute)
