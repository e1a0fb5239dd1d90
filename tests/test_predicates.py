"""Exact signs, against rational arithmetic and against Shewchuk's own predicates."""

import numpy as np
import pytest
from support import exact_circle, exact_turn

from meshlib.geometry.predicates import incircle, orientation

shewchuk = pytest.importorskip("shewchuk", reason="its wheels end at Python 3.13")

ULP = 2.0**-53  # spacing of the doubles just below 1


def near_a_line(rng, n):
    """Points on a lattice of spacing 1e-16 about (0.5, 0.5), with (12, 12) and (24, 24)."""
    p = 0.5 + ULP * rng.integers(0, 256, (n, 2))
    return p, np.full((n, 2), 12.0), np.full((n, 2), 24.0)


def near_a_circle(rng, n):
    """Four points within an ulp or two of the unit square's corners, displaced by 0.5."""
    corners = np.array([[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [0.5, 1.5]])
    return np.moveaxis(corners + 2 * ULP * rng.integers(-2, 3, (n, 4, 2)), 1, 0)


def naive_turn(a, b, c):
    u, v = b - a, c - a
    return np.sign(u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0])


def test_orientation_is_exact_on_a_lattice_where_floats_are_not(rng):
    a, b, c = near_a_line(rng, 2000)
    exact = [exact_turn(*p) for p in zip(a, b, c, strict=True)]
    assert set(exact) == {-1, 0, 1}
    assert orientation(a, b, c).tolist() == exact
    assert np.mean(naive_turn(a, b, c) != exact) > 0.1  # else the lattice is too coarse to tell


def test_orientation_agrees_with_shewchuk(rng):
    a, b, c = near_a_line(rng, 2000)
    triples = zip(a.tolist(), b.tolist(), c.tolist(), strict=True)
    theirs = [shewchuk.orientation(*p, *q, *r) for p, q, r in triples]
    assert orientation(a, b, c).tolist() == theirs


def test_incircle_is_exact_near_a_circle(rng):
    a, b, c, d = near_a_circle(rng, 2000)
    exact = [exact_circle(*p) for p in zip(a, b, c, d, strict=True)]
    assert set(exact) == {-1, 0, 1}
    assert incircle(a, b, c, d).tolist() == exact


def test_incircle_agrees_with_shewchuk_up_to_its_sign(rng):
    """Ours is +1 inside for a counter-clockwise triangle, the package's is -1."""
    points = near_a_circle(rng, 2000)
    theirs = [shewchuk.incircle_test(*np.concatenate(p).tolist()) for p in zip(*points, strict=True)]
    assert shewchuk.incircle_test(0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.25, 0.25) == -1
    assert incircle([0, 0], [1, 0], [0, 1], [0.25, 0.25]) == 1
    assert (-incircle(*points)).tolist() == theirs


def test_orientation_changes_sign_with_the_order_of_its_points(rng):
    a, b, c = near_a_line(rng, 500)
    turn = orientation(a, b, c)
    assert np.array_equal(orientation(b, c, a), turn)
    assert np.array_equal(orientation(b, a, c), -turn)


@pytest.mark.parametrize("scale", [1e-320, 1e-200, 1e-9, 1.0, 1e9, 1e150, 1e300])
def test_neither_underflow_nor_overflow_changes_a_sign(scale):
    square = scale * np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert orientation(*square[:3]) == 1
    assert orientation(square[0], square[2], square[0]) == 0
    assert incircle(*square) == 0
    assert incircle(*square[:3], scale * np.array([0.5, 0.5])) == 1
    assert incircle(*square[:3], scale * np.array([-0.5, 1.5])) == -1


def test_one_ulp_at_a_great_distance_is_seen():
    far = 1e6
    up = np.nextafter(far, np.inf)
    assert orientation([0, 0], [far, far], [far, up]) == 1
    assert orientation([0, 0], [far, far], [up, far]) == -1


def test_points_are_broadcast():
    fan = np.array([[1.0, -1.0], [1.0, 0.0], [1.0, 1.0]])
    assert orientation([0, 0], [2, 0], fan).tolist() == [-1, 0, 1]
    assert orientation(fan[:, None], fan[None], [0, 0]).shape == (3, 3)
    assert orientation(np.empty((0, 2)), [0, 0], [1, 1]).shape == (0,)


def test_three_collinear_points_have_no_inside():
    line = np.array([[0, 0], [1, 1], [2, 2]])
    assert orientation(*line) == 0
    assert incircle([0, 0], [1, 0], [0, 1], [0, 0]) == 0  # a corner lies on its own circle
