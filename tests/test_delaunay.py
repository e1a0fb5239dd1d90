"""Delaunay meshes: the empty circle, the tie rule, and hard sets of nodes."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from strategies import lattice_nodes
from support import all_meshes, as_set, exact_circle, hull_area, is_delaunay, lattice, polygon, shuffled

from meshlib import Mesh, delaunay, problems
from meshlib.mesh.quality import angles


def fan(n):
    """The triangulation of a polygon 0, 1, .., n - 1 from its first node."""
    return frozenset((0, k, k + 1) for k in range(1, n - 1))


def coordinates(mesh):
    """Elements as sets of coordinates, whatever the numbers of the nodes."""
    return {frozenset(map(tuple, corners)) for corners in mesh.corners.tolist()}


def exact_area(mesh):
    corners = [[[Fraction(v) for v in p] for p in t] for t in mesh.corners.tolist()]
    return sum((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]) for a, b, c in corners) / 2


@settings(max_examples=150)
@given(lattice_nodes(most=20))
def test_no_circle_has_a_node_inside(nodes):
    mesh = delaunay(nodes).validate()
    assert is_delaunay(mesh)
    assert np.array_equal(mesh.nodes, nodes)


@settings(max_examples=100)
@given(lattice_nodes(most=20, scales=(1.0, 0.5, 2.0**-30, 2.0**20)))
def test_the_convex_hull_is_filled(nodes):
    """On a lattice of exact numbers the hull has no room for rounding."""
    assert exact_area(delaunay(nodes)) == hull_area(nodes)


@settings(max_examples=60)
@given(lattice_nodes(most=7, scales=(1.0,)))
def test_ties_go_to_the_smallest_node_number(nodes):
    """Found by brute force.

    Of all triangulations without a node inside a circle, ours is the one in which no tied
    diagonal could be changed for one from a smaller node.
    """
    mesh = delaunay(nodes)
    candidates = [m for m in all_meshes(mesh) if is_delaunay(m) and not _gives_way(m)]
    assert [as_set(m) for m in candidates] == [as_set(mesh)]


def _gives_way(mesh):
    for t, s in mesh.edge_elements[~mesh.boundary].tolist():
        first, second = mesh.elements[t].tolist(), mesh.elements[s].tolist()
        edge = set(first) & set(second)
        others = set(first) ^ set(second)
        tied = exact_circle(*mesh.nodes[first], mesh.nodes[(set(second) - edge).pop()]) == 0
        if tied and min(others) < min(edge):
            return True
    return False


@pytest.mark.parametrize(
    "points",
    [
        [
            [5, 0],
            [4, 3],
            [3, 4],
            [0, 5],
            [-3, 4],
            [-4, 3],
            [-5, 0],
            [-4, -3],
            [-3, -4],
            [0, -5],
            [3, -4],
            [4, -3],
        ],
        [[0, 0], [1, 0], [1, 1], [0, 1]],
        [[0, 0], [3, 0], [3, 1], [0, 1]],
    ],
)
def test_a_cocircular_polygon_is_a_fan_from_its_first_node(points):
    for shift in range(len(points)):
        nodes = np.roll(points, shift, axis=0)
        assert as_set(delaunay(nodes)) == fan(len(points))


def test_generic_nodes_give_the_same_mesh_in_any_order(rng):
    nodes = rng.random((60, 2))
    expected = coordinates(delaunay(nodes))
    for _ in range(5):
        assert coordinates(delaunay(rng.permutation(nodes))) == expected


def test_elements_are_in_canonical_order():
    mesh = delaunay(lattice(3, 3))
    assert (mesh.elements.argmin(axis=1) == 0).all()
    assert mesh.elements.tolist() == sorted(mesh.elements.tolist())


@pytest.mark.parametrize("shift, scale", [(0, 1e-9), (0, 1e9), (1e6, 1), (-1e6, 0.1), (1e9, 1)])
def test_shifts_and_scales_by_exact_numbers_change_nothing(shift, scale):
    nodes = lattice(4, 3)[[*range(7), *range(8, 20)]]  # one node missing: less regular
    exact = 2.0 ** round(np.log2(scale))
    assert np.array_equal(delaunay(nodes * exact + shift).elements, delaunay(nodes).elements)


@pytest.mark.parametrize("stretch", [1e-3, 1e-6, 1e-9, 1e6])
def test_flat_domains(stretch, rng):
    nodes = rng.random((40, 2)) * [1, stretch]
    mesh = delaunay(nodes).validate()
    assert is_delaunay(mesh)
    assert float(exact_area(mesh)) == pytest.approx(float(hull_area(nodes)), rel=1e-9)


@pytest.mark.parametrize("seed", [*range(20), 94, 101, 140, 165, 941, 1209])  # Qhull folds the last six
def test_turned_lattices_are_valid(seed):
    """Every line of the lattice is collinear but for rounding."""
    rng = np.random.default_rng(seed)
    turn = rng.uniform(0, np.pi)
    q = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    nodes = rng.permutation(lattice(3, 3) @ q * 0.1 + rng.random(2))[:10]
    mesh = delaunay(nodes).validate()
    assert is_delaunay(mesh)
    assert float(exact_area(mesh)) == pytest.approx(float(hull_area(nodes)), abs=1e-14)
    assert np.degrees(angles(mesh.corners)).min() > 1


def test_a_large_turned_lattice():
    """Straight sides, though no three nodes on them are collinear but for rounding."""
    q = np.array([[np.cos(1), np.sin(1)], [-np.sin(1), np.cos(1)]])
    mesh = delaunay(lattice(40, 40) @ q * 0.1 + 7).validate()
    assert mesh.counts == delaunay(lattice(40, 40)).counts
    assert np.degrees(angles(mesh.corners)).min() == pytest.approx(45)


@pytest.mark.parametrize(
    "convert", [list, np.float32, np.asfortranarray, lambda a: np.repeat(a, 2, axis=0)[::2]]
)
def test_any_array_like_is_taken(convert):
    nodes = np.array([[0, 0], [2, 0], [3, 2], [1, 3]], dtype=int)
    assert delaunay(convert(nodes)).equals(delaunay(nodes.astype(float)))


def test_the_input_is_not_changed(rng):
    nodes = rng.random((30, 2))
    before = nodes.copy()
    delaunay(nodes)
    assert np.array_equal(nodes, before)


def test_64_meshes_of_the_33_nodes_are_delaunay():
    """As decimals the nodes have six cocircular quadrilaterals, which share no element: 2^6.

    As binary numbers they have none, so that the stored mesh is Delaunay in decimals only.
    """
    stored = problems.mesh("33")
    decimals = Mesh(np.rint(20 * stored.nodes), stored.elements).validate()
    assert np.array_equal((decimals.nodes / 20).round(2), stored.nodes)
    assert is_delaunay(decimals)
    tied = [e for e in np.flatnonzero(~decimals.boundary) if _is_tied(decimals, e)]
    assert len(tied) == 6
    assert len(set(decimals.edge_elements[tied].ravel().tolist())) == 12


def _is_tied(mesh, e):
    first, second = (mesh.elements[t].tolist() for t in mesh.edge_elements[e])
    return exact_circle(*mesh.nodes[first], mesh.nodes[(set(second) - set(first)).pop()]) == 0


@pytest.mark.parametrize("nodes", [lattice(2, 2), polygon(7), lattice(5, 1)])
def test_delaunay_does_not_depend_on_where_flips_start(nodes, rng):
    """Flipping a shuffled mesh to Delaunay gives the mesh that Qhull starts from."""
    from meshlib.mesh.delaunay import _flipped_to_delaunay
    from meshlib.mesh.topology import canonical

    expected = delaunay(nodes).elements
    for _ in range(5):
        start = shuffled(delaunay(nodes), rng)
        assert np.array_equal(canonical(_flipped_to_delaunay(start.nodes, start.elements)), expected)
