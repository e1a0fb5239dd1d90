"""Which of many changes can be made at once: the best, none of which touches what a better one does."""

import numpy as np

from .._typing import FloatArray, IntArray


def coarse(numbers: FloatArray, bits: int = 26) -> FloatArray:
    """Numbers rounded to 26 bits, about eight digits, so that those which differ by rounding are equal.

    Examples
    --------
    >>> 0.1 + 0.2 == 0.3
    False
    >>> one, other, infinite = coarse(np.array([0.1 + 0.2, 0.3, np.inf]))
    >>> bool(one == other), float(infinite)
    (True, inf)
    """
    mantissa, exponent = np.frexp(numbers)
    return np.ldexp(np.round(np.ldexp(mantissa, bits)), exponent - bits)


def independent(gain: FloatArray, rows: IntArray, items: IntArray, n_items: int) -> IntArray:
    """Candidates of which none shares an item with a better one, best first.

    Parameters
    ----------
    gain : (m,) ndarray of float
        Gain of each candidate; of equal ones the first is the better.
    rows, items : (k,) ndarray of int
        Pairs of a candidate and an item that it touches; items below 0 do not count.
    n_items : int

    Returns
    -------
    (p,) ndarray of int64
        Numbers of candidates.

    Examples
    --------
    Candidates 0 and 1 touch item 0, candidates 1 and 2 item 1:

    >>> rows, items = np.array([0, 1, 1, 2]), np.array([0, 0, 1, 1])
    >>> independent(np.array([3.0, 2.0, 1.0]), rows, items, 2).tolist()
    [0]
    """
    order = np.argsort(-gain, kind="stable")
    rank = np.empty(len(gain), dtype=np.int64)
    rank[order] = np.arange(len(gain))
    there = items >= 0
    rows, items = rows[there], items[there]
    first = np.full(n_items, len(gain))
    np.minimum.at(first, items, rank[rows])
    free = np.ones(len(gain), dtype=bool)
    free[rows[first[items] < rank[rows]]] = False
    return order[free[order]]
