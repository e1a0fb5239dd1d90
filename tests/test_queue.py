"""The schedule of a queue: certified local optima, the same by both procedures."""

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import meshes, problems_of
from support import as_set, is_delaunay, shuffled

from meshlib import MeshError, delaunay, problems, swapped
from meshlib.kernels import for_work
from meshlib.mesh.topology import MANY, canonical, edge_table, half_edges
from meshlib.swapping.along_curve import along_curve

NAMES = ("jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle")


def tries(trace):
    """What was tried, each edge seen from its smaller node."""
    return [
        (r["edge"], *min((r["a"], r["b"], r["c"], r["d"]), (r["b"], r["a"], r["d"], r["c"])), r["accepted"])
        for r in trace
    ]


@settings(max_examples=120)
@given(
    problems_of(scales=(1.0, 2.0**-20)),
    st.sampled_from(NAMES),
    st.sampled_from((1, 2, "max")),
    st.sampled_from(({}, {"min_angle": 10}, {"min_area": 0.01})),
    st.one_of(st.none(), st.integers(0, 99)),
)
def test_both_procedures_agree_and_end_in_a_local_optimum(problem, name, norm, limits, seed):
    mesh, values = problem
    order = None if seed is None else np.random.default_rng(seed).permutation(mesh.n_edges)
    ours = swapped(mesh, values, name, norm=norm, order=order, schedule="queue", **limits)
    theirs = reference.result(mesh, values, name, norm=norm, order=order, schedule="queue", **limits)
    assert np.array_equal(canonical(ours.mesh.validate().elements), theirs.elements)
    assert (ours.swaps, ours.sweeps, ours.tried) == (theirs.swaps, 0, theirs.tried)
    assert tries(ours.history) == tries(theirs.trace)
    assert swapped(ours.mesh, values, name, norm=norm, **limits).swaps == 0


@pytest.mark.parametrize("name", ["jnd", "abn"])
@pytest.mark.parametrize("norm", [1, 2])
def test_the_cost_falls_and_no_edge_is_left_to_swap(name, norm):
    rng = np.random.default_rng(4)
    mesh, u = delaunay(rng.random((2000, 2))), problems.functions["franke"]
    found = swapped(mesh, u, name, norm=norm, schedule="queue")
    assert found.cost_after < found.cost_before and found.swaps > 500
    assert swapped(found.mesh.validate(), u, name, norm=norm).swaps == 0


def test_the_trace_of_a_queue_can_be_replayed():
    mesh, u = problems.mesh("33"), problems.functions["SR2"]
    found = swapped(mesh, u, "abn", norm=1, schedule="queue")
    elements = as_set(mesh)
    for row in found.history[found.history["accepted"]]:
        a, b, c, d = (int(row[k]) for k in "abcd")
        old, new = (
            {tuple(sorted(t)) for t in pair} for pair in (((a, b, c), (a, b, d)), ((c, d, a), (c, d, b)))
        )
        assert old <= elements
        elements = (elements - old) | new
    assert elements == as_set(found.mesh)
    first = found.history[0]
    assert mesh.edges[first["edge"]].tolist() == sorted((first["a"], first["b"]))


def test_max_min_angles_by_a_queue_give_delaunay(rng):
    start = shuffled(delaunay(rng.random((60, 2))), rng)
    assert not is_delaunay(start)
    assert is_delaunay(
        swapped(start, np.zeros(60), "smallest-angle", norm="lexicographic", schedule="queue").mesh
    )


def test_an_unknown_schedule_is_named(square):
    with pytest.raises(MeshError) as error:
        swapped(square, [0, 0, 1, 0], schedule="stack")
    assert str(error.value) == "unknown: schedule 'stack' is not known (known: 'sweep', 'queue')"


# -- numbering -----------------------------------------------------------------------------


@given(meshes())
def test_renumbering_can_be_taken_back(mesh):
    found = along_curve(mesh)
    assert found.mesh.validate().counts == mesh.counts
    assert np.array_equal(found.restored(found.mesh.elements), mesh.elements)
    assert np.array_equal(found.mesh.nodes, mesh.nodes[found.nodes])


def test_neighbours_in_the_plane_are_near_in_memory(rng):
    mesh = delaunay(rng.random((4000, 2)))
    before, after = (np.median(np.abs(np.diff(m.edges, axis=1))) for m in (mesh, along_curve(mesh).mesh))
    assert after < before / 20


def test_the_curve_goes_through_the_quarters_of_a_square_in_turn():
    """Four by four nodes, one in each of as many cells: places by hand, rows from below."""
    x, y = np.meshgrid(np.arange(4.0), np.arange(4.0))
    mesh = delaunay(np.column_stack([x.ravel(), y.ravel()]))
    places = along_curve(mesh).nodes.argsort().reshape(4, 4)
    assert places.tolist() == [[0, 1, 4, 5], [2, 3, 6, 7], [8, 9, 12, 13], [10, 11, 14, 15]]


@pytest.mark.parametrize("hole", [False, True])
def test_edges_by_counting_are_those_by_sorting(hole, rng, monkeypatch):
    mesh = delaunay(rng.random((MANY // 2 + 200, 2)))
    elements = mesh.elements[mesh.nodes[mesh.elements].mean(axis=1)[:, 0] > 0.01] if hole else mesh.elements
    assert len(elements) >= MANY
    monkeypatch.setattr("meshlib.mesh.topology.compiled_for_work", for_work)
    counted = edge_table(elements, mesh.n_nodes)
    monkeypatch.setattr("meshlib.mesh.topology.MANY", np.inf)
    for ours, theirs in zip(counted, edge_table(elements, mesh.n_nodes), strict=True):
        assert np.array_equal(ours, theirs) and ours.dtype == theirs.dtype


def test_half_edges_by_hand(square):
    """Elements (0, 1, 2), (0, 2, 3): their common side is opposite node 1 in one, node 3 in the other."""
    twin, slot, half = (np.asarray(v) for v in half_edges(square.element_edges, square.n_edges, for_work(0)))
    assert twin.tolist() == [-1, 5, -1, -1, -1, 1]
    assert square.edges[slot].tolist() == [[1, 2], [0, 2], [0, 1], [2, 3], [0, 3], [0, 2]]
    assert slot[half].tolist() == list(range(5))
