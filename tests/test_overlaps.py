"""Overlapping elements and hanging nodes: the search along the boundary against all pairs."""

import numpy as np
import pytest
from hypothesis import assume, given, reject, settings
from hypothesis import strategies as st
from strategies import WIDTH, lattice_nodes
from support import lattice

from meshlib import Mesh, MeshError, delaunay
from meshlib.geometry.predicates import orientation
from meshlib.mesh import box_tree, overlaps, validation
from meshlib.mesh.topology import HEADS, TAILS

CELLS = st.tuples(st.integers(0, 2 * WIDTH), st.integers(0, 2 * WIDTH))


def overlapping(mesh):
    """(T, T) bool: whether no side of one of two elements has the other to its right."""
    tails, heads = mesh.corners[:, TAILS], mesh.corners[:, HEADS]
    turns = orientation(tails[:, None, :, None], heads[:, None, :, None], mesh.corners[:, None])
    apart = (turns <= 0).all(axis=3).any(axis=2)
    return ~(apart | apart.T) & ~np.eye(mesh.n_elements, dtype=bool)


def first_overlap(mesh):
    """From left to right the first element that overlaps a later one, and the first such one."""
    order = np.argsort(mesh.corners[..., 0].min(axis=1), kind="stable")
    found = np.argwhere(np.triu(overlapping(mesh)[np.ix_(order, order)]))
    return tuple(sorted(order[found[0]].tolist())) if len(found) else None


def first_hanging(mesh):
    """From left to right the first node inside the first edge with such a node, and the edge's element."""
    nodes = np.flatnonzero(mesh.boundary_nodes)
    nodes = nodes[np.argsort(mesh.nodes[nodes, 0], kind="stable")]
    for e in np.flatnonzero(mesh.boundary):
        (a, b), p = mesh.nodes[mesh.edges[e]], mesh.nodes[nodes]
        box = ((np.minimum(a, b) <= p) & (p <= np.maximum(a, b))).all(axis=1)
        inside = nodes[box & (orientation(a, b, p) == 0) & ~np.isin(nodes, mesh.edges[e])]
        if inside.size:
            return int(inside[0]), int(mesh.edge_elements[e, 0])
    return None


def by_all_pairs(mesh):
    """Clause and items of what is wrong, or None."""
    pair, hanging = first_overlap(mesh), first_hanging(mesh)
    return ("overlap", pair) if pair else ("hanging node", hanging) if hanging else None


def verdict(mesh):
    """Clause and items of what `validate` says is wrong, or None."""
    try:
        mesh.validate()
    except MeshError as error:
        _area_is_true(mesh, error)
        return error.clause, error.items
    return None


def _area_is_true(mesh, error):
    if error.clause == "overlap" and "same side" not in str(error):
        area = validation.common_area(*mesh.corners[list(error.items)])
        assert f"overlap by an area of {area:.6g};" in str(error)


def assert_agreement(mesh):
    """That both say the same, for a mesh in which what is checked before is right."""
    try:
        _ = mesh.edge_elements  # no two elements on the same side of an edge
    except MeshError:
        reject()
    found = verdict(mesh)
    assume(found is None or found[0] in ("overlap", "hanging node"))
    assert found == by_all_pairs(mesh)


def cleaned(nodes, elements):
    """A mesh of those elements that are counter-clockwise, and of the nodes they use."""
    elements = np.reshape(elements, (-1, 3)).astype(int)
    elements = elements[orientation(*nodes[elements.T]) > 0]
    assume(len(elements))
    used, numbers = np.unique(elements, return_inverse=True)
    return Mesh(nodes[used], numbers.reshape(-1, 3))


def united(first, second, shift=(0, 0)):
    """Both meshes, the second moved, as one."""
    return Mesh(
        np.vstack([first.nodes, second.nodes + shift]),
        np.vstack([first.elements, second.elements + first.n_nodes]),
    )


@settings(max_examples=120)
@given(lattice_nodes(scales=(1.0, 0.1)), st.data())
def test_moved_nodes(nodes, data):
    """One to three nodes jump; elements that turn over are left out."""
    mesh = delaunay(nodes)
    nodes = mesh.nodes.copy()
    for n in data.draw(st.sets(st.integers(0, mesh.n_nodes - 1), min_size=1, max_size=3)):
        nodes[n] = np.array(data.draw(CELLS)) * np.abs(nodes).max() / (2 * WIDTH)
    moved = cleaned(nodes, mesh.elements)
    assert_agreement(moved)


@settings(max_examples=120)
@given(lattice_nodes(scales=(1.0,)), lattice_nodes(most=8, scales=(0.5, 1.0)), CELLS)
def test_two_components(first, second, shift):
    """Apart, one in the other, across each other, or touching along edges or in nodes."""
    both = united(delaunay(first), delaunay(second), np.array(shift) / 2 + 0.25 * (shift[0] % 2))
    assert_agreement(both)


@settings(max_examples=120)
@given(lattice_nodes(scales=(1.0,)), st.data())
def test_elements_left_out_and_added(nodes, data):
    """Holes, pinched nodes, and elements across others."""
    mesh = delaunay(nodes)
    kept = data.draw(st.lists(st.sampled_from(range(mesh.n_elements)), unique=True))
    node = st.integers(0, mesh.n_nodes - 1)
    added = data.draw(st.lists(st.tuples(node, node, node), max_size=2))
    changed = cleaned(mesh.nodes, [*mesh.elements[kept].tolist(), *added])
    assert_agreement(changed)


