"""Marking and splitting: counts, ties, closure, and angles over repeated calls."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import as_set, lattice

from meshlib import Interpolant, Mesh, MeshError, criteria, delaunay, problems, refined
from meshlib.mesh.quality import angles
from meshlib.refinement.marking import MARKS, TIES, averaged, marked
from meshlib.refinement.splitting import SPLITS


def smallest_angle(mesh):
    return float(np.degrees(angles(mesh.corners).min()))


def at(mesh, x, y):
    """A criterion that marks the element at a point, and nothing else."""
    from meshlib.interpolation.locate_by_buckets import located

    here = located(mesh, np.array([[x, y]]))[0]
    return criteria.Criterion("here", "element", lambda a, b, c: (np.arange(mesh.n_elements) == here) * 1.0)


def refine_at(mesh, x, y, split="red-green"):
    return refined(mesh, np.zeros(mesh.n_nodes), at(mesh, x, y), fraction=1e-6, split=split).mesh


# -- counts ---------------------------------------------------------------------------------


def test_red_refinement_of_everything(start, frame):
    """N' = N + E, T' = 4 T, and E' = 2 E + 3 T."""
    for mesh in (start, frame):
        n, e, t = mesh.counts
        new = refined(mesh, np.zeros(n), fraction=1).mesh
        assert new.validate().counts == (n + e, 2 * e + 3 * t, 4 * t)
        assert len(new.green) == 0
        assert new.domain_area == pytest.approx(mesh.domain_area)


@pytest.mark.parametrize("fraction", [0, 0.01, 0.2, 0.5, 1])
@pytest.mark.parametrize("mark", MARKS)
def test_centroids(mark, fraction):
    """R new nodes, 2 R more elements, 3 R more edges."""
    mesh, u = problems.mesh("33"), problems.functions["SR1"]
    result = refined(mesh, u, "abn", fraction=fraction, mark=mark, split="centroid")
    r = len(result.marked)
    n, e, t = mesh.counts
    assert result.mesh.validate().counts == (n + r, e + 3 * r, t + 2 * r)
    assert r >= np.ceil(fraction * t)


def test_one_red_element_and_its_green_neighbours():
    """On a lattice an inner element has three neighbours: 4 + 3*2 in place of 4, three new nodes."""
    mesh = delaunay(lattice(4, 4))
    new = refine_at(mesh, 1.7, 1.4)
    assert new.validate().counts == (25 + 3, 56 + 9, 32 + 6)
    assert len(new.green) == 3 and len(np.unique(new.green)) == 6


def test_a_boundary_element_leaves_no_hanging_node_outside():
    mesh = delaunay([[0, 0], [1, 0], [0, 1]])
    new = refine_at(mesh, 0.2, 0.2)
    assert new.counts == (6, 9, 4) and len(new.green) == 0


def test_an_element_with_two_hanging_nodes_turns_red():
    """Two of the three neighbours of the middle of four elements are marked: all but one turn red."""
    nodes = [[0, 0], [2, 0], [4, 0], [1, 2], [3, 2], [2, 4]]
    mesh = Mesh(nodes, [[0, 1, 3], [1, 2, 4], [3, 4, 5], [1, 4, 3]])
    two = criteria.Criterion("two", "element", lambda a, b, c: np.array([1.0, 1.0, 0.0, 0.0]))
    new = refined(mesh, np.zeros(6), two, fraction=0.5).mesh.validate()
    assert new.n_elements == 4 + 4 + 4 + 2 and len(new.green) == 1


@pytest.mark.parametrize("split", SPLITS)
@pytest.mark.parametrize("mark", MARKS)
def test_fraction_zero_changes_nothing(split, mark):
    mesh, u = problems.mesh("33"), problems.functions["SR1"]
    result = refined(mesh, u, "abn", fraction=0, mark=mark, split=split)
    assert result.mesh.equals(mesh) and len(result.marked) == 0
    assert np.array_equal(result.parents, np.arange(mesh.n_elements))


