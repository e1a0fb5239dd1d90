"""Maximum angle, skewness and aspect ratio: hand-made elements and identities."""

import dataclasses
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import meshes
from support import lattice

from meshlib import (
    Mesh,
    MeshError,
    delaunay,
    problems,
    quality,
    refined,
    smoothed,
    swapped,
    uniformity,
    valence,
)
from meshlib.mesh.quality import MEASURES, angles

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
    """Angles 30, 60, 90: skewness (30 + 0 + 30)/3 = 20 degrees; AR 4 sqrt(3) (sqrt(3)/8)/(1 + 1/4 + 3/4)."""
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
@given(meshes(scales=(1.0, 2.0**-30, 1e6)))  # no element is flat but for rounding
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
    monkeypatch.setattr(sys.modules["meshlib.mesh.quality"], "AT_ONCE", 7)
    assert np.array_equal(dataclasses.astuple(quality(mesh)), expected)


def test_mean_max_and_table(square):
    q = quality(
        Mesh([[0, 0], [1, 0], [0.5, HEIGHT], [1.5, HEIGHT], [2, 0]], [[0, 1, 2], [1, 3, 2], [1, 4, 3]])
    )
    assert q.mean["maximum_angle"] == pytest.approx(60) == q.max["maximum_angle"]
    assert q.min["minimum_angle"] == pytest.approx(60) and q.worst["aspect_ratio"] == pytest.approx(1)
    assert q.max["longest_edge"] == pytest.approx(1) == q.min["shortest_edge"]
    assert list(q.mean) == list(q.max) == list(q.min) == list(q.worst) == list(MEASURES)
    assert str(quality(square)).splitlines() == [
        "Measure              mean      worst",
        "Minimum angle          45         45",
        "Maximum angle          90         90",
        "Skewness           0.3491     0.3491",
        "Aspect ratio        0.866      0.866",
        "Shortest edge           1          1",
        "Longest edge        1.414      1.414",
    ]
    with pytest.raises(dataclasses.FrozenInstanceError):
        q.skewness = None


# -- uniformity and valence (section 7.2) ---------------------------------------------------------


def test_uniformity_by_hand():
    """Areas 1/2, 1 and 4 in a row: ratios 2, max(2, 4), 4."""
    mesh = Mesh([[0, 0], [1, 0], [1, 1], [3, 1], [3, 5]], [[0, 1, 2], [1, 3, 2], [2, 3, 4]])
    assert mesh.areas == pytest.approx([1 / 2, 1, 4])
    assert uniformity(mesh) == pytest.approx([2, 4, 4])


def test_an_element_without_neighbours_is_uniform():
    assert uniformity(Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])).tolist() == [1.0]


@settings(max_examples=60)
@given(meshes(scales=(1.0, 2.0**-30, 1e6)))
def test_uniformity_is_that_of_the_worst_neighbour(mesh):
    """The formula of the thesis, element by element; of two neighbours neither is below their ratio."""
    found, areas = uniformity(mesh), mesh.areas
    for t, around in enumerate(mesh.neighbours):
        ratios = [max(areas[t] / areas[s], areas[s] / areas[t]) for s in around if s >= 0]
        assert found[t] == pytest.approx(max(ratios, default=1.0))
    assert (found >= 1).all()


def test_affine_images_are_as_uniform(rng):
    """Areas all change by the same factor."""
    mesh = delaunay(rng.random((30, 2)))
    image = Mesh(mesh.nodes @ [[3, 1], [0, 0.5]] + 7, mesh.elements)
    assert uniformity(image) == pytest.approx(uniformity(mesh))


def test_centroids_split_into_equal_parts():
    """On equal elements: all are split, and all parts are a third."""
    mesh = delaunay(lattice(3, 3))
    assert uniformity(mesh) == pytest.approx(np.ones(18))
    new = refined(mesh, np.zeros(16), fraction=1, split="centroid").mesh
    assert uniformity(new) == pytest.approx(np.ones(54))


def test_the_longest_edge_halves():
    """Of equal right angled elements one pair is bisected at a time: ratios 1 and 2."""
    mesh = delaunay(lattice(6, 6))
    new = refined(mesh, lambda x, y: x**2, "abn", fraction=0.1, split="longest-edge").mesh
    assert sorted(set(uniformity(new).round(9))) == [1.0, 2.0]


def test_valence_by_hand(square):
    """A fan of six around a node: 6 in the middle, 2 at the rim."""
    turn = np.arange(6) * np.pi / 3
    fan = Mesh(
        [(0, 0), *np.column_stack([np.cos(turn), np.sin(turn)])],
        [(0, k + 1, (k + 1) % 6 + 1) for k in range(6)],
    )
    assert valence(fan).tolist() == [6, 2, 2, 2, 2, 2, 2]
    assert valence(square).tolist() == [2, 1, 2, 1]


@settings(max_examples=60)
@given(meshes())
def test_the_mean_valence_follows_from_euler(mesh):
    """The sum is 3 T = 6 (N - 1) - 3 Nb: no swap changes it, and the mean is below 6."""
    found, nb = valence(mesh), int(mesh.boundary_nodes.sum())
    assert found.sum() == 3 * mesh.n_elements == 6 * (mesh.n_nodes - 1) - 3 * nb
    assert found.mean() < 6 and found.min() >= 1
    assert (found[~mesh.boundary_nodes] >= 3).all()
    edges = np.bincount(mesh.edges.ravel(), minlength=mesh.n_nodes)
    assert np.array_equal(edges - found, mesh.boundary_nodes)  # one more edge than elements on the boundary


def test_swaps_change_four_valences_and_moves_none(start):
    u = problems.functions["SR2"]
    done = swapped(start, u)
    change = valence(done.mesh) - valence(start)
    assert change.sum() == 0 and np.abs(change).sum() <= 4 * done.swaps
    assert np.array_equal(valence(smoothed(start).mesh), valence(start))


def test_centroids_double_the_valence():
    """Each corner of a split element gets one element more: all interior ones get twice as many."""
    mesh = problems.mesh("33")
    new = refined(mesh, problems.SR1, fraction=1, split="centroid").mesh
    assert np.array_equal(valence(new), [*2 * valence(mesh), *np.full(mesh.n_elements, 3)])


@pytest.mark.parametrize("measure", [uniformity, valence])
def test_the_mesh_must_be_valid(measure):
    with pytest.raises(MeshError) as error:
        measure([[0, 1, 2]])
    assert (
        str(error.value)
        == "type: a mesh is needed, this is a list; make a meshlib.Mesh or use meshlib.delaunay"
    )
    with pytest.raises(MeshError) as error:
        measure(Mesh([[0, 0], [1, 0], [0, 1]], [[0, 2, 1]]))
    assert str(error.value) == "orientation: element 0 with nodes (0, 2, 1) is clockwise; reverse its nodes"
