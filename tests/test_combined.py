"""The combined strategy, patch by patch (Algorithm 7.5.1): it ends under two conditions, else it cycles."""

from unittest import mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import meshes

from meshlib import Interpolant, Mesh, MeshError, combined, criteria, delaunay, problems, refined, swapped
from meshlib.combination.combined import LEAST_GAIN, _objective, _Run
from meshlib.kernels import ANY, for_work
from meshlib.mesh.quality import angles

PLACES = {"edge": "jnd", "element": None, "node": "gradient-spread"}  # None: the L2 error
FUNCTIONS = {
    "cliff": lambda x, y: np.tanh(x - y),
    "bowl": lambda x, y: x * x + x * y + y * y,
    "kink": lambda x, y: abs(x - 0.4 * y - 1),
}


def ridge(x, y):
    return abs(x - y)


@pytest.fixture
def two_inside():
    """Two nodes inside a rectangle: the Delaunay mesh, on which the algorithm as written cycles."""
    return delaunay([[0, 0], [6, 0], [6, 3], [0, 3], [4, 1], [5, 2]])


@pytest.fixture
def small():
    """The corners of the square and ten nodes inside."""
    inside = np.random.default_rng(7).random((10, 2))
    return delaunay(np.concatenate([[[0, 0], [1, 0], [1, 1], [0, 1]], inside]))


def before_and_after(result):
    """The indicator of the mesh before and after each step."""
    after = result.history["indicator"]
    return np.append(result.indicator, after[:-1])[: len(after)], after


# -- as written it cycles -------------------------------------------------------------------------


def test_as_written_it_comes_back_to_where_it_was(two_inside):
    """The patch of node 4 gains 2.86 by a swap, that of node 5 gains 2.43 by swapping back."""
    result = combined(two_inside, ridge, "jnd", rim=False)
    assert result.period == 1 and result.mesh.equals(two_inside)
    assert result.history["node"].tolist() == [4, 5] and set(result.history["way"]) == {"swap"}
    assert result.history["gain"] == pytest.approx([2.86, 2.43])
    assert [result.indicator, *result.history["indicator"]] == pytest.approx([9.5, 7.68, 9.5])


def test_it_would_do_so_for_ever(two_inside):
    """Sweep after sweep from where the one before ended, whatever a step has to gain below a quarter."""
    mesh = two_inside
    for _ in range(3):
        result = combined(mesh, ridge, "jnd", rim=False, max_sweeps=1, min_relative_gain=0.25)
        mesh = result.mesh
        assert len(result.history) == 2 and mesh.equals(two_inside)


def test_the_gains_of_the_cycle_by_hand(two_inside):
    """JND of a ridge on x = y: the mesh swaps edge 3-4 for 0-5, inside the patch of 4, and back."""
    first = combined(two_inside, ridge, "jnd", rim=False, max_sweeps=1, min_relative_gain=0.26)
    assert len(first.history) == 1  # 2.43 / 9.5 = 0.256
    new = {tuple(e) for e in first.mesh.edges.tolist()} - {tuple(e) for e in two_inside.edges.tolist()}
    old = {tuple(e) for e in two_inside.edges.tolist()} - {tuple(e) for e in first.mesh.edges.tolist()}
    assert (old, new) == ({(3, 4)}, {(0, 5)})


@pytest.mark.parametrize("node", [4, 5])
def test_no_movement_would_break_the_cycle(node, two_inside):
    """At no point of a fine lattice does the node gain as much as by the swap."""
    objective = _objective(two_inside, ridge, "jnd", 2, False, None)
    first = combined(two_inside, ridge, "jnd", rim=False, max_sweeps=1, min_relative_gain=0.26).mesh
    mesh = two_inside if node == 4 else first
    patch = objective.patch(mesh.nodes, mesh.elements, ridge(*mesh.nodes.T), node)
    x, y = np.meshgrid(np.linspace(0, 6, 241), np.linspace(0, 3, 121))
    errors = patch.errors(np.column_stack([x.ravel(), y.ravel()]))
    assert np.isfinite(errors).sum() > 5000
    assert patch.error - errors.min() < patch.error - patch.swapped().error


def test_with_the_rim_the_same_mesh_is_left_for_good(two_inside):
    result = combined(two_inside, ridge, "jnd")
    assert result.period == 0 and result.sweeps == 2
    assert [result.indicator, *result.history["indicator"]] == pytest.approx([9.5, 7.68, 5.0])