@pytest.mark.parametrize("mark", MARKS)
def test_fraction_one_marks_everything(mark, start):
    assert np.array_equal(
        marked(start, problems.functions["SR1"], fraction=1, mark=mark), np.arange(start.n_elements)
    )


@pytest.mark.parametrize(
    "fraction, number", [(0.1, 5), (0.101, 6), (1e-6, 1), (0.14, 7), (0.28, 14), (0.98, 49)]
)
def test_the_share_is_rounded_up_but_not_by_rounding_errors(fraction, number):
    """0.14 * 50 is 7, though floats say 7.000000000000001."""
    assert 0.14 * 50 > 7 and 0.28 * 50 > 14
    mesh = delaunay(lattice(5, 5))
    assert mesh.n_elements == 50
    by_number = criteria.Criterion("number", "element", lambda a, b, c: np.arange(50.0))
    chosen = marked(mesh, np.zeros(36), by_number, fraction=fraction)
    assert chosen.tolist() == list(range(50 - number, 50))


# -- marking -----------------------------------------------------------------------------------


def test_ties(square):
    mesh = delaunay(lattice(2, 1))
    assert mesh.n_elements == 4
    flat = criteria.Criterion("flat", "element", lambda a, b, c: np.array([1.0, 2.0, 1.0, 1.0]))

    def of(**arguments):
        return marked(mesh, np.zeros(6), flat, **arguments).tolist()

    assert of(fraction=0.25) == [1]
    assert of(fraction=0.5) == [0, 1]
    assert of(fraction=0.5, ties="all") == [0, 1, 2, 3]
    assert of(fraction=0.25, ties="all") == [1]
    assert of(fraction=0.5, order=[3, 2, 1, 0]) == [1, 3]
    assert of(fraction=0.75, order=[2, 0, 1, 3]) == [0, 1, 2]


def test_costs_that_differ_by_rounding_tie():
    mesh = delaunay(lattice(2, 1))
    noisy = criteria.Criterion("noisy", "element", lambda a, b, c: 1 + 1e-15 * np.arange(4))
    assert marked(mesh, np.zeros(6), noisy, fraction=0.5).tolist() == [0, 1]
    clear = criteria.Criterion("clear", "element", lambda a, b, c: 1 + 1e-6 * np.arange(4))
    assert marked(mesh, np.zeros(6), clear, fraction=0.5).tolist() == [2, 3]


def test_by_edge_marks_both_elements_of_the_worst_edges(square):
    mesh = delaunay(lattice(2, 1))
    inner = np.flatnonzero(~mesh.boundary)
    cost = criteria.Criterion("edge", "edge", lambda p, q, left, right: np.array([1.0, 3.0, 2.0]))
    worst = mesh.edge_elements[inner[1]]
    assert marked(mesh, np.zeros(6), cost, fraction=0.25, mark="edge").tolist() == sorted(worst)
    assert marked(mesh, np.zeros(6), cost, fraction=0.5, mark="edge").tolist() == sorted(worst)
    both = set(worst) | set(mesh.edge_elements[inner[2]])
    assert marked(mesh, np.zeros(6), cost, fraction=0.51, mark="edge").tolist() == sorted(both)


def test_by_node_marks_the_patch():
    mesh = delaunay(lattice(2, 2))
    cost = criteria.Criterion("node", "node", lambda u_h: np.arange(9) == 4)
    assert (
        marked(mesh, np.zeros(9), cost, fraction=1e-6, mark="node").tolist()
        == np.flatnonzero((mesh.elements == 4).any(axis=1)).tolist()
    )


