"""Meshes made for a known function: what must hold after every step, and how near the limit they come."""

import inspect
import os
import re
import signal
import subprocess
import sys
from dataclasses import FrozenInstanceError, fields, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import lattice

from meshlib import Interpolant, Interrupted, Mesh, MeshError, approximate, delaunay, problems, refined
from meshlib.approximation import node_count, samples, settings, strategy
from meshlib.approximation.approximate import UNIT_SQUARE, Task
from meshlib.approximation.collapse import collapsed, settled_on_boundary
from meshlib.approximation.division import bisected, divided
from meshlib.approximation.error_integrals import Counted, Misfit, half_slopes, powers, rule
from meshlib.approximation.insertion import inserted
from meshlib.approximation.moves import _Sweep, moved
from meshlib.approximation.one_direction import in_turn
from meshlib.approximation.patches import _curvature
from meshlib.approximation.settings import NodeCount, OneDirection, Rounds, Settings
from meshlib.approximation.start_mesh import regular
from meshlib.approximation.swaps import swapped
from meshlib.approximation.working_mesh import Draft
from meshlib.mesh.boundary_sides import CORNER, INTERIOR, sides_of
from meshlib.mesh.quality import angles
from meshlib.support.independent import independent
from meshlib.thesis.studies.appendix_b import settled_error

FRANKE = problems.functions["franke"]


def front(x, y):
    return np.tanh(15 * (np.hypot(x + 0.1, y) - 0.7))


@pytest.fixture
def ring():
    """Eight squares around a square hole."""
    mesh = delaunay(lattice(3, 3))
    middle = mesh.nodes[mesh.elements].mean(axis=1)
    return Mesh(mesh.nodes, mesh.elements[(np.abs(middle - 1.5) > 0.5).any(axis=1)]).validate()


def scattered(rng, n):
    """A square of four nodes along each side, with n nodes inside."""
    return np.concatenate([lattice(3, 3), 0.1 + 2.8 * rng.random((n, 2))]) / 3


def finely(u_h):
    """The same function on elements a quarter of the size, whose quadrature sees more."""
    mesh = refined(u_h.mesh, u_h.values, "abn", fraction=1.0, split="red-green").mesh
    return Interpolant(mesh, u_h(*mesh.nodes.T))


def draft_of(function, mesh):
    return Draft.of(Misfit(Counted(function), 1 / 40), mesh)


def objective(draft):
    return draft.errors.sum() + draft.edge_errors().sum()


# -- what must hold --------------------------------------------------------------------------


@pytest.mark.parametrize("domain", ["square", "ring"])
def test_every_step_leaves_a_valid_mesh_that_interpolates(domain, ring, rng):
    mesh = ring if domain == "ring" else delaunay(scattered(rng, 20))
    seen = set()
    for step, draft in strategy.strategy(draft_of(front, mesh), 150):
        draft.mesh.validate()
        assert draft.mesh.domain_area == pytest.approx(mesh.domain_area, rel=1e-12)
        assert np.array_equal(draft.values, front(*draft.nodes.T))
        u_h = Interpolant(draft.mesh, draft.values)
        assert draft.error == pytest.approx(finely(u_h).l2_error(front, rule="exact", degree=12), rel=5e-3)
        seen.add(step)
    assert draft.n_nodes == 150
    assert seen == {"grown", "moved", "renewed"}


OPERATIONS = [
    swapped,
    moved,
    divided,
    settled_on_boundary,
    strategy.improved,
    lambda draft: inserted(draft, 10),
    lambda draft: bisected(draft, 10),
    lambda draft: collapsed(draft, 0.2),
    lambda draft: draft.measured(4),
    lambda draft: draft.measured_finely(2),
]


def contents(thing):
    """All that a draft holds, down to arrays and numbers, by the way to it."""
    if hasattr(thing, "__dict__") and not isinstance(thing, (type, Counted)):
        return {(k, *way): v for k, part in vars(thing).items() for way, v in contents(part).items()}
    return {(): np.array(thing) if isinstance(thing, np.ndarray) else thing}


