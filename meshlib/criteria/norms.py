"""Orders on cost vectors (section 2.2): L1, L2, maximum and lexicographic."""

from collections.abc import Hashable

import numpy as np

from .. import checks
from .._typing import Norm

NORMS = (1, 2, "max", "lexicographic")
SPELLINGS = {"L1": 1, "L2": 2, np.inf: "max"}  # other names of the first three
RELATIVE, ABSOLUTE = 1e-12, 1e-11  # least gain, relative to the old cost and to a typical one


def checked(norm: Norm, allowed: tuple[Norm, ...] = NORMS) -> Norm:
    """The norm as it stands in ``NORMS``, if it is one of those that are allowed.

    Examples
    --------
    >>> checked("L2"), checked(float("inf")), checked(1)
    (2, 'max', 1)
    """
    plain = SPELLINGS.get(norm, norm) if isinstance(norm, Hashable) else norm
    if np.isscalar(plain) and plain in allowed:
        return plain
    spelt = {short: name for name, short in SPELLINGS.items() if isinstance(name, str)}
    return checks.choice(norm, tuple(spelt.get(n, n) for n in allowed), "norm")


def measure(costs, norm, grain=0.0):
    """What an order compares: the sum, the sum of squares, the maximum, or all, sorted.

    The L2 norm is compared by its square, which needs no root.  For the
    lexicographic order costs are rounded to multiples of ``grain``, which makes ties
    of what differs by rounding noise and keeps the order transitive.

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


def norm_of(costs, norm):
    """The norm of a cost vector; for the lexicographic order its largest entry.

    Examples
    --------
    >>> norm_of(np.array([3.0, 4.0]), 2), norm_of(np.array([3.0, 4.0]), 1)
    (5.0, 7.0)
    """
    found = measure(costs, norm)
    return found**0.5 if norm == 2 else found[0] if isinstance(found, tuple) else found


def tolerance(scale):
    """Relative and absolute gain of a norm that a swap must exceed, for costs of this scale."""
    return RELATIVE, ABSOLUTE * scale


def is_below(new, old, norm, relative, absolute):
    """Whether a measure is below another by more than the tolerance.

    For the L2 norm the roots are compared: costs h that are known but for d are so
    squared but for 2 h d, which no fixed tolerance on squares would cover.  With a
    negative absolute part the measure may also rise, by less than that.

    Examples
    --------
    >>> is_below(1.0, 2.0, 2, *tolerance(1.0)), is_below(1.0, 1.0 + 1e-15, 2, *tolerance(1.0))
    (True, False)
    """
    if isinstance(new, tuple):
        return new < old
    if new >= old:
        return new - old < -absolute
    if norm == 2:
        new, old = new**0.5, old**0.5
    return new < old * (1 - relative) - absolute


def precedes(first, second, norm, scale=0.0):
    """Whether the first cost vector comes strictly before the second.

    Examples
    --------
    >>> precedes([2, 1], [2, 3], "max"), precedes([2, 1], [3, 0], "lexicographic")
    (True, True)
    """
    relative, absolute = tolerance(scale)
    first, second = (measure(costs, norm, absolute) for costs in (first, second))
    return is_below(first, second, norm, relative, absolute)
