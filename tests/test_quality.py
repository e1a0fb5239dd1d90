"""Maximum angle, skewness and aspect ratio: hand-made elements and identities."""
import dataclasses
import sys

import numpy as np
import pytest
from hypothesis import given, settings

from meshlib import Mesh, delaunay, quality
from meshlib.quality import angles
from strategies import meshes

HEIGHT = np.sqrt(3) / 2


def one(*nodes):
    return quality(Mesh(nodes, [[0, 1, 2]]))


def test_equilateral():
    q = one((0, 0), (1, 0), (0.5, HEIGHT))
    assert q.maximum_angle == pytest.approx([60])
    assert q.skewness == pytest.approx([0], abs=1e-12)
    assert q.aspect_ratio == pytest.approx([1])


def test_half_a_square():
    """Angles 90, 45, 45: skewness (30 + 15 + 15)/3 = 20 degrees; AR 4 sqrt(3) (1/2) / (1 + 1 + 2)."""
    q = one((0, 0), (1, 0), (0, 1))
    assert q.maximum_angle == pytest.approx([90])
    assert q.skewness == pytest.approx([np.radians(20)])
    assert q.aspect_ratio == pytest.approx([HEIGHT])


def test_half_an_equilateral():
    """Angles 30, 60, 90: skewness (30 + 0 + 30)/3 = 20 degrees; AR 4 sqrt(3) (sqrt(3)/8) / (1 + 1/4 + 3/4)."""
    q = one((0, 0), (0.5, 0), (0, HEIGHT))
    assert q.maximum_angle == pytest.approx([90])
    assert q.skewness == pytest.approx([np.radians(20)])
    assert q.aspect_ratio == pytest.approx([0.75])


def test_a_flat_element():
    q = one((0, 0), (2, 0), (1, 1e-9))
    assert q.maximum_angle == pytest.approx([180])
    assert q.skewness == pytest.approx([np.radians(80)])  # (120 + 60 + 60)/3
    assert q.aspect_ratio == pytest.approx([0], abs=1e-8)


@settings(max_examples=60)
@given(meshes(scales=(1.0, 2.0 ** -30, 1e6)))  # no element is flat but for rounding
def test_identities(mesh):
    angle, q = angles(mesh.corners), quality(mesh)
    assert np.allclose(angle.sum(axis=1), np.pi)
    third = np.pi / 3
    assert np.allclose(q.skewness, 2 / 3 * np.maximum(angle.max(axis=1) - third, third - angle.min(axis=1)))
    assert np.allclose(q.aspect_ratio, np.sqrt(3) / (1 / np.tan(angle)).sum(axis=1))
    assert (q.aspect_ratio > 0).all() and (q.aspect_ratio <= 1 + 1e-12).all()
    assert (q.maximum_angle >= 60 - 1e-9).all() and (q.maximum_angle < 180).all()


@pytest.mark.parametrize("scale", [1e-9, 0.1, 1e6])
def test_size_place_and_turn_do_not_matter(scale, rng):
    mesh = delaunay(rng.random((20, 2)))
    turn = np.array([[0.6, 0.8], [-0.8, 0.6]])
    first, second = quality(mesh), quality(Mesh(scale * (mesh.nodes @ turn + 3), mesh.elements))
    for name in ("maximum_angle", "skewness", "aspect_ratio"):
        assert np.allclose(getattr(first, name), getattr(second, name), rtol=1e-6, atol=1e-7), name


def test_batches_do_not_matter(rng, monkeypatch):
    mesh = delaunay(rng.random((50, 2)))
    expected = dataclasses.astuple(quality(mesh))
    monkeypatch.setattr(sys.modules["meshlib.quality"], "AT_ONCE", 7)
    assert np.array_equal(dataclasses.astuple(quality(mesh)), expected)


def test_mean_max_and_table(square):
    q = quality(Mesh([[0, 0], [1, 0], [0.5, HEIGHT], [1.5, HEIGHT], [2, 0]], [[0, 1, 2], [1, 3, 2], [1, 4, 3]]))
    assert q.mean["maximum_angle"] == pytest.approx(60) == q.max["maximum_angle"]
    assert list(q.mean) == list(q.max) == ["maximum_angle", "skewness", "aspect_ratio"]
    assert str(quality(square)).splitlines() == [
        "Measure             mean       max",
        "Maximum angle    90.0000   90.0000",
        "Skewness          0.3491    0.3491",
        "Aspect ratio      0.8660    0.8660"]
    with pytest.raises(dataclasses.FrozenInstanceError):
        q.skewness = None