@pytest.mark.parametrize("operation", OPERATIONS)
def test_no_operation_changes_what_the_draft_before_it_holds(operation, rng):
    """So a draft that is kept is a complete snapshot, whatever attributes it may have one day."""
    nodes = np.concatenate([scattered(rng, 80), [[0.5, 0.02]]])  # the last may be put on the boundary
    draft = draft_of(lambda x, y: front(x, y) / 8, delaunay(nodes))
    before = contents(draft)
    after = operation(draft)
    held = contents(draft)
    assert {way[0] for way in before} == {field.name for field in fields(Draft)}
    assert all(np.array_equal(held[way], value) for way, value in before.items())
    assert not all(np.array_equal(contents(after).get(way), value) for way, value in before.items())


def test_a_draft_is_read_only(rng):
    draft = draft_of(front, delaunay(scattered(rng, 8)))
    with pytest.raises(FrozenInstanceError):
        draft.values = draft.values + 1
    arrays = [array for array in vars(draft).values() if isinstance(array, np.ndarray)]
    assert len(arrays) == 4 and not any(array.flags.writeable for array in arrays)


def test_a_function_may_return_an_array_that_it_keeps():
    mesh = delaunay(lattice(3, 3) / 3)
    kept = front(*mesh.nodes.T)
    Draft.of(Misfit(Counted(lambda x, y: kept if len(x) == 16 else front(x, y)), 1 / 40), mesh)
    assert kept.flags.writeable


def drained(steps):
    """All that a generator yields, and what it returns."""
    seen = []

    def watched():
        seen.append((yield from steps))

    return list(watched()), seen[0]


def test_rounds_of_renewal_go_on_with_the_best_draft_met(rng):
    start = draft_of(front, delaunay(scattered(rng, 80)))
    steps, best = drained(strategy.renewed_in_rounds(start, start.n_nodes, 4))
    met = [start, *(draft for step, draft in steps if step == "moved")]
    assert len(met) == 5
    assert {draft.n_nodes for draft in met} == {96}
    assert best is min(met, key=objective)


def test_moves_and_swaps_never_raise_the_error(rng):
    draft = draft_of(front, delaunay(scattered(rng, 80)))
    for change in (swapped, moved, swapped, moved, swapped):
        before, draft = draft, change(draft)
        assert objective(draft) < objective(before)
    assert swapped(draft).mesh is draft.mesh


def test_corners_stay_and_holes_stay_open(ring):
    found = approximate(front, nodes=120, domain=ring)
    corners = ring.nodes[sides_of(ring).of_node == CORNER]
    assert len(corners) == 8
    assert (np.abs(found.mesh.nodes[:, None] - corners).sum(axis=2).min(axis=0) == 0).all()
    assert found.mesh.domain_area == pytest.approx(8)
    n, e, t = found.mesh.counts
    assert n - e + t == 0  # Euler: one hole


def test_the_same_seed_gives_the_same_mesh_and_another_another():
    one, again, other = (approximate(front, nodes=50, seed=seed) for seed in (0, 0, 1))
    assert one.mesh.equals(again.mesh) and np.array_equal(one.history, again.history)
    assert not one.mesh.equals(other.mesh)


MESHES_MADE = """
import numpy as np
from meshlib import approximate, problems
for norm in ("L2", "max"):
    for name in ("franke", "DD1"):
        found = approximate(problems.functions[name], nodes=60, norm=norm).mesh
        print(found.nodes.tobytes().hex(), found.elements.tobytes().hex())
"""


