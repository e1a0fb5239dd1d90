"""Draws: first values as facts, so that no version of NumPy can change them unseen."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshlib.support import random_numbers
from meshlib.support.random_numbers import Draws, permutation

# The first 64 random bits of PCG64(1), and the 53 uppermost of them divided by 2^53.
RAW = [9441442522235856127, 17532960557476522086, 2659275481604167885]
UNIFORM = [0.5118216247002567, 0.9504636963259353, 0.14415961271963373]
EXPONENTIAL = [0.7170744167610924, 3.0050494706625277, 0.15567138368438282]  # -log(1 - u)

PERMUTED = [7, 2, 3, 4, 9, 6, 8, 0, 1, 5]  # Draws([3, 4]).permutation(10)


class Bits:
    """Bits that are given."""

    def __init__(self, bits):
        self.bits = bits

    def random_raw(self, shape):
        return np.full(shape, self.bits, dtype=np.uint64)


def of_bits(bits):
    draws = Draws(0)
    draws._bits = Bits(bits)
    return draws


def test_first_values():
    assert np.random.PCG64(1).random_raw(3).tolist() == RAW
    assert Draws(1).uniform(3).tolist() == UNIFORM == [(bits >> 11) / 2**53 for bits in RAW]
    assert Draws(1).exponential(3) == pytest.approx(EXPONENTIAL, rel=1e-15)
    assert Draws(1).indices(10, 8).tolist() == [5, 9, 1, 9, 3, 4, 8, 4]
    assert Draws([3, 4]).indices(10, 8).tolist() == [8, 4, 1, 1, 5, 7, 1, 7]


def test_one_stream_for_all():
    """Numbers drawn two and one are the three drawn at once, whatever the shape."""
    draws = Draws(1)
    first, second = draws.uniform((2, 1)), draws.uniform(1)
    assert [*first.ravel(), *second] == UNIFORM
    assert draws.uniform(0).shape == (0,) and draws.indices(3, (2, 2)).shape == (2, 2)


def test_the_least_and_the_largest():
    """All bits 0 give 0; all bits 1 give 1 - 2^-53, and its exponential 53 log 2."""
    low, high = of_bits(0), of_bits(2**64 - 1)
    assert low.uniform(1) == low.exponential(1) == low.indices(7, 1) == 0
    assert high.uniform(1) == 1 - 2.0**-53 < 1
    assert high.exponential(1) == pytest.approx(53 * np.log(2))


@given(st.integers(1, 2**31))
def test_no_index_is_too_large(count):
    assert of_bits(2**64 - 1).indices(count, 1) == count - 1


def test_as_likely_as_they_should_be():
    """Within five standard deviations: sqrt(n p (1 - p)) of a count, 1 / sqrt(n) of the mean of exp."""
    n, faces = 60_000, 6
    counts = np.bincount(Draws(0).indices(faces, n), minlength=faces)
    assert len(counts) == faces and np.abs(counts - n / faces).max() < 5 * np.sqrt(n * 5 / 36)
    waits = Draws(0).exponential(n)
    assert abs(waits.mean() - 1) < 5 / np.sqrt(n) and abs((waits > 1).mean() - np.exp(-1)) < 2.5 / np.sqrt(n)


def test_first_permutations():
    assert Draws([0, 1]).permutation(5).tolist() == [1, 4, 3, 0, 2]
    assert Draws(1).permutation(10).tolist() == [8, 4, 7, 0, 1, 2, 5, 9, 6, 3]
    assert Draws([3, 4]).permutation(10).tolist() == PERMUTED
    assert [Draws(1).permutation(n).tolist() for n in (0, 1)] == [[], [0]]


@pytest.mark.parametrize("n", [*range(2, 70), 88, 208, 344, 1023, 1024, 1025, 3000, 65_537])
def test_permutations_are_those_of_numpy_2(n):
    """Of NumPy 2.0 to 2.4 at least; if this fails with a newer one, `permutation` still gives the old ones."""
    for seed in (0, 1, [0, n], [7, 123_456_789_012]):
        expected = np.random.default_rng(seed).permutation(n)
        found = Draws(seed).permutation(n)
        assert found.dtype == expected.dtype and found.tolist() == expected.tolist()


@pytest.mark.parametrize("agrees", [True, False])
def test_permutations_do_not_hang_on_numpy(monkeypatch, agrees):
    monkeypatch.setattr(random_numbers, "_numpy_agrees", lambda n: agrees)
    assert permutation([3, 4], 10).tolist() == PERMUTED


def test_other_permutations_of_numpy_are_not_taken(monkeypatch):
    monkeypatch.setattr(random_numbers, "_by_numpy", lambda seed, n: np.arange(n))
    random_numbers._numpy_agrees.cache_clear()
    assert permutation([3, 4], 10).tolist() == PERMUTED
    random_numbers._numpy_agrees.cache_clear()