@settings(max_examples=60)
@given(st.lists(st.tuples(CELLS, CELLS, CELLS), min_size=2, max_size=6))
def test_lone_triangles(triangles):
    """Elements that share no nodes: every side is on the boundary."""
    corners = np.array(triangles, dtype=float)
    corners += np.arange(len(corners))[:, None, None] * [2.0**-20, 2.0**-21]  # else many nodes coincide
    mesh = cleaned(corners.reshape(-1, 2), np.arange(3 * len(corners)))
    assert_agreement(mesh)


def ring(turns, n=7):
    """Points on rays that go round the origin so many times, further and further out."""
    angle = np.linspace(0, 2 * np.pi * turns, n * turns, endpoint=False)
    return np.column_stack([np.cos(angle), np.sin(angle)]) * (1 + np.arange(n * turns) / n)[:, None]


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_a_fan_may_turn_around_its_node_once(turns):
    """Turning twice it covers its node twice, though each edge has an element on either side."""
    nodes = np.vstack([[[0, 0]], ring(turns)])
    n = len(nodes) - 1
    mesh = Mesh(nodes, [(0, 1 + k, 1 + (k + 1) % n) for k in range(n)])
    assert not mesh.boundary_nodes[0]
    found = verdict(mesh)
    assert found == by_all_pairs(mesh) and (found is None) == (turns == 1)


@pytest.mark.parametrize("turns", [1, 2])
def test_a_band_may_go_around_a_hole_once(turns):
    """A closed band of quadrilaterals, cut in two, with a hole where the fan has its node."""
    outer = ring(turns)
    n = len(outer)
    quads = [(k, (k + 1) % n, n + k, n + (k + 1) % n) for k in range(n)]
    mesh = Mesh(np.vstack([outer, outer / 2]), [t for a, b, c, d in quads for t in ((a, b, c), (b, d, c))])
    found = verdict(mesh)
    assert found == by_all_pairs(mesh) and (found is None) == (turns == 1)


def test_a_mesh_in_a_hole_is_none_of_the_mesh_around_it(frame):
    """In the hole, touching its sides with nodes, and across them."""
    inner = delaunay([[0.0, 0.5], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0]])
    for size, shift, expected in ((0.5, 1.25, None), (1, 1, "hanging node"), (1.25, 1, "overlap")):
        mesh = united(frame, Mesh(inner.nodes * size, inner.elements), (shift, shift))
        found = verdict(mesh)
        assert found == by_all_pairs(mesh) and (found and found[0]) == expected


@pytest.mark.parametrize("few, most", [(1, 1), (3, 7), (1000, 2_000_000)])
def test_batches_of_any_size_give_the_same(few, most, monkeypatch):
    mesh = delaunay(lattice(7, 7))
    small = Mesh([[0.1, 0.1], [0.3, 0.1], [0.2, 0.3]], [[0, 1, 2]])
    hanging = Mesh([[2, -1], [4, -1], [3.5, 0]], [[0, 1, 2]])
    broken = [united(mesh, extra, shift) for extra in (small, hanging) for shift in ((0, 0), (3, 0))]
    expected = [verdict(wrong) for wrong in broken]
    monkeypatch.setattr(box_tree.BoxTree, "few_rows", few)
    monkeypatch.setattr(box_tree.BoxTree, "pairs_at_once", most)
    mesh.validate()
    assert expected == [verdict(wrong) for wrong in broken]
    assert {clause for clause, _ in expected} == {"overlap", "hanging node"}


@pytest.mark.parametrize("scale", [1e-310, 1e-150, 1e70, 4e307])
def test_any_unit_of_length_will_do(scale, square):
    Mesh(square.nodes * scale, square.elements).validate()
    if scale < 1e100:  # an area that is no number cannot be named
        shifted = united(square, square, (0.5, 0.25))
        assert verdict(shifted) == verdict(Mesh(shifted.nodes * scale, shifted.elements))


@given(
    st.lists(st.tuples(CELLS, CELLS), min_size=1, max_size=60),
    st.lists(st.tuples(CELLS, CELLS), min_size=1, max_size=60),
)
def test_boxes_that_touch(first, second):
    """In each axis neither ends before the other begins."""
    (low, high), others = (box_tree.bounds(*np.swapaxes(s, 0, 1).astype(float)) for s in (first, second))
    batches = box_tree.BoxTree(*others).touching(low, high)
    found = [pair for i, j in batches for pair in zip(i.tolist(), j.tolist(), strict=True)]
    expected = np.argwhere((low[:, None] <= others[1]).all(axis=2) & (others[0] <= high[:, None]).all(axis=2))
    assert sorted(found) == list(map(tuple, expected.tolist()))


@pytest.mark.parametrize(
    "nodes, elements",
    [
        (lattice(40, 40), None),  # few on the boundary
        (
            np.column_stack([np.cos(np.arange(800) / 128), np.sin(np.arange(800) / 128)]),  # long slivers
            [(0, k, k + 1) for k in range(1, 799)],
        ),
    ],
)
def test_work_is_in_proportion_to_the_number_of_elements(nodes, elements):
    """Of half a million pairs some thousands are looked at."""
    mesh = delaunay(nodes) if elements is None else Mesh(nodes, elements)
    all_, edges = overlaps._Elements(mesh.corners), mesh.nodes[mesh.edges[mesh.boundary].T]
    near = all_.near(np.arange(mesh.n_elements), box_tree.BoxTree(*box_tree.bounds(*edges)))
    assert sum(len(t) for t, _ in near) < 8 * mesh.n_elements