def test_processors_that_round_differently_give_the_same_mesh():
    """Products of matrices, and exponentials, differ in their last bits from one processor to another."""
    older = {"OPENBLAS_CORETYPE": "Prescott", "NPY_DISABLE_CPU_FEATURES": "X86_V4,X86_V3"}
    one, other = (
        subprocess.run(
            [sys.executable, "-W", "ignore", "-c", MESHES_MADE],
            env=os.environ | more,
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for more in ({}, older)
    )
    assert len(one.split()) == 8 and other == one


def test_a_plane_costs_nothing():
    found = approximate(lambda x, y: 3 * x - 2 * y + 1, nodes=30)
    assert found.error < 1e-14 and found.mesh.validate().n_nodes == 30


def test_few_nodes():
    assert approximate(front, nodes=4).mesh.counts == (4, 5, 2)
    assert approximate(front, nodes=3, domain=delaunay([[0, 0], [1, 0], [0, 1]])).mesh.counts == (3, 3, 1)
    assert approximate(front, nodes=5).mesh.n_nodes == 5


def test_a_start_mesh_with_too_many_nodes_loses_some(rng):
    start = delaunay(scattered(rng, 60))
    assert approximate(front, nodes=40, domain=start).mesh.validate().n_nodes == 40


@pytest.mark.parametrize("function", [front, problems.functions["DD1"]])
@pytest.mark.parametrize("angle", [10, 20, 30])
def test_no_angle_below_the_limit_and_all_nodes_there_are(function, angle):
    found = approximate(function, nodes=120, min_angle=angle)
    assert np.degrees(angles(found.mesh.corners).min()) >= angle - 1e-9
    assert found.mesh.n_nodes == 120


def test_bisections_leave_angles_as_they_were():
    """Halves of halves of a square are right triangles with two angles of 45 degrees, wherever they lie."""
    draft = Draft.of(Misfit(Counted(front), 1 / 40, np.radians(30)), delaunay(lattice(3, 3) / 3))
    while draft.n_nodes < 200:
        before, draft = draft, bisected(draft, 200 - draft.n_nodes)
        assert before.n_nodes < draft.n_nodes <= 200
    draft.mesh.validate()
    assert np.degrees(angles(draft.mesh.corners)).min() == pytest.approx(45)


def test_an_element_that_would_be_refused_has_an_error_where_a_mesh_has_it():
    corners, values = np.array([[[0.0, 0], [1, 0], [0.5, 1e-6]]]), np.zeros((1, 3))
    misfit = Misfit(Counted(lambda x, y: 1 + 0 * x), 1 / 40)
    assert misfit.on_elements(corners, values) == [np.inf]
    assert misfit.on_elements(corners, values, is_new=False) == pytest.approx(5e-7)


def test_another_power_or_a_finer_quadrature_leaves_the_misfit_of_others_as_it_is():
    misfit = Misfit(Counted(lambda x, y: front(x, y) / 8), 1 / 40)
    draft = Draft.of(misfit, delaunay(lattice(3, 3) / 3))
    other = draft.measured(4).measured_finely(2)
    assert (other.misfit.squarings, other.misfit.spacing) == (4, 1 / 80) and other.misfit.unit < 1
    assert draft.misfit is misfit and misfit == Misfit(misfit.function, 1 / 40)
    assert np.array_equal(draft.error_of(draft.elements), draft.errors)


def test_the_history_tells_every_step():
    found = approximate(front, nodes=100)
    last = found.history[-1]
    assert (last["nodes"], last["elements"], last["error"]) == (100, found.mesh.n_elements, found.error)
    assert last["evaluations"] == found.evaluations
    assert (np.diff(found.history["evaluations"]) > 0).all()
    assert np.allclose(
        found.interpolant(*found.mesh.nodes.T), front(*found.mesh.nodes.T), rtol=1e-12, atol=1e-12
    )


# -- how good it is -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "function, limit, most",
    [
        (FRANKE, 0.97625, 1.0),
        (lambda x, y: x**2 + y**2, 0.59628, 1.1),
        (lambda x, y: x**2 - y**2, 0.21082, 1.14),
    ],
)
def test_the_error_is_near_the_limit(function, limit, most):
    """Error times elements over B: 1 is what no mesh of very many elements is much below."""
    found = approximate(function, nodes=300)
    error = found.interpolant.l2_error(function, rule="exact", degree=12)
    assert 0.85 < error * found.mesh.n_elements / limit < most