def test_density_divides_by_the_area():
    nodes = [[0, 0], [1, 0], [1, 1], [0, 1], [9, 0]]
    mesh = Mesh(nodes, [[0, 1, 2], [0, 2, 3], [1, 4, 2]])
    cost = criteria.Criterion(
        "cost", "element", lambda a, b, c: np.array([1.0, 2.0, 3.0])
    )  # areas 1/2, 1/2, 4
    assert marked(mesh, np.zeros(5), cost, fraction=0.3).tolist() == [2]
    assert marked(mesh, np.zeros(5), cost, fraction=0.3, mark="density").tolist() == [1]


def test_averages_by_hand(square):
    """Edges 01, 02, 03, 12, 23; elements 012, 023."""
    edge = np.array([1.0, 2, 3, 4, 5])
    assert averaged(square, edge, "edge", "element") == pytest.approx([7 / 3, 10 / 3])
    assert averaged(square, edge, "edge", "node") == pytest.approx([2, 2.5, 11 / 3, 4])
    assert averaged(square, np.array([1.0, 2]), "element", "edge") == pytest.approx([1, 1.5, 2, 1, 2])
    assert averaged(square, np.array([1.0, 2]), "element", "node") == pytest.approx([1.5, 1, 1.5, 2])
    assert averaged(square, np.array([1.0, 2, 3, 4]), "node", "element") == pytest.approx([2, 8 / 3])
    assert averaged(square, np.array([1.0, 2, 3, 4]), "node", "edge") == pytest.approx(
        [1.5, 2, 2.5, 2.5, 3.5]
    )


# -- values and parents --------------------------------------------------------------------------


@pytest.mark.parametrize("split", SPLITS)
def test_means_leave_the_interpolant_as_it_was(split, rng):
    mesh = problems.mesh("33")
    values = rng.standard_normal(33)
    result = refined(mesh, values, "abn", fraction=0.4, split=split)
    x, y = rng.random((2, 500))
    old, new = Interpolant(mesh, values), Interpolant(result.mesh, result.values)
    assert np.abs(old(x, y) - new(x, y)).max() < 1e-12
    assert np.array_equal(result.mesh.nodes[:33], mesh.nodes)
    assert np.allclose(np.bincount(result.parents, result.mesh.areas, mesh.n_elements), mesh.areas)


def test_a_function_is_evaluated_at_the_new_nodes():
    u = problems.functions["SR3"]
    result = refined(problems.mesh("33"), u, "abn")
    assert np.array_equal(result.values, u(*result.mesh.nodes.T))
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.values = None


# -- over repeated calls ------------------------------------------------------------------------


def bisections(mesh):
    """The six halves of every element, each cut from a node to the middle of its edge."""
    halves = []
    for k in range(3):
        a, b, c = (mesh.corners[:, (k + i) % 3] for i in range(3))
        halves += [np.stack([a, b, (b + c) / 2], axis=1), np.stack([a, (b + c) / 2, c], axis=1)]
    return np.concatenate(halves)


@pytest.mark.parametrize("function", ["SR1", "DD1"])
@pytest.mark.parametrize("name", ["33", "81"])
def test_red_green_angles_do_not_deteriorate(name, function):
    """Every element is similar to one of the start mesh or to a bisection of one."""
    mesh = first = problems.mesh(name)
    bound = float(np.degrees(angles(bisections(first)).min()))
    for _ in range(6):
        mesh = refined(mesh, problems.functions[function], "abn", fraction=0.1).mesh.validate()
        assert smallest_angle(mesh) >= min(smallest_angle(first), bound) - 1e-7
    assert len(mesh.green) > 0


def test_green_pairs_are_taken_back_before_they_are_refined():
    """Refining at one point for ever: the point's element is always similar to the first."""
    mesh = delaunay(lattice(2, 2))
    for _ in range(8):
        mesh = refine_at(mesh, 0.9, 0.3).validate()
        shapes = np.sort(np.degrees(angles(mesh.corners)), axis=1)
        green = np.zeros(mesh.n_elements, dtype=bool)
        green[mesh.green] = True
        assert np.allclose(shapes[~green], [45, 45, 90])
        assert (shapes.min(axis=1) > 18).all()  # atan(1/3) = 18.43


