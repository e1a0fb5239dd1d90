"""The local optimisation procedure: termination, limits, and its classical theorems."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import as_set, is_delaunay, lattice, shuffled

from meshlib import Mesh, criteria, delaunay, problems, swapped
from meshlib.criteria.norms import NORMS, measure
from meshlib.mesh.quality import angles

COSTS = st.sampled_from(criteria.names())
TRACED = ("jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle")


@pytest.mark.parametrize("name", criteria.names())
@pytest.mark.parametrize("norm", NORMS)
def test_every_swap_lowers_its_local_cost_and_the_sum_falls(name, norm):
    mesh, u = shuffled(problems.mesh("33"), np.random.default_rng(1), unit=1 / 40), problems.functions["SR2"]
    result = swapped(mesh, u, name, norm=norm)
    trace = result.history
    accepted = trace[trace["accepted"]]
    assert len(accepted) == result.swaps > 0 and len(trace) == result.tried
    assert (
        trace["sweep"].max() == result.sweeps and not trace["accepted"][trace["sweep"] == result.sweeps].any()
    )
    if norm != "lexicographic":
        assert (accepted["new"] < accepted["old"]).all()
    assert result.cost_after <= result.cost_before
    if norm in (1, 2):
        assert result.cost_after < result.cost_before


@pytest.mark.parametrize("name", TRACED)
@pytest.mark.parametrize("norm", [1, 2])
def test_the_local_gains_add_up_to_the_fall_of_the_sum(name, norm):
    """A swap changes five edges (two elements) and nothing else."""
    mesh, u = problems.mesh("33"), problems.functions["SR1"]
    result = swapped(mesh, u, name, norm=norm)
    accepted = result.history[result.history["accepted"]]
    before, after = (measure(criteria.costs(m, u, name), norm) for m in (mesh, result.mesh))
    assert before - after == pytest.approx((accepted["old"] - accepted["new"]).sum(), rel=1e-9)


@pytest.mark.parametrize("name", TRACED)
@pytest.mark.parametrize("norm", [1, 2])
def test_replaying_the_trace_lowers_the_global_cost_at_every_swap(name, norm):
    mesh, u = problems.mesh("33"), problems.functions["SR3"]
    trace = swapped(mesh, u, name, norm=norm).history
    last, elements = measure(criteria.costs(mesh, u, name), norm), as_set(mesh)
    for row in trace[trace["accepted"]]:
        a, b, c, d = (int(row[k]) for k in "abcd")
        old, new = (
            {tuple(sorted(t)) for t in pair} for pair in (((a, b, c), (a, b, d)), ((c, d, a), (c, d, b)))
        )
        assert old <= elements
        elements = (elements - old) | new
        now = measure(criteria.costs(_mesh(mesh.nodes, elements), u, name), norm)
        assert now < last
        last = now
    assert elements == as_set(swapped(mesh, u, name, norm=norm).mesh)


def _mesh(nodes, elements):
    rows = np.array(sorted(elements))
    clockwise = Mesh(nodes, rows).areas < 0
    rows[clockwise] = rows[clockwise][:, ::-1]
    return Mesh(nodes, rows).validate()


@pytest.mark.parametrize(
    "problem, name",
    [(p, n) for p in ("33", "81") for n in criteria.names() if (p, n) != ("81", "gradient-spread")],
)  # slow
@pytest.mark.parametrize("norm", NORMS)
def test_the_result_is_locally_optimal(name, norm, problem):
    u = problems.functions["SR3"]
    once = swapped(problems.mesh(problem), u, name, norm=norm)
    again = swapped(once.mesh, u, name, norm=norm)
    assert (again.swaps, again.sweeps) == (0, 1)
    assert again.mesh is once.mesh
    assert again.cost_after == again.cost_before == pytest.approx(once.cost_after)


@pytest.mark.parametrize("name", ["jnd", "abn", "dlp", "dfp", "gradient-spread"])
@pytest.mark.parametrize("norm", NORMS)
def test_affine_data_move_nothing(name, norm, rng):
    for mesh in (problems.mesh("33"), problems.mesh("81"), shuffled(delaunay(lattice(4, 3) * 0.1), rng)):
        for scale in (1.0, 1e-6, 1e6):
            x, y = mesh.nodes.T
            result = swapped(mesh, scale * (3 - 2 * x + 5 * y), name, norm=norm)
            assert result.swaps == 0 and result.mesh is mesh


@settings(max_examples=60)
@given(problems_of(most=12), COSTS, st.sampled_from(NORMS), st.integers(0, 99))
def test_valid_unchanged_and_optimal(problem, name, norm, seed):
    mesh, values = problem
    before = mesh.nodes.copy(), mesh.elements.copy(), values.copy()
    order = np.random.default_rng(seed).permutation(mesh.n_edges)
    result = swapped(mesh, values, name, norm=norm, order=order)
    result.mesh.validate()
    assert result.mesh.counts == mesh.counts
    assert np.array_equal(result.mesh.boundary_nodes, mesh.boundary_nodes)
    for array, copy in zip((mesh.nodes, mesh.elements, values), before, strict=True):
        assert np.array_equal(array, copy)
    assert result.cost_after <= result.cost_before * (1 + 1e-12)


# -- limits (section 6.1) -----------------------------------------------------------------


@pytest.mark.parametrize("name, norm", [("jnd", 2), ("jnd", "lexicographic"), ("gradient-spread", 1)])
@pytest.mark.parametrize("limit", [5, 20, 40])
def test_no_swap_creates_an_angle_below_the_limit(name, norm, limit):
    mesh, u = problems.mesh("33"), problems.functions["SR2"]
    result = swapped(mesh, u, name, norm=norm, min_angle=limit)
    new = [t for t in result.mesh.elements if tuple(sorted(t)) not in as_set(mesh)]
    assert len(new) or limit == 40
    for t in new:
        assert np.degrees(angles(mesh.nodes[t][None])).min() >= limit * (1 - 1e-9)
    if limit > 5:  # the limit bites
        assert len(new) < len(as_set(swapped(mesh, u, name, norm=norm).mesh) - as_set(mesh))


@pytest.mark.parametrize("name, norm", [("jnd", 2), ("jnd", "lexicographic")])
def test_no_swap_creates_an_element_below_the_area(name, norm):
    mesh, u = problems.mesh("33"), problems.functions["SR2"]
    limit = float(np.quantile(mesh.areas, 0.4))
    result = swapped(mesh, u, name, norm=norm, min_area=limit)
    new = np.array([tuple(sorted(t)) not in as_set(mesh) for t in result.mesh.elements])
    assert new.any() and result.mesh.areas[new].min() >= limit * (1 - 1e-9)  # all areas are multiples of .005


@pytest.mark.parametrize("scale", [1.0, 0.1, 1 / 3, 1e-6])
@pytest.mark.parametrize("limit", [{"min_angle": 45}, {"min_area": 0.5}])
@pytest.mark.parametrize("norm", [2, "lexicographic"])
def test_a_limit_that_is_just_met_is_met_at_any_scale(scale, limit, norm):
    """Halves of squares have 45 degrees and half the area; rounding must not decide."""
    limit = {k: v * scale**2 if k == "min_area" else v for k, v in limit.items()}
    mesh = delaunay(lattice(3, 3) * scale)
    values = np.round(10 * np.sin(np.arange(16) ** 2))
    free, limited = swapped(mesh, values, norm=norm), swapped(mesh, values, norm=norm, **limit)
    squares = np.degrees(angles(free.mesh.corners)).min(axis=1) > 44
    assert limited.swaps > 0
    assert np.isclose(limited.mesh.areas, 0.5 * scale**2).all() and squares.any()


def test_no_limit_and_a_limit_of_zero_are_the_same():
    mesh, u = problems.mesh("33"), problems.functions["SR2"]
    assert swapped(mesh, u, min_angle=0, min_area=0).mesh.equals(swapped(mesh, u).mesh)


# -- theorems ------------------------------------------------------------------------------


@pytest.mark.parametrize("norm", ["max", "lexicographic"])
def test_the_max_min_angle_criterion_gives_delaunay(norm, rng):
    """Lawson 1972, Sibson 1978: from any mesh."""
    for _ in range(5):
        best = delaunay(rng.random((25, 2)))
        result = swapped(shuffled(best, rng), np.zeros(25), "smallest-angle", norm=norm)
        assert result.mesh.equals(best)


@settings(max_examples=60)
@given(problems_of(scales=(1.0, 2.0**-30)))
def test_with_ties_it_gives_a_delaunay_mesh(problem):
    mesh, values = problem
    assert is_delaunay(swapped(mesh, values, "smallest-angle", norm="max").mesh)


def paraboloid(x, y):
    return x**2 + y**2


def bowl(x, y):
    return np.exp(x + y / 2) + x**4 + 20 * y**2


@pytest.mark.parametrize("u", [paraboloid, bowl])
def test_convex_data_have_one_optimum(u, rng):
    """From any start in any order the min-error criterion ends in the lower convex hull.

    Norm 2, that is: it adds the squared errors of two elements to the error on both.
    """
    nodes = rng.random((14, 2))
    expected = lower_hull(nodes, u)
    for _ in range(4):
        start = shuffled(delaunay(nodes), rng)
        result = swapped(start, u, criteria.min_error(u), norm=2, order=rng.permutation(start.n_edges))
        assert as_set(result.mesh) == expected
    assert (expected == as_set(delaunay(nodes))) == (u is paraboloid)


def lower_hull(nodes, u):
    from scipy.spatial import ConvexHull

    hull = ConvexHull(np.column_stack([nodes, u(*nodes.T)]))
    return frozenset(tuple(sorted(t)) for t in hull.simplices[hull.equations[:, 2] < 0].tolist())


# -- data and results --------------------------------------------------------------------------


def test_one_swap_by_hand():
    """u = 1 at nodes 0 and 2 of the square: the ridge 0-2 is one, the valley 1-3 another.

    With a fifth node beside it, only the diagonal 0-2 leaves the data of the outer element in plane.
    """
    mesh = Mesh([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0]], [[0, 1, 3], [1, 2, 3], [1, 4, 2]])
    u = np.array([0.0, 1, 2, 1, 2])
    u[2] = 1.0  # u = x but for the corner (0, 1)
    result = swapped(mesh, u)
    assert (result.swaps, result.sweeps) == (1, 2)
    assert as_set(result.mesh) == {(0, 1, 2), (0, 2, 3), (1, 2, 4)}
    row = result.history[result.history["accepted"]][0]
    assert sorted(int(row[k]) for k in "ab") == [1, 3] and sorted(int(row[k]) for k in "cd") == [0, 2]


def test_results_are_frozen():
    result = swapped(problems.mesh("33"), problems.functions["SR1"])
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.swaps = 0
    with pytest.raises(ValueError, match="read-only"):
        result.mesh.elements[0] = 0


def test_no_interior_edge_no_swap():
    mesh = Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    for norm in NORMS:
        result = swapped(mesh, [1, 2, 4], norm=norm)
        assert (result.swaps, result.sweeps, result.tried, result.mesh) == (0, 1, 0, mesh)
        assert len(result.history) == 0


@pytest.mark.parametrize(
    "values",
    [
        lambda v: v.tolist(),
        np.float32,
        lambda v: v.astype(int),
        lambda v: np.repeat(v, 2)[::2],
        lambda v: v.astype(">f8"),
    ],
)
def test_any_array_like_is_taken(values):
    mesh = problems.mesh("33")
    data = np.round(20 * problems.functions["SR1"](*mesh.nodes.T))
    assert swapped(mesh, values(data)).mesh.equals(swapped(mesh, data).mesh)


def test_a_mesh_with_a_hole_keeps_it(frame, rng):
    result = swapped(frame, rng.standard_normal(16), "abn")
    assert result.swaps > 0
    assert result.mesh.validate().counts == frame.counts and result.mesh.domain_area == 8


@pytest.mark.parametrize("shift, scale", [(0, 1e-9), (1e6, 1), (0, 1e9)])
def test_place_and_size_do_not_matter(shift, scale):
    exact, shift = 2.0 ** round(np.log2(scale)), float(shift)
    mesh = problems.mesh("81")
    moved = Mesh(exact * mesh.nodes + shift, mesh.elements)
    u = problems.functions["SR1"](*mesh.nodes.T)
    assert np.array_equal(swapped(moved, u).mesh.elements, swapped(mesh, u).mesh.elements)


@pytest.mark.parametrize("name", ["jnd", "dlp"])
@pytest.mark.parametrize("factor", [2.0**-60, 2.0**60])
def test_the_size_of_the_data_does_not_matter(name, factor):
    mesh, u = problems.mesh("33"), problems.functions["SR2"](*problems.nodes("33").T)
    assert swapped(mesh, factor * u, name).mesh.equals(swapped(mesh, u, name).mesh)


def test_very_thin_elements_are_no_obstacle(rng):
    nodes = np.vstack([lattice(4, 1) * [1, 1e-7], rng.random((6, 2)) * [4, 1e-7]])
    mesh = delaunay(nodes)
    for name in criteria.names():
        result = swapped(mesh, rng.standard_normal(16), name)
        assert result.mesh.validate().counts == mesh.counts