# -- with the rim it ends -------------------------------------------------------------------------


@settings(max_examples=25)
@given(
    meshes(most=9, scales=(1.0,)),
    st.sampled_from(sorted(PLACES)),
    st.sampled_from((1, 2)),
    st.sampled_from(sorted(FUNCTIONS)),
    st.sampled_from((("swap", "move"), "swap", "move")),
)
def test_every_step_is_valid_and_lowers_the_indicator_by_the_gain_of_its_patch(mesh, place, norm, name, ways):
    u, take = FUNCTIONS[name], _Run._take

    def taken(run, patch):
        take(run, patch)
        assert Mesh(run.nodes, run.elements).validate().domain_area == pytest.approx(mesh.domain_area)
        assert np.allclose(run.values, u(*run.nodes.T))

    with mock.patch.object(_Run, "_take", taken):
        result = combined(mesh, u, PLACES[place], norm=norm, ways=ways, max_sweeps=3)
    before, after = before_and_after(result)
    assert np.allclose(before - after, result.history["gain"], rtol=1e-6, atol=1e-9 * result.indicator)
    assert (result.history["gain"] > LEAST_GAIN * result.indicator).all()
    assert result.period in (0, -1)
    ends = mesh.boundary_nodes
    assert np.array_equal(result.mesh.nodes[ends], mesh.nodes[ends])
    result.mesh.validate()


@settings(max_examples=25)
@given(
    meshes(most=9, scales=(1.0,)),
    st.sampled_from(("jnd", "abn", "gradient-spread")),
    st.sampled_from((0.3, 0.03, 0.003)),
)
def test_the_bound_on_steps_and_sweeps(mesh, criterion, least_gain):
    """n steps gain more than n least_gain J0, and J is never negative; each sweep but the last has a step."""
    result = combined(mesh, FUNCTIONS["kink"], criterion, min_relative_gain=least_gain)
    assert result.period == 0
    assert len(result.history) <= 1 / least_gain and result.sweeps <= 1 + len(result.history)
    if len(result.history):
        gained = result.indicator - result.history["indicator"][-1]
        assert len(result.history) * least_gain * result.indicator < gained * (1 + 1e-9)


@pytest.mark.parametrize("criterion", ["jnd", None])
def test_in_the_end_no_patch_gains_as_much(criterion, small):
    """The last sweep looked at every patch of the mesh that is returned."""
    mesh, u = small, problems.SR2
    result = combined(mesh, u, criterion, min_relative_gain=1e-2)
    objective = _objective(mesh, u, criterion, 2, True, None)
    for node in np.flatnonzero(~mesh.boundary_nodes):
        patch = objective.patch(result.mesh.nodes, result.mesh.elements, result.values, node)
        for changed in (patch.swapped(), patch.moved()):
            assert patch.error - changed.error <= 1e-2 * result.indicator


def test_a_smaller_least_gain_takes_more_steps(small):
    """Without one they need not end: they only grow in number."""
    steps = [
        len(combined(small, problems.SR2, min_relative_gain=g).history) for g in (1e-1, 1e-3, 1e-5, 1e-7)
    ]
    assert (np.diff(steps) > 0).all() and steps[-1] > 5 * steps[0]


def test_the_two_ways_alone(start):
    u, inside = problems.SR2, ~start.boundary_nodes
    only_swapped = combined(start, u, "jnd", ways="swap", max_sweeps=2)
    assert np.array_equal(only_swapped.mesh.nodes, start.nodes) and set(only_swapped.history["way"]) == {
        "swap"
    }
    if start is problems.mesh("33"):  # the others take longer
        only_moved = combined(start, u, "jnd", ways="move", max_sweeps=2)
        assert only_moved.mesh.edges.tolist() == start.edges.tolist()
        assert set(only_moved.history["way"]) == {"move"}
        assert (only_moved.mesh.nodes[inside] != start.nodes[inside]).any()


def test_swapping_patches_ends_where_swapping_edges_does():
    """No patch has an edge between two nodes of the boundary; of all others none is left to swap."""
    mesh, u = problems.mesh("81"), problems.SR3
    result = combined(mesh, u, "jnd", ways="swap", min_relative_gain=1e-16)
    left = swapped(result.mesh, u, "jnd").history
    first = left[left["accepted"]][:1]
    assert len(result.history) and mesh.boundary_nodes[[*first["a"], *first["b"]]].all()


