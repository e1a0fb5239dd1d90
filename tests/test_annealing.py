"""Annealing: never worse than the local optimum, and the best of all meshes where these can be listed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import as_set, shuffled

from meshlib import Mesh, MeshError, annealed, criteria, delaunay, optimal, problems, swapped
from meshlib.support.random_numbers import Draws
from meshlib.swapping.swapped import prepared
from meshlib.swapping.walk import _Compiled, _Plain, walk_from
from meshlib.thesis.studies import section_7_6_beyond as beyond

QUICK = {"levels": 20, "tries": 5}


@settings(max_examples=30)
@given(
    problems_of(most=10), st.sampled_from(("jnd", "abn", "dfp", "smallest-angle")), st.sampled_from((1, 2))
)
def test_valid_and_never_worse(problem, name, norm):
    mesh, values = problem
    result = annealed(mesh, values, name, norm=norm, levels=5, tries=2)
    assert result.mesh.validate().counts == mesh.counts
    assert result.cost_after <= result.cost_swapped <= result.cost_before * (1 + 1e-12)
    assert result.cost_swapped == swapped(mesh, values, name, norm=norm).cost_after
    assert swapped(result.mesh, values, name, norm=norm).swaps == 0


def test_the_seed_tells_all():
    mesh, u = problems.mesh("33"), problems.SR2
    one, again, other = (annealed(mesh, u, seed=seed, **QUICK) for seed in (3, 3, 4))
    assert one.mesh.equals(again.mesh) and np.array_equal(one.history, again.history) and one.seed == 3
    assert not np.array_equal(one.history, other.history)


@pytest.mark.parametrize("name, norm", [("jnd", 2), ("abn", 1)])
def test_the_proved_optimum_of_33_nodes(name, norm):
    mesh, u = problems.mesh("33"), problems.SR2
    result, best = annealed(mesh, u, name, norm=norm), optimal(mesh, u, name, norm=norm)
    assert (
        result.cost_after == pytest.approx(best.cost_after, rel=1e-9)
        and result.cost_swapped > 1.1 * best.cost_after
    )


@pytest.mark.parametrize("name, norm", [("jnd", 1), ("abn", 1), ("dlp", 1)])
def test_the_best_of_all_listed_meshes(name, norm):
    found = beyond.distances(name, norm, sets=4)
    assert found.share("annealed") == 1 > found.share("swapped")
    assert (found.swapped >= found.best * (1 - 1e-12)).all()


def test_listed_costs_are_those_of_the_meshes():
    """The start is the first of them, and the local optimum is in the list."""
    costs, run = beyond.listed("abn", 1, "SR2", 0)
    start, every = beyond.small_case(0)
    assert costs[0] == pytest.approx(run.cost_before) and np.isclose(costs, run.cost_swapped).any()
    last = Mesh(start.nodes, every.elements[-start.n_elements :] % start.n_nodes).validate()
    assert costs[-1] == pytest.approx(criteria.costs(last, problems.SR2, "abn").sum())


def test_more_nodes():
    """Annealing is at most a thousandth above the proved optimum, where swapping costs twice as much."""
    case = "81", "SR3", "abn", 1
    best = optimal(problems.mesh("81"), problems.SR3, "abn", norm=1)
    assert best.bound == pytest.approx(best.cost_after, rel=1e-9)
    for seed in range(2):
        run = beyond.annealing(*case, seed)
        assert best.bound * (1 - 1e-9) <= run.cost_after < 1.001 * best.cost_after < run.cost_swapped / 2


# -- the walk -----------------------------------------------------------------------------------

BENT = [0.0, 0, 0, 1]  # over the square: normals (0, 0, 1), (1, -1, 1), or swapped (0, -1, 1), (1, 0, 1)
BEFORE, AFTER = np.arctan(np.sqrt(2)), np.pi / 3


def procedure_of(mesh, values, name, norm):
    return prepared(mesh, values, name, norm, None, None, None)


@settings(max_examples=30)
@given(
    problems_of(9, (1.0,)),
    st.sampled_from(("jnd", "abn", "dfp", "smallest-angle")),
    st.sampled_from((1, 2)),
    st.integers(0, 99),
)
def test_the_compiled_walk_is_the_plain_one(problem, name, norm, seed):
    """Rises that are no multiple of what swaps may add, so that nothing hangs on rounding."""
    procedure, draws = procedure_of(*problem, name, norm), Draws(seed)
    edges, rises = draws.indices(problem[0].n_edges, 30), draws.exponential(30)
    compiled, plain = _Compiled(procedure), _Plain(procedure)
    for part in (slice(0, 10), slice(10, 30)):
        compiled.go(edges[part], rises[part])
        plain.go(edges[part], rises[part])
        assert as_set(compiled.mesh) == as_set(plain.mesh) and compiled.swaps == plain.swaps
    assert compiled.differences() == pytest.approx(plain.differences(), rel=1e-9, abs=1e-9)
    assert compiled.mesh.validate()


@pytest.mark.parametrize("norm", [1, 2])
def test_what_a_swap_adds(square, norm):
    walk = walk_from(procedure_of(square, BENT, "abn", norm))
    assert walk.differences() == pytest.approx([AFTER**norm - BEFORE**norm])
    assert walk.swaps == 0 and walk.mesh.equals(square)


@pytest.mark.parametrize("way", [_Compiled, _Plain])
@pytest.mark.parametrize("slack, swaps", [(-1e-9, 0), (1e-9, 1)])
def test_a_swap_is_made_if_it_adds_less_than_allowed(square, way, slack, swaps):
    walk = way(procedure_of(square, BENT, "abn", 1))
    walk.go(square.edge_numbers([[0, 2]]), np.array([AFTER - BEFORE + slack]))
    assert walk.swaps == swaps
    assert as_set(walk.mesh) == ({(0, 1, 3), (1, 2, 3)} if swaps else as_set(square))


@pytest.mark.parametrize("seed", range(3))
def test_convex_data_have_one_local_optimum(seed):
    """With min-error swapping, annealing and the list agree from any start: the lower convex hull."""
    rng = np.random.default_rng(seed)
    start, u = delaunay(rng.random((8, 2))), lambda x, y: x**2 + x * y + 2 * y**2
    criterion = criteria.min_error(u)
    every = beyond.side_by_side(start, beyond.enumerated(start))
    best = beyond.costs_of_parts(start, every, u(*start.nodes.T), criterion, 2).min()
    other = shuffled(start, rng)
    assert swapped(other, u, criterion).cost_after == pytest.approx(best, rel=1e-9)
    assert annealed(other, u, criterion, **QUICK).cost_after == pytest.approx(best, rel=1e-9)


def test_the_cost_of_an_element_does_not_depend_on_its_first_node():
    """The quadrature of min-error is not symmetric in the three nodes."""
    mesh, criterion = problems.mesh("33"), criteria.min_error(problems.SR2)
    turned = Mesh(mesh.nodes, np.roll(mesh.elements, 1, axis=1))
    assert np.array_equal(criterion.costs(mesh, problems.SR2), criterion.costs(turned, problems.SR2))


def test_costs_that_kernels_do_not_know():
    result = annealed(problems.mesh("33"), problems.SR2, "gradient-spread", levels=3, tries=1)
    assert result.mesh.validate() and result.cost_after <= result.cost_swapped < result.cost_before


def test_flat_data_leave_nothing_to_do():
    result = annealed(problems.mesh("33"), np.zeros(33))
    assert result.mesh.equals(problems.mesh("33")) and len(result.history) == 0


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ({"norm": "max"}, "unknown: norm 'max' is not known (known: 'L1', 'L2')"),
        ({"seed": -1}, "range: seed is -1; give a whole number of at least 0"),
        ({"levels": 0}, "range: levels is 0; give a whole number of at least 1"),
        ({"tries": 0}, "range: tries is 0; give a whole number of at least 1"),
    ],
)
def test_bad_arguments(arguments, expected):
    with pytest.raises(MeshError) as error:
        annealed(problems.mesh("33"), problems.SR2, **arguments)
    assert str(error.value) == expected
