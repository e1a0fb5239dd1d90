"""Random numbers that are the same on every platform and with every version of NumPy."""

from collections.abc import Sequence
from functools import cache

import numpy as np

from .._typing import FloatArray, IntArray, NDArray

MANTISSA_BITS = 53  # of 64 random bits, those that a float64 in [0, 1) keeps


class Draws:
    """Numbers drawn one after the other from a seed.

    Parameters
    ----------
    seed : int or sequence of int
        At least 0.

    Notes
    -----
    NumPy promises the stream of bits of a bit generator for ever, but not what its
    `Generator` makes of them (NEP 19).  So the few distributions that are needed are made
    here; only `exponential` depends on the platform, in the last bit of its logarithm.

    Examples
    --------
    >>> draws = Draws(1)
    >>> draws.uniform(3).round(4).tolist(), draws.indices(6, 8).tolist()
    ([0.5118, 0.9505, 0.1442], [5, 1, 2, 4, 2, 3, 0, 4])
    """

    def __init__(self, seed: int | Sequence[int]) -> None:
        self._bits = np.random.PCG64(seed)

    def uniform(self, shape: int | tuple[int, ...]) -> FloatArray:
        """Float64 numbers of at least 0 and below 1, an array of this shape."""
        return (self._raw(shape) >> np.uint64(64 - MANTISSA_BITS)) * 2.0**-MANTISSA_BITS

    def exponential(self, shape: int | tuple[int, ...]) -> FloatArray:
        """Float64 numbers above x with probability exp(-x), an array of this shape."""
        return -np.log1p(-self.uniform(shape))

    def indices(self, count: int, shape: int | tuple[int, ...]) -> IntArray:
        """Int64 numbers from 0 to count - 1, all equally likely, an array of this shape."""
        return (self.uniform(shape) * count).astype(np.int64)

    def permutation(self, n: int) -> IntArray:
        """The numbers from 0 to n - 1 in random order, (n,) int64; all orders are equally likely.

        Notes
        -----
        Fisher-Yates from the end: item i changes places with a random one of the items 0 to i.
        Its number is a word of 32 bits, cut off above the highest bit of i; words that still
        exceed i are skipped.  From a fresh seed the order is therefore the one that
        ``numpy.random.default_rng(seed).permutation(n)`` gives in NumPy 2.

        Examples
        --------
        >>> Draws([0, 1]).permutation(5).tolist()
        [1, 4, 3, 0, 2]
        """
        items, last, words = list(range(n)), n - 1, self._words(2 * n)
        while last > 0:
            mask = (1 << last.bit_length()) - 1
            last, used = _exchanged(items, last, (words[: mask + 1] & mask).tolist())
            words = words[used:] if used < len(words) else self._words(n)
        return np.array(items, dtype=np.int64)

    def _words(self, count: int) -> NDArray[np.uint32]:
        """At least ``count`` words of 32 bits: of each 64 bits first the lower half."""
        return self._raw(-(-count // 2)).astype("<u8").view("<u4")

    def _raw(self, shape: int | tuple[int, ...]) -> NDArray[np.uint64]:
        return np.asarray(self._bits.random_raw(shape), dtype=np.uint64)


def permutation(seed: int | Sequence[int], n: int) -> IntArray:
    """The permutation `Draws.permutation` of a fresh seed, several times faster.

    NumPy's own permutations are these in NumPy 2, but it does not promise that they stay.
    They are taken if they agree on a few seeds for this n, which is checked once.

    Examples
    --------
    >>> permutation([0, 1], 5).tolist()
    [1, 4, 3, 0, 2]
    """
    return _by_numpy(seed, n) if _numpy_agrees(n) else Draws(seed).permutation(n)


def _by_numpy(seed: int | Sequence[int], n: int) -> IntArray:
    return np.random.Generator(np.random.PCG64(seed)).permutation(n)


@cache
def _numpy_agrees(n: int, n_seeds: int = 4) -> bool:
    """Whether NumPy's permutations of n numbers are those of `Draws`, for a few seeds."""
    seeds = range(n_seeds)
    return all(np.array_equal(_by_numpy(seed, n), Draws(seed).permutation(n)) for seed in seeds)


def _exchanged(items: list[int], last: int, words: list[int]) -> tuple[int, int]:
    """Exchange items, in place, down to the next power of two; the last item left, and the words used."""
    end = 1 << (last.bit_length() - 1)
    for used, other in enumerate(words, 1):
        if other <= last:
            items[last], items[other] = items[other], items[last]
            last -= 1
            if last < end:
                return last, used
    return last, len(words)
