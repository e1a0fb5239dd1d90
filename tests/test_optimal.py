"""The best of all meshes: listed, proved, and found by many edge orders."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import all_meshes, as_set, lattice, polygon, shuffled

from meshlib import Interpolant, Mesh, MeshError, NotReachedError, criteria, delaunay, problems, swapped
from meshlib.optima.enumeration import enumerated
from meshlib.optima.many_orders import local_optima, order_of
from meshlib.optima.proved import optimal

CONCAVE = Mesh(
    [[0, 0], [4, 0], [4, 4], [2, 2], [0, 4], [1, 1], [3, 1]],
    [[0, 1, 5], [1, 6, 5], [1, 2, 6], [2, 3, 6], [3, 5, 6], [3, 4, 5], [4, 0, 5]],
).validate()


def meshes_of(start):
    return [Mesh(start.nodes, elements).validate() for elements in enumerated(start)]


@pytest.mark.parametrize("nodes, number", [(polygon(7), 42), (lattice(2, 2), 64), (lattice(3, 1), 20)])
def test_every_mesh_is_listed_once(nodes, number):
    """Catalan numbers; lattices by Kaibel & Ziegler 2003."""
    found = meshes_of(delaunay(nodes))
    assert len(found) == len(set(map(as_set, found))) == number
    assert set(map(as_set, found)) == set(map(as_set, all_meshes(delaunay(nodes))))


def test_listing_refuses_a_hole(frame):
    """Flips need not lead from any mesh to any other around a hole."""
    with pytest.raises(MeshError) as error:
        enumerated(frame)
    assert str(error.value) == "domain: the domain has a hole or is in parts; give one without"


def test_listing_stops_with_a_remedy():
    with pytest.raises(MeshError) as error:
        enumerated(delaunay(polygon(8)), most=100)  # 132
    assert str(error.value) == "range: there are more than 100 meshes; give fewer nodes or raise most"


@pytest.mark.parametrize("name", ["jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle"])
@pytest.mark.parametrize("norm", [1, 2])
@pytest.mark.parametrize("seed", range(3))
def test_no_listed_mesh_is_better(name, norm, seed):
    rng = np.random.default_rng(seed)
    start, values = delaunay(rng.random((8, 2))), rng.standard_normal(8)
    costs = [np.linalg.norm(criteria.costs(m, values, name), norm) for m in meshes_of(start)]
    found = optimal(start, values, name, norm=norm)
    assert found.cost_after == pytest.approx(min(costs), rel=1e-12)
    assert found.bound <= found.cost_after
    assert len(costs) > 20 and max(costs) > found.cost_after


@settings(max_examples=40)
@given(problems_of(most=8, scales=(1.0, 0.1)), st.sampled_from(("jnd", "abn")), st.sampled_from((1, 2)))
def test_no_listed_mesh_is_better_among_ties(problem, name, norm):
    mesh, values = problem
    costs = [np.linalg.norm(criteria.costs(m, values, name), norm) for m in meshes_of(mesh)]
    found = optimal(mesh, values, name, norm=norm)
    assert found.mesh.validate().counts == mesh.counts
    assert found.cost_after == pytest.approx(min(costs), rel=1e-10, abs=1e-10)
    assert found.bound <= min(costs) * (1 + 1e-10) + 1e-10


@pytest.mark.parametrize("start", [CONCAVE, "frame"])
def test_the_domain_is_kept(start, request, rng):
    """A bay and a hole: no element may cross or fill them."""
    start = request.getfixturevalue(start) if isinstance(start, str) else start
    values = rng.standard_normal(start.n_nodes)
    best = optimal(start, values, "jnd", norm=1)
    assert best.mesh.validate().domain_area == pytest.approx(start.domain_area)
    edges = {tuple(e) for e in start.edges[start.boundary].tolist()}
    assert {tuple(e) for e in best.mesh.edges[best.mesh.boundary].tolist()} == edges
    if start is CONCAVE:
        assert best.cost_after == pytest.approx(
            min(np.linalg.norm(criteria.costs(m, values, "jnd"), 1) for m in meshes_of(start))
        )


def test_the_least_l2_error_of_the_paraboloid_is_that_of_delaunay(rng):
    nodes = rng.random((20, 2))
    u = problems.functions["convex"]
    best = optimal(shuffled(delaunay(nodes), rng), u, criteria.min_error(u), norm=2)
    assert best.mesh.equals(delaunay(nodes))
    assert best.bound == pytest.approx(best.cost_after, rel=1e-10)
    assert best.cost_after == pytest.approx(Interpolant(best.mesh, u).l2_error(u, rule="exact"), rel=1e-12)


@pytest.mark.parametrize(
    "function, norm, cost",
    [("SR1", 1, 9.436366858276), ("SR1", 2, 2.371595592102), ("SR2", 1, 16.767967094016)],
)
def test_proved_optima_on_33_nodes(function, norm, cost):
    found = optimal(problems.mesh("33"), problems.functions[function], "abn", norm=norm)
    assert found.cost_after == pytest.approx(cost, rel=1e-11)
    assert found.bound == pytest.approx(cost, rel=1e-11)
    many = local_optima(problems.mesh("33"), problems.functions[function], "abn", norm=norm, orders=50)
    assert (many.costs >= found.bound * (1 - 1e-12)).all()


@pytest.mark.parametrize(
    "arguments, message",
    [
        (
            {"criterion": "gradient-spread"},
            "unknown: criterion 'gradient-spread' is on nodes; give one on edges or elements",
        ),
        ({"norm": "max"}, "unknown: norm 'max' is not known (known: 'L1', 'L2')"),
    ],
)
def test_what_is_no_sum_is_refused(square, arguments, message):
    with pytest.raises(MeshError) as error:
        optimal(square, [0, 0, 1, 0], **arguments)
    assert str(error.value) == message


@pytest.mark.parametrize(
    "on, what, count", [("edge", "pair of empty triangle", 2), ("element", "empty triangle", 4)]
)
def test_costs_that_are_not_finite_are_named(square, on, what, count):
    criterion = criteria.Criterion("nan", on, lambda *points: np.full(len(points[0]), np.nan))
    with pytest.raises(MeshError) as error:
        optimal(square, [0, 0, 1, 0], criterion)
    assert str(error.value) == (
        f"cost: the cost of {what} 0 is nan; a criterion must return finite numbers of at least 0 "
        f"({count} in all, see .items)"
    )


def test_the_solver_stops_in_time():
    with pytest.raises(NotReachedError) as error:
        optimal(problems.mesh("81"), problems.SR2, "abn", norm=1, seconds=0)
    assert str(error.value) == "solver: no mesh found within 0 s; give fewer nodes or more seconds"


def test_the_best_mesh_so_far_is_kept_when_the_time_is_up(monkeypatch):
    """The solver ends early at a point that satisfies all constraints; the bound stays a bound."""
    import scipy.optimize

    solve = scipy.optimize.milp

    def hurried(*arguments, **options):
        found = solve(*arguments, **options)
        found.success, found.status = False, 1  # as at a time limit
        return found

    monkeypatch.setattr(scipy.optimize, "milp", hurried)
    found = optimal(problems.mesh("33"), problems.SR2, "abn", norm="L1")
    assert not found.proved and found.mesh.validate().counts == (33, 88, 56)
    assert found.bound <= found.cost_after < found.cost_before


def test_too_many_nodes_are_refused():
    mesh = delaunay(lattice(10, 10))
    with pytest.raises(MeshError) as error:
        optimal(mesh, np.zeros(mesh.n_nodes))
    assert str(error.value) == "range: the mesh has 121 nodes; give at most 120"


# -- many edge orders ----------------------------------------------------------------------


def test_each_order_leads_where_swapping_leads():
    mesh, u = problems.mesh("33"), problems.SR2
    found = local_optima(mesh, u, "abn", norm=1, orders=60, seed=3)
    assert found.optimum.shape == (60,) and found.counts.sum() == 60 and len(found) > 1
    assert len({elements.tobytes() for elements in found.elements}) == len(found)
    for k in range(60):
        one = swapped(mesh, u, "abn", norm=1, order=order_of(3, k, mesh.n_edges))
        assert one.mesh.equals(found.mesh_of(found.optimum[k]))
        assert one.cost_after == pytest.approx(found.costs[found.optimum[k]])


def test_the_best_of_them_costs_least():
    found = local_optima(problems.mesh("33"), problems.SR2, "abn", norm=1, orders=60)
    cost = np.linalg.norm(criteria.costs(found.mesh.validate(), problems.SR2, "abn"), 1)
    assert cost == pytest.approx(found.costs.min()) and cost < found.costs.max()


@pytest.mark.parametrize("workers", [2, -1])
def test_workers_do_not_change_the_result(workers):
    pytest.importorskip("joblib")
    arguments = problems.mesh("33"), problems.functions["franke"], "jnd"
    alone, shared = (local_optima(*arguments, orders=40, workers=n) for n in (1, workers))
    assert np.array_equal(alone.elements, shared.elements) and np.array_equal(alone.optimum, shared.optimum)


@pytest.mark.parametrize("orders, most, parts", [(3, 500, 3), (64, 500, 64), (100, 500, 50), (100, 1, 100)])
def test_even_a_few_orders_are_shared_out(square, orders, most, parts, monkeypatch):
    """64 parts or fewer, unless they get too large: 100 orders are 50 times two."""
    sizes = []

    def shared(function, parts, *_, total):
        sizes.extend(len(numbers) for *_, numbers in parts)
        assert total == len(parts)
        return [function(*part) for part in parts]

    monkeypatch.setattr("meshlib.optima.many_orders.shared", shared)
    monkeypatch.setattr("meshlib.optima.many_orders.ORDERS_AT_ONCE", most)
    local_optima(square, [0, 0, 1, 0], orders=orders)
    assert (len(sizes), sum(sizes)) == (parts, orders)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"orders": 0}, "range: orders is 0; give a whole number of at least 1"),
        ({"seed": -1}, "range: seed is -1; give a whole number of at least 0"),
        ({"workers": 0}, "range: workers is 0; give a whole number of at least 1, or -1 for all cores"),
        ({"workers": -2}, "range: workers is -2; give a whole number of at least 1, or -1 for all cores"),
    ],
)
def test_arguments_are_checked(square, arguments, message):
    with pytest.raises(MeshError) as error:
        local_optima(square, [0, 0, 1, 0], **arguments)
    assert str(error.value) == message