@pytest.mark.parametrize("name, strips", [("SR1", 0.0966), ("SR2", 0.4347)])
def test_a_function_of_one_direction_gets_three_quarters_of_the_error_of_strips(name, strips):
    """Parallel strips give the constant over the square of their number, here 199."""
    found = approximate(problems.functions[name], nodes=400)
    assert found.mesh.validate().boundary_nodes.all()
    assert found.error / (strips / 199**2) == pytest.approx(0.75, abs=0.01)


def test_nodes_in_turn_in_figures():
    """Errors of u = x^2 are as the roots of 54 and 96, of sum d^2 + (sum d)^2.

    Elements over two spacings h have d = 2 (h^2, h^2, 4 h^2), those of strips d = 2 (0, 4h^2, 4h^2).
    """

    def u(x, y):
        return x**2

    mesh = in_turn(u, np.zeros(2), np.ones(2), 402, 2, OneDirection())
    error = Interpolant(mesh, u).l2_error(u, rule="exact")
    assert error / (2 * np.sqrt(6 / 720) / 200**2) == pytest.approx(0.75, rel=0.02)


@pytest.mark.parametrize("direction", [(1, 0), (0, -1), (1, 1), (-1, 2), (3, 1)])
@pytest.mark.parametrize("low, high", [((0, 0), (1, 1)), ((-1, 2), (3, 2.5))])
@pytest.mark.parametrize("nodes", [12, 13, 60])
def test_nodes_in_turn_in_any_direction_and_rectangle(direction, low, high, nodes):
    low, high = np.array(low, float), np.array(high, float)
    mesh = in_turn(
        lambda x, y: np.cos(direction[0] * x + direction[1] * y), low, high, nodes, 2, OneDirection()
    )
    assert mesh.validate().counts == (nodes, 2 * nodes - 3, nodes - 2)
    assert mesh.domain_area == pytest.approx(np.prod(high - low))


@pytest.mark.parametrize("function", [front, lambda x, y: x + 2 * y, lambda x, y: 0 * x, lambda x, y: x * y])
def test_other_functions_and_planes_get_no_such_mesh(function):
    assert in_turn(function, np.zeros(2), np.ones(2), 50, 2, OneDirection()) is None


@pytest.mark.parametrize("nodes", [155, 160, 165])
def test_a_little_more_or_fewer_nodes_make_little_difference(nodes):
    """The limit of this function is B = 3.53."""

    def circle(x, y):
        return np.tanh(20 * (np.hypot(x - 0.5, y - 0.5) - 0.3))

    found = approximate(circle, nodes=nodes)
    assert 0.9 < found.error * found.mesh.n_elements / 3.53 < 1.1


@pytest.mark.parametrize("function", [front, FRANKE, problems.functions["SR2"]])
def test_the_largest_error_is_lower_where_it_is_asked_for(function):
    mean, largest = (approximate(function, nodes=100, norm=norm) for norm in ("L2", "max"))
    x, y = np.meshgrid(*[np.linspace(0, 1, 2001)] * 2)
    worst = [np.abs(found.interpolant(x, y) - function(x, y)).max() for found in (mean, largest)]
    assert worst[1] < 0.95 * worst[0]
    assert largest.error == pytest.approx(worst[1], rel=0.03)
    assert largest.history["error"][-1] == largest.error and largest.mesh.validate().n_nodes == 100


