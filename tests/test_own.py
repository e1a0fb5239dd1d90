"""Criteria of one's own by the cost of a single edge or element, and min error for a known u."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import lattice, shuffled

from meshlib import Interpolant, Mesh, MeshError, criteria, delaunay, problems, swapped
from meshlib.kernels import ANY, for_work
from meshlib.mesh.topology import from_smallest

NUMBA = for_work(ANY).is_compiled


def jump(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
    """JND by hand: each gradient from two differences, and the length of their difference."""
    A = (qx - px) * (ly - py) - (lx - px) * (qy - py)
    gx = ((qu - pu) * (ly - py) - (lu - pu) * (qy - py)) / A
    gy = ((qx - px) * (lu - pu) - (lx - px) * (qu - pu)) / A
    B = (qx - px) * (ry - py) - (rx - px) * (qy - py)
    hx = ((qu - pu) * (ry - py) - (ru - pu) * (qy - py)) / B
    hy = ((qx - px) * (ru - pu) - (rx - px) * (qu - pu)) / B
    return math.sqrt((gx - hx) ** 2 + (gy - hy) ** 2)


def flatness(ax, ay, au, bx, by, bu, cx, cy, cu):
    """Sum of squared sides over the area, less its value for an equilateral element."""
    area = ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2
    sides = (
        (bx - ax) ** 2 + (by - ay) ** 2 + (cx - bx) ** 2 + (cy - by) ** 2 + (ax - cx) ** 2 + (ay - cy) ** 2
    )
    return abs(sides / area - 4 * math.sqrt(3.0))


def unit(extent, height):
    return height / extent


JUMP = criteria.pointwise("own-jump", "edge", jump, unit=unit)
FLATNESS = criteria.pointwise("own-flatness", "element", flatness)


def in_python(criterion):
    """The criterion without its compiled form: the procedure runs in Python on the vectorised cost."""
    return dataclasses.replace(criterion, code=-1)


def assert_same(mesh, values, criterion, other, norm, **arguments):
    ours, theirs = (swapped(mesh, values, c, norm=norm, **arguments) for c in (criterion, other))
    assert ours.mesh.validate().equals(theirs.mesh)
    assert (ours.swaps, ours.sweeps, ours.tried) == (theirs.swaps, theirs.sweeps, theirs.tried)


@settings(max_examples=60)
@given(problems_of(), st.sampled_from((1, 2, "max")), st.sampled_from(("sweep", "queue")))
def test_jnd_written_by_a_user_is_jnd(problem, norm, schedule):
    mesh, values = problem
    assert_same(mesh, values, JUMP, "jnd", norm, schedule=schedule)


@settings(max_examples=40)
@given(
    problems_of(),
    st.sampled_from((1, 2, "max")),
    st.sampled_from(("sweep", "queue")),
    st.sampled_from((JUMP, FLATNESS)),
)
def test_kernels_and_the_procedure_in_python_agree(problem, norm, schedule, criterion):
    mesh, values = problem
    assert_same(mesh, values, criterion, in_python(criterion), norm, schedule=schedule)


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
@pytest.mark.parametrize("name", ["SR1", "SR2", "SR3", "saddle", "product"])
def test_min_error_in_kernels(name, schedule):
    u, mesh = problems.functions[name], problems.mesh("33")
    criterion = criteria.min_error(u)
    assert criterion.is_compiled
    assert_same(mesh, u, criterion, in_python(criterion), 2, schedule=schedule)
    found = swapped(mesh, u, criterion, norm=2)
    turned = Mesh(mesh.nodes, from_smallest(found.mesh.elements))  # the rule is not symmetric in the nodes
    assert found.cost_after == pytest.approx(Interpolant(turned, u).l2_error(u, rule="exact", degree=6))


def test_a_function_that_numba_cannot_compile_runs_in_python():
    u = problems.functions["DD1"]  # np.select of single numbers
    criterion = criteria.min_error(u)
    assert criterion.is_compiled is not NUMBA
    assert swapped(problems.mesh("33"), u, criterion, norm=2).swaps > 0


def test_a_cost_that_numba_cannot_compile_is_named_and_runs_in_python():
    def by_name(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
        return getattr(math, "hyp" + "ot")(px - qx, py - qy)

    if NUMBA:
        with pytest.warns(RuntimeWarning, match="cannot compile the cost of 'length'; the procedure"):
            found = criteria.pointwise("length", "edge", by_name)
    else:
        found = criteria.pointwise("length", "edge", by_name)
    long = shuffled(delaunay(lattice(4, 4)), np.random.default_rng(1))
    result = swapped(long, np.zeros(long.n_nodes), found, norm=1)
    assert result.swaps > 0 and result.cost_after < result.cost_before


def test_the_cost_vector_is_that_of_the_single_costs():
    mesh, u = problems.mesh("33"), problems.SR2
    assert np.allclose(criteria.costs(mesh, u, JUMP), criteria.costs(mesh, u, "jnd"), rtol=1e-12, atol=1e-14)
    points = np.column_stack([mesh.nodes, u(*mesh.nodes.T)])[mesh.elements].reshape(-1, 9)
    assert criteria.costs(mesh, u, FLATNESS).tolist() == [flatness(*row) for row in points.tolist()]


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
@pytest.mark.parametrize("on", ["edge", "element"])
def test_what_is_no_cost_is_refused_before_anything_is_swapped(schedule, on):
    def edge(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
        return -1.0

    def element(ax, ay, au, bx, by, bu, cx, cy, cu):
        return math.nan

    bad = criteria.pointwise("bad", on, {"edge": edge, "element": element}[on])
    with pytest.raises(MeshError, match=f"cost of (inner )?{on} 0 is"):
        swapped(problems.mesh("33"), problems.SR1, bad, schedule=schedule)


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
def test_a_cost_that_fails_on_the_way_names_the_edge(square, schedule):
    def short_only(px, py, pu, qx, qy, qu, lx, ly, lu, rx, ry, ru):
        return 1.0 if px == 0.0 and py == 0.0 else math.inf  # the other diagonal starts elsewhere

    with pytest.raises(MeshError) as error:
        swapped(square, [0, 0, 1, 0], criteria.pointwise("half", "edge", short_only), schedule=schedule)
    assert str(error.value) == (
        "cost: a cost around edge (0, 2) is negative or not finite; "
        "a criterion must return finite numbers of at least 0"
    )


def test_criteria_on_nodes_have_no_single_cost():
    with pytest.raises(MeshError, match="place 'node' is not known"):
        criteria.pointwise("patch", "node", jump)
    with pytest.raises(MeshError, match="the cost of 'jump' is 3; give a function"):
        criteria.pointwise("jump", "edge", 3)


def test_a_criterion_can_be_sent_to_other_processes():
    joblib = pytest.importorskip("joblib")
    mesh, u = problems.mesh("33"), problems.SR2
    there = joblib.Parallel(n_jobs=2)(joblib.delayed(swapped)(mesh, u, JUMP, norm=n) for n in (1, 2))
    assert all(
        r.mesh.equals(swapped(mesh, u, "jnd", norm=n).mesh) for r, n in zip(there, (1, 2), strict=True)
    )