def test_a_mesh_that_is_best_stays():
    """Of affine data every cost is 0."""
    mesh = problems.mesh("33")
    result = combined(mesh, lambda x, y: 1 + 2 * x - y)
    assert (len(result.history), result.sweeps, result.period) == (0, 1, 0) and result.mesh.equals(mesh)


def test_both_ways_beat_either_on_the_33_nodes():
    mesh, u = problems.mesh("33"), problems.SR2
    errors = {
        ways: Interpolant(r.mesh, r.values).l2_error(u, rule="exact")
        for ways in ("swap", "move", None)
        for r in [combined(mesh, u, ways=ways or ("swap", "move"))]
    }
    assert errors["swap"] > 2 * errors["move"] > 10 * errors[None]


# -- limits, green pairs, backends --------------------------------------------------------------------


@pytest.mark.parametrize("ways", ["swap", "move", ("swap", "move")])
def test_no_sharp_element_is_made(ways):
    mesh, u = problems.mesh("33"), problems.SR3
    assert np.degrees(angles(mesh.corners).min()) > 10
    result = combined(mesh, u, "abn", ways=ways, min_angle=10, max_sweeps=3)
    assert len(result.history)
    assert np.degrees(angles(result.mesh.corners).min()) >= 10 * (1 - 1e-9)


def test_green_pairs_that_are_left_alone_stay():
    """Only the lower left corner of the data is rough."""
    mesh, u = problems.mesh("33"), lambda x, y: np.maximum(0.3 - x - y, 0.0)
    fine = refined(mesh, problems.SR1, "abn", fraction=0.1).mesh
    result = combined(fine, u, "jnd", max_sweeps=2)
    assert len(result.history) and 0 < len(result.mesh.green) < len(fine.green)
    result.mesh.validate()


@pytest.mark.parametrize("criterion", ["jnd", None])
def test_compiled_and_plain_kernels_agree(criterion, small, monkeypatch):
    def run(backend):
        monkeypatch.setenv("MESHLIB_BACKEND", backend)
        return combined(small, problems.SR2, criterion, max_sweeps=2)

    first, second = map(run, ("auto" if for_work(ANY).is_compiled else "python", "python"))
    assert first.mesh.equals(second.mesh)
    assert first.history.tolist() == second.history.tolist()


def test_it_is_repeatable_and_changes_no_input(small):
    mesh = small
    nodes, elements = mesh.nodes.copy(), mesh.elements.copy()
    first, second = (combined(mesh, problems.DD1, "abn", max_sweeps=1) for _ in range(2))
    assert np.array_equal(mesh.nodes, nodes) and np.array_equal(mesh.elements, elements)
    assert first.history.tobytes() == second.history.tobytes() and first.mesh.equals(second.mesh)


def test_the_largest_number_of_sweeps(small):
    result = combined(small, problems.SR2, max_sweeps=1)
    assert (result.sweeps, result.period) == (1, -1)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (
            dict(function=np.zeros(33)),
            "type: u is a ndarray; give a function u(x, y), since nodes move to where there is no value",
        ),
        (dict(norm="max"), "unknown: norm 'max' is not known (known: 'L1', 'L2')"),
        (dict(ways="swop"), "unknown: way 'swop' is not known; did you mean 'swap'? (known: 'swap', 'move')"),
        (dict(ways=()), "unknown: no way to change a patch is given; name 'swap', 'move' or both"),
        (
            dict(min_relative_gain=0),
            "range: min_relative_gain is 0; give a share above 0 and below 1, "
            "since ever smaller gains need never end",
        ),
        (dict(max_sweeps=0), "range: max_sweeps is 0; give a whole number of at least 1"),
        (dict(min_angle=60), "range: min_angle is 60; give degrees from 0 to below 60"),
        (
            dict(criterion="jmd"),
            "unknown: criterion 'jmd' is not known; did you mean 'jnd'? (known: "
            + ", ".join(map(repr, criteria.names()))
            + ")",
        ),
    ],
)
def test_messages(arguments, message):
    with pytest.raises(MeshError) as error:
        combined(problems.mesh("33"), **{"function": problems.SR1, **arguments})
    assert str(error.value) == message