@pytest.mark.parametrize("half", [0, 1])
def test_a_green_pair_stays_or_turns_red(half):
    """Red if either half is marked."""
    mesh = delaunay(lattice(4, 4))
    once = refine_at(mesh, 1.7, 1.4)
    again = refined(once, np.zeros(once.n_nodes), "abn", fraction=0)
    assert as_set(again.mesh) == as_set(once)
    pair = once.green[0]
    x, y = once.corners[pair[half]].mean(axis=0)
    red = refine_at(once, x, y).validate()
    parent = {tuple(sorted(t)) for t in once.elements[pair].tolist()}
    assert not parent & as_set(red)  # neither half is left, whole or in parts
    middle = once.elements[pair[0], 0]
    assert (red.elements == middle).any()


@pytest.mark.parametrize("name", ["33", "81"])
@pytest.mark.parametrize("fraction", [0.1, 1])
def test_longest_edge_bisection_keeps_half_of_the_smallest_angle(name, fraction):
    """Rosenberg & Stenger 1975."""
    mesh = first = problems.mesh(name)
    for _ in range(4 if fraction == 1 else 8):
        mesh = refined(mesh, problems.functions["SR3"], "abn", fraction=fraction, split="longest-edge").mesh
        assert smallest_angle(mesh) >= smallest_angle(first) / 2 - 1e-9
    mesh.validate()


@settings(max_examples=80)
@given(
    problems_of(most=10, scales=(1.0, 0.1, 1e6)),
    st.lists(
        st.tuples(
            st.sampled_from(criteria.names()),
            st.sampled_from((0.05, 0.3, 0.7, 1.0)),
            st.sampled_from(MARKS),
            st.sampled_from(sorted(SPLITS)),
            st.sampled_from(TIES),
        ),
        min_size=1,
        max_size=4,
    ),
)
def test_any_sequence_of_refinements_is_valid(problem, steps):
    mesh, values = problem
    area = mesh.domain_area
    for name, fraction, mark, split, ties in steps:
        before = mesh.nodes.copy(), mesh.elements.copy()
        result = refined(mesh, values, name, fraction=fraction, mark=mark, split=split, ties=ties)
        assert np.array_equal(mesh.nodes, before[0]) and np.array_equal(mesh.elements, before[1])
        mesh, values = result.mesh.validate(), result.values
        assert mesh.domain_area == pytest.approx(area)


@pytest.mark.parametrize("split", SPLITS)
def test_a_hole_stays_a_hole(frame, split, rng):
    new = refined(frame, rng.standard_normal(16), "abn", fraction=0.3, split=split).mesh.validate()
    n, e, t = new.counts
    assert n - e + t == 0  # Euler, one hole
    assert new.domain_area == pytest.approx(8)


@pytest.mark.parametrize("split", SPLITS)
def test_an_element_too_thin_for_a_middle_is_refused(split):
    """Its nodes are one ulp apart, so that no number is left between them."""
    x = 1.0 + 2.0**-52
    mesh = Mesh([[1, 1], [x, 1], [1, np.nextafter(1.0, 2)]], [[0, 1, 2]]).validate()
    with pytest.raises(MeshError) as error:
        refined(mesh, [0, 0, 1], fraction=1, split=split)
    assert str(error.value) == "degenerate: element 0 is too thin to be split; move one of its nodes"


def test_costs_that_are_not_finite_are_named(square):
    bad = criteria.Criterion("bad", "element", lambda a, b, c: np.array([0.0, np.nan]))
    with pytest.raises(MeshError) as error:
        marked(square, np.zeros(4), bad, fraction=0.5)
    assert str(error.value) == (
        "cost: the cost of element 1 is nan; a criterion must return finite numbers of at least 0"
    )