def test_the_largest_error_of_a_function_of_one_direction_is_lower_where_it_is_asked_for():
    mean, largest = (approximate(problems.functions["SR2"], nodes=60, norm=norm) for norm in ("L2", "max"))
    x, y = np.meshgrid(*[np.linspace(0, 1, 801)] * 2)
    worst = [
        np.abs(found.interpolant(x, y) - problems.functions["SR2"](x, y)).max() for found in (mean, largest)
    ]
    assert worst[1] < 0.9 * worst[0] and largest.error == pytest.approx(worst[1], rel=0.03)


@pytest.mark.parametrize("factor", [2.0**-80, 2.0**80])
def test_the_largest_error_of_large_and_small_functions(factor):
    """Its sixteenth power is no number any more."""
    ones, others = (approximate(lambda x, y, f=f: f * front(x, y), nodes=60, norm="max") for f in (1, factor))
    assert others.mesh.equals(ones.mesh) and others.error == factor * ones.error
    assert np.array_equal(others.values, factor * ones.values)


@pytest.mark.parametrize("norm, error", [("L2", 0.21082 / 162), ("max", 1 / 324)])
def test_of_a_saddle_no_mesh_is_better_than_a_lattice(norm, error):
    """With spacings h, x^2 - y^2 has an L2 error of h^2 / sqrt(90), the limit, and a largest of h^2 / 4."""
    found = approximate(problems.functions["hyperbolic"], nodes=100, norm=norm)
    assert found.mesh.validate().counts == (100, 261, 162)
    assert found.error == pytest.approx(error, rel=1e-4)
    assert "compared" in found.history["step"]


@pytest.mark.parametrize("function", [front, problems.functions["DD1"]])
def test_the_error_is_confirmed_by_another_quadrature(function):
    """On elements divided until their part has settled; DD1 has kinks."""
    found = approximate(function, nodes=100)
    assert found.error == pytest.approx(settled_error(found.mesh, function), rel=1e-3)
    assert found.history["step"][-1] == "measured"


def test_a_lattice_with_smaller_angles_than_allowed_is_not_taken():
    """Of cells twice as high as wide it would have angles of 26.6 degrees."""
    assert regular(((0, 0), (1, 4)), 6).counts == (6, 9, 4)
    found = approximate(lambda x, y: 4 * x * x - y * y, nodes=6, domain=((0, 0), (1, 4)), min_angle=30)
    assert "compared" not in found.history["step"]
    assert (
        "compared"
        in approximate(lambda x, y: 4 * x * x - y * y, nodes=6, domain=((0, 0), (1, 4))).history["step"]
    )


def test_a_lattice_fits_its_rectangle():
    assert regular(((0, 0), (4, 1)), 100).counts[0] == 100
    assert regular(((0, 0), (1, 4)), 7).counts[0] == 6
    assert regular(((0, 0), (1, 1)), 3) is None


@given(st.integers(0, 2**32 - 1))
def test_divided_elements_are_a_valid_mesh_with_a_smaller_error(seed):
    """Of a convex function every part lies between its chord and its graph."""
    rng = np.random.default_rng(seed)
    draft = draft_of(lambda x, y: np.exp(x + y), delaunay(scattered(rng, 12)))
    nodes, edges, before = draft.n_nodes, draft.mesh.n_edges, draft.error
    draft = divided(draft)
    assert nodes < draft.mesh.validate().n_nodes <= nodes + edges
    assert draft.error < before and draft.mesh.domain_area == pytest.approx(1)
    assert np.array_equal(draft.side != INTERIOR, draft.mesh.boundary_nodes)


def test_a_mesh_without_an_error_is_not_divided_but_once(rng):
    """Elements whose error is little beside the mean stay whole: here those where u = 0."""
    mesh = delaunay(lattice(8, 8) / 8)
    draft = draft_of(lambda x, y: np.maximum(x - 0.5, 0) ** 2, mesh)
    flat = mesh.nodes[mesh.elements].max(axis=1)[:, 0] <= 0.5
    draft = divided(draft)
    left = draft.mesh.nodes[draft.mesh.elements].max(axis=1)[:, 0] <= 0.5
    assert flat.sum() == 64 and 64 <= left.sum() <= 64 + 8 * 4 and draft.mesh.n_elements > 256


