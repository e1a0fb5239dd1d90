"""The mesh and all that is derived from its two arrays: facts that can be counted by hand."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from support import lattice

from meshlib import Mesh, MeshError, delaunay
from meshlib.mesh import topology

DERIVED = (
    "edges",
    "element_edges",
    "edge_elements",
    "neighbours",
    "boundary",
    "boundary_nodes",
    "corners",
    "areas",
)


def test_two_elements(square):
    assert square.counts == (4, 5, 2)
    assert square.edges.tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert square.element_edges.tolist() == [[3, 1, 0], [4, 2, 1]]  # opposite nodes 0,1,2; 0,2,3
    assert square.neighbours.tolist() == [[-1, 1, -1], [-1, -1, 0]]  # across 0-2, opposite 1 and 3
    assert square.edge_elements.tolist() == [[0, -1], [1, 0], [1, -1], [0, -1], [1, -1]]
    assert square.boundary.tolist() == [True, False, True, True, True]
    assert square.boundary_nodes.all()
    assert square.areas.tolist() == [0.5, 0.5]
    assert square.domain_area == 1.0


def test_dtypes_and_shapes(square):
    assert square.nodes.dtype == square.areas.dtype == np.float64
    for name in ("elements", "edges", "element_edges", "edge_elements", "neighbours"):
        assert getattr(square, name).dtype == np.int32, name
    assert square.boundary.dtype == square.boundary_nodes.dtype == bool
    assert square.corners.shape == (2, 3, 2)


def test_counts_of_every_start_mesh(start):
    n, e, t = start.counts
    nb = int(start.boundary_nodes.sum())
    assert t == 2 * (n - 1) - nb
    assert e == 3 * (n - 1) - nb
    assert n - e + t == 1  # Euler


def test_counts_with_a_hole(frame):
    """N = 16, all on the boundary: T = 2*15 - 16 + 2 = 16, E = 3*15 - 16 + 3 = 32."""
    frame.validate()
    assert frame.counts == (16, 32, 16)
    assert frame.boundary_nodes.sum() == 16
    assert frame.boundary.sum() == 12 + 4  # outside and around the hole
    assert frame.domain_area == 9 - 1


def test_counts_of_a_lattice():
    """8 x 8 cells: N = 81, T = 2*64, Nb = 32, E = 3*80 - 32 = 208."""
    mesh = delaunay(lattice(8, 8))
    assert mesh.counts == (81, 208, 128)
    assert mesh.boundary_nodes.sum() == mesh.boundary.sum() == 32


def test_edges_and_neighbours_agree_with_the_elements(start):
    for t in range(start.n_elements):
        for k in range(3):
            a, b = sorted(int(n) for n in np.delete(start.elements[t], k))
            e = start.element_edges[t, k]
            assert start.edges[e].tolist() == [a, b]
            s = start.neighbours[t, k]
            assert set(start.edge_elements[e]) == {t, s}
            assert start.boundary[e] == (s == -1)
            if s >= 0:
                assert {a, b} <= set(start.elements[s].tolist())


def test_edges_are_in_lexicographic_order_and_distinct(start):
    assert (start.edges[:, 0] < start.edges[:, 1]).all()
    keys = start.edges @ np.array([start.n_nodes, 1])
    assert (np.diff(keys) > 0).all()


def test_the_left_element_stands_first(start):
    inner = np.flatnonzero(~start.boundary)
    tail, head = start.nodes[start.edges[inner, 0]], start.nodes[start.edges[inner, 1]]
    centre = start.corners.mean(axis=1)
    for side, sign in zip(start.edge_elements[inner].T, (1, -1), strict=True):
        u, v = head - tail, centre[side] - tail
        assert (np.sign(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) == sign).all()


@pytest.mark.parametrize("pairs", [[[0, 2], [3, 2]], np.array([[2, 0], [2, 3]], dtype=np.uint8)])
def test_edge_numbers_in_either_order(square, pairs):
    assert square.edge_numbers(pairs).tolist() == [1, 4]


def test_edge_numbers_of_all_edges(start):
    assert np.array_equal(start.edge_numbers(start.edges[:, ::-1]), np.arange(start.n_edges))
    assert start.edge_numbers(np.empty((0, 2), dtype=int)).shape == (0,)


@pytest.mark.parametrize("pair", [(1, 3), (0, 0), (0, 6), (-1, 1), (2, 2**40)])
def test_edge_numbers_refuses_what_is_no_edge(square, pair):
    """(0, 6) would be (1, 2) if numbers were folded without a look: 0*4 + 6 = 1*4 + 2."""
    low, high = sorted(pair)
    with pytest.raises(MeshError) as error:
        square.edge_numbers([pair])
    assert str(error.value) == f"edge: nodes {low} and {high} are not joined by an edge"


@pytest.mark.parametrize(
    "pairs, message",
    [
        ([0, 1, 2], "shape: pairs have shape (3,); give an (m, 2) array of node numbers"),
        ([[0, 1, 2]], "shape: pairs have shape (1, 3); give an (m, 2) array of node numbers"),
        ([[0.0, 1.0]], "dtype: pairs have dtype float64; give whole numbers"),
        ([[0, 1], [2]], "shape: the rows of pairs differ in length; give a regular array"),
    ],
)
def test_edge_numbers_refuses_what_is_no_list_of_pairs(square, pairs, message):
    with pytest.raises(MeshError) as error:
        square.edge_numbers(pairs)
    assert str(error.value) == message


# -- frozen ---------------------------------------------------------------------------


def test_a_mesh_cannot_be_changed(square):
    with pytest.raises(dataclasses.FrozenInstanceError):
        square.nodes = np.zeros((4, 2))
    for name in ("nodes", "elements", "green", *DERIVED):
        with pytest.raises(ValueError, match="read-only"):
            getattr(square, name)[...] = 0


def test_a_mesh_keeps_copies():
    nodes = np.array([[0.0, 0], [1, 0], [0, 1]])
    elements = np.array([[0, 1, 2]], dtype=np.int32)
    mesh = Mesh(nodes, elements)
    nodes += 1
    elements += 1
    assert mesh.nodes[0].tolist() == [0.0, 0.0]
    assert mesh.elements.tolist() == [[0, 1, 2]]
    assert nodes.flags.writeable and elements.flags.writeable


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda m: pickle.loads(pickle.dumps(m))])
def test_a_copy_is_equal_and_frozen_too(square, copied):
    square.validate()
    other = copied(square)
    assert other.equals(square)
    assert not other.nodes.flags.writeable and not other.elements.flags.writeable


@pytest.mark.parametrize(
    "array",
    [
        lambda a: a.tolist(),
        lambda a: a.astype(np.float32),
        lambda a: a.astype(int),
        np.asfortranarray,
        lambda a: np.repeat(a, 2, axis=0)[::2],
        lambda a: np.hstack([a, a])[:, :2],
        lambda a: a[::-1][::-1],
        lambda a: a.astype(">f8"),
    ],
)
def test_any_array_like_is_taken(array):
    mesh = Mesh(array(lattice(1, 1)), np.array([[0, 1, 3], [0, 3, 2]], dtype=np.uint16)[:, ::1])
    assert mesh.validate().domain_area == 1.0
    assert mesh.nodes.flags.c_contiguous and mesh.nodes.dtype == np.float64


def test_equality_forgets_the_order_of_elements_but_not_the_nodes(square):
    assert square.equals(Mesh(square.nodes, [[2, 3, 0], [1, 2, 0]]))
    assert not square.equals(Mesh(square.nodes, [[0, 1, 3], [1, 2, 3]]))
    assert not square.equals(Mesh(square.nodes + 1, square.elements))
    assert not square.equals(Mesh(square.nodes[:3], square.elements[:1]))


def test_a_mesh_introduces_itself(square):
    assert repr(square) == "Mesh(4 nodes, 5 edges, 2 elements)"


# -- the arrays of section 4.4 -----------------------------------------------------------


def test_the_three_arrays(square):
    nodes, edges, elements = square.to_arrays()
    assert nodes.tolist() == [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    assert edges.tolist() == [[0, 1, 1], [0, 2, 0], [0, 3, 1], [1, 2, 1], [2, 3, 1]]
    assert elements.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert (nodes.dtype, edges.dtype, elements.dtype) == (np.float64, np.int32, np.int32)


def test_round_trip(start, rng):
    nodes, edges, elements = start.to_arrays()
    for again in (
        Mesh.from_arrays(nodes, edges, elements),
        Mesh.from_arrays(nodes, edges[rng.permutation(len(edges))], elements),
        Mesh.from_arrays(nodes, edges[:, [1, 0, 2]], elements),
        Mesh.from_arrays(nodes.tolist(), edges.tolist(), elements.tolist()),
    ):
        assert again.equals(start)
        for mine, theirs in zip(again.to_arrays(), (nodes, edges, elements), strict=True):
            assert np.array_equal(mine, theirs)


def test_round_trip_with_a_hole(frame):
    assert Mesh.from_arrays(*frame.to_arrays()).equals(frame)


def test_the_arrays_are_the_readers_own(square):
    for array in square.to_arrays():
        array[...] = 0
    assert square.to_arrays()[0][2].tolist() == [1, 1, 1]


def _changed(array, row, column, value):
    array = array.copy()
    array[row, column] = value
    return array


@pytest.mark.parametrize(
    "change, message",
    [
        (
            lambda n, e, t: (_changed(n, 2, 2, 0), e, t),
            "marker: node 2 is marked 0 but lies on the boundary; mark 1 on the boundary and 0 inside",
        ),
        (
            lambda n, e, t: (n, _changed(e, 1, 2, 1), t),
            "marker: edge 1 is marked 1 but lies inside; mark 1 on the boundary and 0 inside",
        ),
        (
            lambda n, e, t: (n, _changed(e, 1, 0, 1), t),
            "edge: nodes 1 and 2 are given twice, in rows 1 and 3; keep one of them",
        ),
        (
            lambda n, e, t: (n, e[:-1], t),
            "edge: nodes 2 and 3 are joined by an edge that is not given; add it",
        ),
        (
            lambda n, e, t: (n, _changed(e, 1, slice(0, 2), (1, 3)), t),
            "edge: nodes 1 and 3 are not joined by an edge",
        ),
        (
            lambda n, e, t: (n[:, :2], e, t),
            "shape: nodes have shape (4, 2); give three columns, the third the boundary marker",
        ),
        (
            lambda n, e, t: (n, e[:, :2], t),
            "shape: edges have shape (5, 2); give three columns, the third the boundary marker",
        ),
    ],
)
def test_wrong_arrays_are_refused(square, change, message):
    with pytest.raises(MeshError) as error:
        Mesh.from_arrays(*change(*square.to_arrays()))
    assert str(error.value) == message


def test_many_elements_are_ordered_as_few(rng, monkeypatch):
    """By their nodes from the smallest on, also where two elements share their first two nodes."""
    mesh = delaunay(rng.random((50, 2)))
    for elements in (
        rng.permutation(mesh.elements),
        np.vstack([mesh.elements, mesh.elements[:3]]),
        np.array([[0, 1, 3], [2, 0, 1], [0, 1, 2]]),
    ):
        few = topology.canonical(elements)
        assert few.tolist() == sorted(few.tolist())
        with monkeypatch.context() as patch:
            patch.setattr(topology, "MANY", 1)
            assert np.array_equal(topology.canonical(elements), few)
