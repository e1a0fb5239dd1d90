"""The procedure for vectorised costs and the lexicographic order against its definition, bit for bit."""

import dataclasses

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of

from meshlib import MeshError, criteria, delaunay, problems
from meshlib.criteria import cost_functions as costs
from meshlib.criteria.norms import NORMS
from meshlib.mesh.topology import canonical
from meshlib.swapping import plain
from meshlib.swapping.swapped import prepared


def slope_and_length(p, q, left, right):
    """A cost on edges: the jump of the gradients times a root of the length in space."""
    jump = costs.plane_gradients(p, q, left) - costs.plane_gradients(q, p, right)
    return np.hypot(*jump.T) * np.sqrt(np.linalg.norm(p - q, axis=1))


def perimeter(a, b, c):
    """A cost on elements: the sum of the three sides in space, squared sides added."""
    sides = [np.linalg.norm(v, axis=1) for v in (a - b, b - c, c - a)]
    return sides[0] + sides[1] + sides[2] + np.maximum.reduce(sides) ** 2


def unit(extent, height):
    return height + extent


CRITERIA = (
    *(criteria.get(name) for name in ("jnd", "abn", "dfp", "largest-angle")),
    criteria.Criterion("slope and length", "edge", slope_and_length, unit=unit),
    criteria.Criterion("perimeter", "element", perimeter),
    criteria.Criterion("spread", "node", costs.gradient_spread, unit=unit),
    criteria.Criterion("exponential", "element", lambda a, b, c: np.exp(np.sin(a[:, 2]) + np.cos(c[:, 0]))),
)
LIMITS = ((None, None), (10, None), (None, 0.01), (3, 1e-3))
SCHEDULES = {"sweep": plain.swept, "queue": plain.drained}


def assert_exact(procedure, order, schedule):
    """Everything the definition gives, to the last bit; returns the number of swaps."""
    theirs = reference.run(procedure, order, schedule)
    ours = dataclasses.replace(procedure, criterion=dataclasses.replace(procedure.criterion, code=-1))
    found = ours.run(order, True, schedule)
    assert (found.swaps, found.sweeps, found.tried) == (theirs.swaps, theirs.sweeps, theirs.tried)
    assert np.array_equal(canonical(found.elements), theirs.elements)
    assert found.trace.tolist() == theirs.trace.tolist()
    assert ours.run(order, False, schedule).elements.tolist() == found.elements.tolist()
    return found.swaps


@settings(max_examples=250)
@given(
    problems_of(),
    st.sampled_from(CRITERIA),
    st.sampled_from(NORMS),
    st.sampled_from(LIMITS),
    st.sampled_from(sorted(SCHEDULES)),
    st.integers(0, 999),
)
def test_meshes_counts_and_traces_are_those_of_the_definition(
    problem, criterion, norm, limits, schedule, seed
):
    procedure = prepared(*problem, criterion, norm, *limits, None)
    order = np.random.default_rng(seed).permutation(problem[0].n_edges)
    assert_exact(procedure, order, schedule)


@pytest.mark.parametrize("schedule", SCHEDULES)
@pytest.mark.parametrize("norm", NORMS)
@pytest.mark.parametrize("criterion", CRITERIA, ids=lambda c: c.name)
def test_on_noisy_data_of_many_nodes(criterion, norm, schedule):
    rng = np.random.default_rng(NORMS.index(norm))
    mesh = delaunay(rng.random((60, 2)))
    procedure = prepared(mesh, rng.standard_normal(60), criterion, norm, None, None, None)
    assert assert_exact(procedure, rng.permutation(mesh.n_edges), schedule) > 0


@settings(max_examples=60)
@given(problems_of(9, (1.0,)), st.sampled_from(CRITERIA), st.sampled_from((1, 2)), st.integers(0, 99))
def test_a_walk_is_that_of_the_definition(problem, criterion, norm, seed):
    procedure, rng = prepared(*problem, criterion, norm, None, None, None), np.random.default_rng(seed)
    ours = plain.Run(procedure)
    theirs = reference.state_of(procedure)
    for e, rise in zip(
        rng.integers(0, problem[0].n_edges, 30).tolist(), rng.exponential(size=30), strict=True
    ):
        ours.tolerance = theirs.tolerance = 0.0, -rise
        ours.inspect(e)
        theirs.inspect(e, 0)
        assert ours.elements.tolist() == theirs.elements.tolist() and ours.swaps == theirs.swaps


# -- how much is evaluated -------------------------------------------------------------


class Counted:
    """JND that counts its calls and the edges it was asked for."""

    def __init__(self):
        self.calls = self.edges = 0

    def __call__(self, p, q, left, right):
        self.calls, self.edges = self.calls + 1, self.edges + len(p)
        return costs.jump_in_normal_derivatives(p, q, left, right)


@pytest.mark.parametrize("schedule", SCHEDULES)
def test_a_cost_is_called_once_for_each_inspection(schedule):
    """Each call is for five edges, and once for each inner edge of the start mesh.

    With a queue, every try is a call.  In a sweep only an edge near a swap is tried with
    a call: a swap may change the local costs of 13 edges.
    """
    cost, mesh = Counted(), problems.mesh("81")
    procedure = prepared(mesh, problems.SR2, criteria.Criterion("counted", "edge", cost), 1, None, None, None)
    run, inner = plain.Run(procedure), int((~mesh.boundary).sum())
    SCHEDULES[schedule](run, range(mesh.n_edges))
    assert run.swaps > 20 and cost.edges <= 5 * cost.calls + inner
    if schedule == "queue":
        assert cost.calls == run.tried
    else:
        assert cost.calls <= inner + 13 * run.swaps and cost.calls < run.tried


class Stopping:
    """A watch that stops a run after a number of inspections."""

    def __init__(self, left):
        self.left, self.done = left, []

    def report(self, done):
        self.left -= 1
        self.done.append(done)

    @property
    def stopped(self):
        return self.left < 0


@pytest.mark.parametrize("schedule", SCHEDULES)
def test_a_run_can_be_stopped_and_leaves_the_first_part_of_its_trace(schedule):
    mesh = problems.mesh("33")
    procedure = prepared(mesh, problems.SR2, CRITERIA[4], 1, None, None, None)
    order, watch = np.arange(mesh.n_edges), Stopping(60)
    whole, part = (procedure.run(order, True, schedule, w) for w in (None, watch))
    assert len(part.trace) < len(whole.trace) and watch.done[:3] in ([0, 1, 2], [1, 2, 3])
    assert part.trace.tolist() == whole.trace[: len(part.trace)].tolist()


@pytest.mark.parametrize("schedule", SCHEDULES)
@pytest.mark.parametrize("bad", [-1.0, np.nan, np.inf])
def test_a_vectorised_cost_that_fails_on_the_way_names_the_edge(square, schedule, bad):
    """One for the diagonal of the square, and no cost for the other one, which starts elsewhere."""
    criterion = criteria.Criterion("half", "edge", lambda p, q, left, right: np.where(p[:, 0] == 0, 1.0, bad))
    procedure = prepared(square, [0.0, 0, 1, 0], criterion, 1, None, None, None)
    for run in (procedure.run, lambda *arguments: reference.run(procedure, arguments[0], schedule)):
        with pytest.raises(MeshError) as error:
            run(np.arange(square.n_edges), False, schedule)
        assert str(error.value) == (
            "cost: a cost around edge (0, 2) is negative or not finite; "
            "a criterion must return finite numbers of at least 0"
        )