# -- parts ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("level, halvings", [(0, 0), (1, 0), (0, 2), (2, 1)])
def test_the_rule_is_exact_to_degree_six_or_on_parts_to_four(level, halvings):
    """The integral of p^i q^j r^k over an element of area 1 is 2 i! j! k! / (i + j + k + 2)!."""
    points, weights = rule(level, halvings)
    degree, each = (4, 6) if level + halvings else (6, 12)
    assert len(weights) == each * 4**level * 2**halvings and (weights > 0).all()
    assert weights.sum() == pytest.approx(1) and np.allclose(points.sum(axis=1), 1)
    factorial = np.cumprod([1, *range(1, 9)])
    for i, j in ((degree, 0), (3, 1), (2, 2), (1, 3), (0, 4)):
        k = degree - i - j
        exact = 2 * factorial[i] * factorial[j] * factorial[k] / factorial[degree + 2]
        assert weights @ (points[:, 0] ** i * points[:, 1] ** j * points[:, 2] ** k) == pytest.approx(exact)


def test_features_between_the_nodes_are_seen():
    """A bump of a fiftieth of the square is not missed by two elements."""

    def bump(x, y):
        return np.exp(-((x - 0.61) ** 2 + (y - 0.37) ** 2) / 0.02**2)

    error = Misfit(Counted(bump), 1 / 40).on_elements(
        np.array([[[0.0, 0], [1, 0], [1, 1]]]), np.zeros((1, 3))
    )
    assert error[0] == pytest.approx(np.pi * 0.02**2 / 2, rel=0.01)


@given(
    st.lists(st.tuples(st.floats(-1, 1), st.lists(st.integers(-1, 5), min_size=1, max_size=3)), max_size=12)
)
def test_chosen_changes_share_nothing_and_the_best_is_among_them(candidates):
    gain = np.array([g for g, _ in candidates])
    rows = np.repeat(np.arange(len(candidates)), [len(i) for _, i in candidates])
    items = np.array([i for _, some in candidates for i in some], dtype=int)
    chosen = independent(gain, rows, items, 6)
    touched = [i for c in chosen for i in set(candidates[c][1]) - {-1}]
    assert len(touched) == len(set(touched))
    assert not len(candidates) or gain.argmax() in chosen
    assert list(gain[chosen]) == sorted(gain[chosen], reverse=True)


def test_sides_of_a_domain_with_a_hole(ring):
    sides = sides_of(ring)
    assert len(sides.ends) == 8
    for pair in ([1, 2], [4, 8], [7, 11], [13, 14]):  # the two inner nodes of each outer side, in the lattice
        assert len({*sides.of_node[pair]}) == 1 and sides.of_node[pair[0]] >= 0
    assert (sides.of_node[[0, 3, 12, 15, 5, 6, 9, 10]] == CORNER).all()
    assert (sides_of(delaunay(lattice(2, 2))).of_node == INTERIOR).sum() == 1


# -- settings --------------------------------------------------------------------------------------


def test_settings_cannot_be_changed_and_each_has_its_meaning_beside_it():
    with pytest.raises(FrozenInstanceError):
        Settings().moves.probe = 1
    lines = inspect.getsource(settings).splitlines()
    numbers = [line for line in lines if re.match(r"    \w+: (int|float|tuple)", line)]
    assert len(numbers) == sum(len(fields(section.default)) for section in fields(Settings))
    assert all(re.search(r"  # \w+.{10}", line) for line in numbers)


def test_every_setting_is_read_somewhere():
    package = Path(settings.__file__).parent
    code = "".join(file.read_text() for file in package.glob("*.py") if file.name != "settings.py")
    names = {number.name for section in fields(Settings) for number in fields(section.default)}
    assert {name for name in names if not re.search(rf"\.{name}\b", code)} == set()


