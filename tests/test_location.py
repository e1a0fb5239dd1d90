"""Who contains a point: compiled search over strips against arrays, one by one, and against all elements."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import meshes, problems_of
from support import lattice

from meshlib import Interpolant, Mesh, delaunay
from meshlib.geometry import predicates
from meshlib.interpolation import locate_by_buckets, locate_by_strips
from meshlib.kernels import ANY, for_work


def slow(mesh, points):
    """Of all elements the deepest around each point, flat ones last, of several the first."""
    found = []
    flat = predicates.nearly_flat(mesh.corners)
    for p in points:
        depth = locate_by_buckets.barycentric(mesh.corners, p[None]).min(axis=1)
        depth[flat & (depth > -locate_by_buckets.INSIDE)] = -locate_by_buckets.INSIDE
        inside = depth >= -locate_by_buckets.INSIDE
        best = np.where(inside, depth, -np.inf).argmax()
        found.append(best if inside[best] else -1)
    return found


def points_around(mesh, seed, count=40):
    """Nodes, middles of edges, points on a lattice and anywhere in a box a little larger than the mesh."""
    rng = np.random.default_rng(seed)
    low, high = mesh.nodes.min(axis=0), mesh.nodes.max(axis=0)
    inside = low + (high - low) * rng.integers(0, 13, (count, 2)) / 12
    around = low + (high - low) * rng.uniform(-0.1, 1.1, (count, 2))
    return np.concatenate([mesh.nodes, mesh.nodes[mesh.edges].mean(axis=1), inside, around])


@settings(max_examples=100)
@given(meshes(scales=(1.0, 0.1, 1 / 3, 2.0**-30, 1e6)), st.integers(0, 999))
def test_all_ways_choose_the_same_element(mesh, seed):
    points = points_around(mesh, seed)
    box = ((points >= mesh.nodes.min(axis=0)) & (points <= mesh.nodes.max(axis=0))).all(axis=1)
    found = locate_by_strips.Strips(mesh, points, for_work(ANY)).elements()
    assert found.tolist() == locate_by_buckets.by_buckets(mesh, points).tolist()
    assert found[box].tolist() == slow(mesh, points[box])
    assert (found[~box] == -1).all()


@settings(max_examples=60)
@given(problems_of(most=20), st.integers(0, 999))
def test_values_in_strips_are_those_in_arrays(problem, seed):
    mesh, values = problem
    points = points_around(mesh, seed)
    found, expected = (
        locate_by_strips.Strips(mesh, points, for_work(ANY)).values(values),
        Interpolant(mesh, values)(*points.T),
    )
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    assert np.nanmax(np.abs(found - expected), initial=0) <= 1e-12 * (np.abs(values).max() or 1)


@settings(max_examples=60)
@given(meshes(scales=(1.0, 0.1, 1 / 3, 1e-200, 1e200)), st.floats(-1e-15, 1e-15))
def test_flat_is_what_the_predicate_says(mesh, lift):
    """The last node of each element moves to almost the middle of the others, and anywhere else."""
    nodes = mesh.nodes[mesh.elements].copy()
    nodes[::2, 2] = nodes[::2, :2].mean(axis=1) * (1 + lift)
    unit = float(np.abs(nodes).max())
    kernels = for_work(ANY)
    node = kernels.readable(nodes)
    found = [
        kernels.element_shapes.is_flat(node, (3 * t, 3 * t + 1, 3 * t + 2), unit) for t in range(len(nodes))
    ]
    assert found == predicates.nearly_flat(nodes).tolist()


@pytest.mark.parametrize("shift", [0, 1e3, 1e6])
def test_long_elements_between_two_diagonals(shift):
    """Every element meets all strips; on the way there is one point in each of 40."""
    step = np.arange(40.0)
    nodes = np.concatenate([np.column_stack([step, step]), np.column_stack([step + 50, step - 50])]) + shift
    mesh = delaunay(nodes)
    points = mesh.corners.mean(axis=1)
    assert locate_by_strips.Strips(mesh, points, for_work(ANY)).elements().tolist() == list(
        range(mesh.n_elements)
    )
    assert locate_by_buckets.by_buckets(mesh, points).tolist() == list(range(mesh.n_elements))


def test_many_slivers_share_few_cells():
    """2,000 long elements, whose bounding boxes touch a million cells of a fine grid."""
    line = np.repeat(np.arange(1001.0)[:, None], 2, axis=1)
    nodes = np.concatenate([line, line + np.array([2000, -2000])])
    elements = [t for n in range(1000) for t in ([n, n + 1001, n + 1], [n + 1, n + 1001, n + 1002])]
    mesh = Mesh._trusted(nodes, elements)
    buckets = locate_by_buckets._Buckets(mesh)
    assert len(buckets.elements) <= buckets.cells_per_element * mesh.n_elements


def test_crowded_points_have_narrow_strips(rng):
    points = rng.random((5000, 2)) ** 4
    sorted_in = locate_by_strips.Strips(delaunay([[0, 0], [1, 0], [1, 1], [0, 1]]), points, for_work(ANY))
    widths = np.diff(sorted_in.edge[:-1])
    assert sorted_in.size == 100 and len(widths) == 49 and widths[0] < 1e-3 < 0.05 < widths[-1]
    assert np.array_equal(np.sort(sorted_in.order), np.arange(5000))
    inside = np.diff(sorted_in.y.reshape(50, 100), axis=1)
    assert (inside >= 0).all()


def test_no_points_and_points_that_are_none(frame):
    assert locate_by_strips.Strips(frame, np.empty((0, 2)), for_work(ANY)).elements().tolist() == []
    none = np.array([[np.nan, 1], [np.inf, 0], [1.5, 1.5], [9, 9], [0.5, 0.25]])
    assert locate_by_strips.Strips(frame, none, for_work(ANY)).elements().tolist()[:4] == [-1] * 4
    assert np.isnan(locate_by_strips.Strips(frame, none, for_work(ANY)).values(np.ones(16))).tolist() == [
        True
    ] * 4 + [False]


def test_many_points_on_a_lattice_of_many_elements():
    """A point in the middle of a cell lies on its diagonal: the first of the two elements has it."""
    mesh = delaunay(lattice(120, 120))
    points = lattice(119, 119) + 0.5
    found = locate_by_buckets.located(mesh, points)
    depth = locate_by_buckets.barycentric(mesh.corners[found], points).min(axis=1)
    assert np.array_equal(depth, np.zeros(len(points)))
    assert np.array_equal(found, locate_by_buckets.by_buckets(mesh, points))