def test_settings_reach_the_mesh():
    task = Task(front, UNIT_SQUARE, 0.0, "L2", 0, False)
    assert task.with_nodes(40).mesh.equals(approximate(front, nodes=40).mesh)
    still = replace(task, settings=Settings(rounds=Rounds(main=0, early=0, last_moves=0)))
    steps = still.with_nodes(40).history["step"].tolist()
    assert steps == ["grown", "moved"] * 2 + ["compared", "measured"]


# -- bad input, interrupts -------------------------------------------------------------------------


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"nodes": 2}, "range: nodes is 2; give a whole number of at least 3"),
        ({"nodes": 3}, "nodes: 3 nodes are too few for this domain, 4 are left; give more"),
        (
            {"domain": ((0, 0), (0, 1))},
            "domain: the rectangle from [0.0, 0.0] to [0.0, 1.0] has no area or is too long; "
            "give the lower left and the upper right corner",
        ),
        (
            {"domain": "square"},
            "domain: the domain is 'square'; give the lower left and the upper right corner "
            "of a rectangle, or a mesh",
        ),
        ({"min_angle": 40}, "range: min_angle is 40; give degrees from 0 to 30"),
        ({"norm": "L1"}, "unknown: norm 'L1' is not known"),
        ({"seed": -1}, "range: seed is -1; give a whole number of at least 0"),
        ({"function": lambda x, y: x[:1]}, "shape: the function returned shape"),
        ({"function": lambda x, y: x + 1j}, "dtype complex128 for points"),
        ({"function": lambda x, y: np.where(x > 0.9, np.nan, x)}, "it must be finite in the whole domain"),
    ],
)
def test_bad_input_is_named(arguments, message):
    with pytest.raises(MeshError) as error:
        approximate(**({"function": front, "nodes": 20} | arguments))
    assert message in str(error.value)


def test_an_interrupt_keeps_the_mesh(monkeypatch):
    def report(watch, done):
        if done == 3:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("meshlib.support.progress.Watch.report", report)
    with pytest.raises(Interrupted) as stop:
        approximate(front, nodes=100)
    found = stop.value.result
    assert len(found.history) == 3 and found.mesh.validate().n_nodes >= 16
    assert np.array_equal(found.values, front(*found.mesh.nodes.T))


# -- a tolerance, and samples ----------------------------------------------------------------


@pytest.mark.parametrize("tolerance", [1e-2, 2e-3])
def test_a_tolerance_is_reached_and_three_per_cent_fewer_nodes_miss_it(tolerance):
    found = approximate(FRANKE, tolerance=tolerance)
    assert found.error <= tolerance
    assert approximate(FRANKE, nodes=int(found.mesh.n_nodes / 1.03) - 1).error > tolerance
    assert found.evaluations > approximate(FRANKE, nodes=found.mesh.n_nodes).evaluations


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("enough", [5, 31, 777, 65_000])
def test_the_least_number_is_found_whatever_the_order_of_convergence(order, enough):
    tried = []

    def trial(nodes):
        tried.append(nodes)
        return SimpleNamespace(nodes=nodes, error=nodes**-order)

    found = node_count.least(trial, enough**-order * (1 + 1e-12), 4, NodeCount())
    assert enough <= found.nodes <= max(enough, 1.02 * enough)
    assert len(tried) <= 15


def test_a_tolerance_out_of_reach_is_told():
    assert node_count.least(lambda nodes: SimpleNamespace(error=1.0), 0.5, 4, NodeCount(most=1000)) is None


def test_samples_on_a_grid_are_bilinear_between():
    x, y = np.meshgrid(np.linspace(2, 6, 9), np.linspace(1, 3, 5))
    between = samples.Samples(3 * x - y + x * y, (2, 1), (6, 3))
    p, q = 2 + 4 * np.random.default_rng(1).random(50), 1 + 2 * np.random.default_rng(2).random(50)
    assert between(p, q) == pytest.approx(3 * p - q + p * q)


def test_samples_give_the_mesh_of_their_function():
    ticks = np.linspace(0, 1, 401)
    found, exact = approximate(front(*np.meshgrid(ticks, ticks)), nodes=100), approximate(front, nodes=100)
    found.mesh.validate()
    assert found.error == pytest.approx(exact.error, rel=0.1)
    assert found.values == pytest.approx(front(*found.mesh.nodes.T), abs=2e-3)


@pytest.mark.parametrize(
    "function, options, message",
    [
        (front, {}, "nodes: nodes is None and tolerance is None; give one of them"),
        (
            front,
            {"nodes": 9, "tolerance": 1.0},
            "nodes: nodes is 9 and tolerance is 1.0; give one of them",
        ),
        (front, {"tolerance": 0}, "tolerance: the tolerance is 0; give a number above 0"),
        ([[1, 2], [np.nan, 4]], {"nodes": 9}, "finite: sample (1, 0) is nan; fill it in or cut it off"),
        (
            [1, 2],
            {"nodes": 9},
            "samples: samples have shape (2,) and dtype int64; give real numbers in at least 2 rows "
            "and 2 columns",
        ),
    ],
)
def test_what_cannot_be_asked(function, options, message):
    with pytest.raises(MeshError) as caught:
        approximate(function, **options)
    assert str(caught.value) == message


# -- what moves go by ------------------------------------------------------------------------


@pytest.mark.parametrize("squarings", [1, 4])
def test_the_slope_of_the_error_of_a_patch_is_its_derivative(squarings, rng):
    draft = draft_of(FRANKE, delaunay(scattered(rng, 200)))
    draft = draft.measured(squarings)
    sweep = _Sweep(draft)
    nodes = next(sweep.classes())
    nodes = nodes[draft.side[nodes] == INTERIOR]
    patches = sweep._patches(nodes)
    frames = 1e-3 * patches.frames(*sweep.around.of(nodes))
    slope, _ = patches.model(frames)
    for k in range(2):
        ahead, behind = (
            patches.moved(at, draft.misfit.values(*at.T.copy()))[0]
            for at in (draft.nodes[nodes] + frames[:, k], draft.nodes[nodes] - frames[:, k])
        )
        assert (ahead - behind) / 2 == pytest.approx(slope[:, k], rel=1e-2, abs=1e-3 * abs(slope[:, k]).max())


@pytest.mark.parametrize("squarings, power", [(1, 2), (2, 4), (4, 16)])
def test_powers_by_multiplication(squarings, power):
    miss = np.linspace(-2, 2, 9)
    assert powers(miss, squarings) == pytest.approx(miss**power)
    assert half_slopes(miss, squarings) == pytest.approx(power / 2 * miss ** (power - 1))


def test_the_curvature_is_that_of_a_quadratic_function():
    y, z, hessian = np.array([[1.0, 0.2]]), np.array([[0.3, 0.9]]), np.array([[[2.0, 0.5], [0.5, -1.0]]])

    def error(p):
        edges = np.array([y[0] - p, z[0] - p, z[0] - y[0]])
        d = np.einsum("ni,ij,nj->n", edges, hessian[0], edges)
        area = abs((edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]) / 2)
        return area / 720 * ((d**2).sum() + d.sum() ** 2)

    h, units = 1e-3, np.eye(2)
    expected = [
        [
            (error(h * (a + b)) - error(h * (a - b)) - error(h * (b - a)) + error(-h * (a + b))) / (4 * h * h)
            for b in units
        ]
        for a in units
    ]
    assert _curvature(y, z, hessian)[0] == pytest.approx(np.array(expected), rel=1e-4)
