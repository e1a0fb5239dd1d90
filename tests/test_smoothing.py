"""Node movement: equilibria that are known, and moves that must be refused."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import meshes
from support import lattice

from meshlib import DataSprings, Mesh, MeshError, delaunay, problems, refined, smoothed


def wheel(n, centre):
    """n spokes on the unit circle around a hub that is off the centre."""
    turn = 2 * np.pi * np.arange(n) / n
    rim = np.column_stack([np.cos(turn), np.sin(turn)])
    return Mesh(np.vstack([rim, [centre]]), [[k, (k + 1) % n, n] for k in range(n)]).validate()


@pytest.mark.parametrize("n", [3, 4, 7])
def test_a_hub_moves_to_the_mean_of_the_rim(n):
    result = smoothed(wheel(n, (0.2, -0.1)))
    assert np.abs(result.mesh.nodes[n]).max() < 1e-12
    assert (result.sweeps, result.refused) == (2, 0)  # one to move, one to see that it rests
    assert np.array_equal(result.mesh.nodes[:n], wheel(n, (0, 0)).nodes[:n])


def test_a_stiff_spring_pulls():
    """Constants 3, 1, 1, 1 on the spokes to (1,0), (0,1), (-1,0), (0,-1): x = (3 - 1)/6."""
    mesh = wheel(4, (0, 0))
    springs = np.ones(mesh.n_edges)
    springs[mesh.edge_numbers([[0, 4]])] = 3
    assert smoothed(mesh, springs).mesh.nodes[4] == pytest.approx([1 / 3, 0], abs=1e-12)


def test_a_shaken_lattice_comes_to_rest_where_it_was(rng):
    """The lattice is the only equilibrium of equal springs with a fixed boundary."""
    rest = delaunay(lattice(5, 5))
    inner = ~rest.boundary_nodes[:, None]
    shaken = Mesh(rest.nodes + inner * rng.uniform(-0.15, 0.15, rest.nodes.shape), rest.elements).validate()
    result = smoothed(shaken)
    assert np.abs(result.mesh.nodes - rest.nodes).max() < 1e-6
    assert result.mesh.validate().counts == rest.counts


def test_at_rest_the_forces_balance(rng):
    mesh = delaunay(rng.random((40, 2)))
    springs = rng.uniform(0.5, 2, mesh.n_edges)
    result = smoothed(mesh, springs, min_movement=1e-13)
    assert result.refused == 0
    force = np.zeros((40, 2))
    p, q = mesh.edges.T
    pull = springs[:, None] * (result.mesh.nodes[q] - result.mesh.nodes[p])
    np.add.at(force, p, pull)
    np.add.at(force, q, -pull)
    assert np.abs(force[~mesh.boundary_nodes]).max() < 1e-10


@pytest.mark.parametrize("factor", [1e-300, 1e-3, 1e3, 1e307, 1.7e308])
def test_only_the_ratios_of_springs_matter(factor, rng):
    mesh = delaunay(rng.random((30, 2)))
    expected = smoothed(mesh).mesh.nodes
    assert np.allclose(smoothed(mesh, np.full(mesh.n_edges, factor)).mesh.nodes, expected, atol=1e-9)


def test_springs_of_zero_hold_nothing():
    mesh = wheel(5, (0.2, 0.1))
    result = smoothed(mesh, np.zeros(mesh.n_edges))
    assert result.mesh.equals(mesh) and result.movement == 0


def boomerang():
    """A concave patch whose mean of neighbours lies outside it."""
    nodes = [[0, 0], [4, -3], [1, 0], [4, 3], [0.5, 0]]
    return Mesh(nodes, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]).validate()


def test_a_move_that_would_tangle_is_refused():
    """The mean of the rim is (9/4, 0), beyond the notch at (1, 0)."""
    result = smoothed(boomerang())
    assert (result.sweeps, result.refused, result.movement) == (1, 1, 0)
    assert result.mesh.equals(boomerang())


def test_a_move_that_makes_a_small_element_is_refused():
    mesh = wheel(4, (0.5, 0))
    least = float(wheel(4, (0, 0)).areas.min())  # 1/2 at rest
    assert smoothed(mesh, min_area=least * 0.9).refused == 0
    assert smoothed(mesh, min_area=least * 1.1).refused == 1


@settings(max_examples=60)
@given(meshes(most=16), st.integers(0, 99), st.sampled_from((1, 2, 50)))
def test_valid_whatever_the_springs(mesh, seed, sweeps):
    before = mesh.nodes.copy()
    springs = np.random.default_rng(seed).choice([0.0, 1e-6, 1.0, 1e6], mesh.n_edges)
    result = smoothed(mesh, springs, max_sweeps=sweeps)
    result.mesh.validate()
    assert result.sweeps <= sweeps
    assert np.array_equal(result.mesh.elements, mesh.elements) and np.array_equal(mesh.nodes, before)
    fixed = mesh.boundary_nodes
    assert np.array_equal(result.mesh.nodes[fixed], mesh.nodes[fixed])


@settings(max_examples=60)
@given(meshes(most=10, scales=(1.0,)), st.integers(0, 99))
def test_moved_green_pairs_do_not_spoil_the_next_refinement(mesh, seed):
    rng = np.random.default_rng(seed)
    for _ in range(3):
        mesh = refined(mesh, rng.standard_normal(mesh.n_nodes), "abn", fraction=0.2).mesh.validate()
        mesh = smoothed(mesh, rng.choice([0.01, 1.0, 100.0], mesh.n_edges), max_sweeps=3).mesh.validate()


def test_green_pairs_at_rest_are_remembered():
    mesh = refined(problems.mesh("81"), problems.functions["SR1"], "abn", fraction=0.1).mesh
    assert len(smoothed(mesh, np.zeros(mesh.n_edges)).mesh.green) == len(mesh.green) > 0


def test_nothing_inside_nothing_moves(square):
    result = smoothed(square)
    assert result.mesh.equals(square) and (result.sweeps, result.movement) == (1, 0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.sweeps = 2


@pytest.mark.parametrize("shift, scale", [(0, 2.0**-30), (2.0**20, 1)])
def test_place_and_size_do_not_matter(shift, scale, rng):
    mesh = delaunay(rng.integers(0, 100, (30, 2)))
    moved = smoothed(Mesh(mesh.nodes * scale + shift, mesh.elements)).mesh.nodes
    assert np.allclose((moved - shift) / scale, smoothed(mesh).mesh.nodes, atol=1e-5)


# -- springs that follow the data ------------------------------------------------------------


@pytest.mark.parametrize("name", ["33", "81"])
def test_derivatives_of_a_quadratic_along_edges(name):
    """For u = x^2 an edge in the direction (c, s) has u_ss = 2 c^2, and u_s = c (x_p + x_q)."""
    mesh = problems.mesh(name)
    start, end = mesh.nodes[mesh.edges].transpose(1, 2, 0)
    cosine = (end - start)[0] / np.hypot(*(end - start))
    first, second, _ = DataSprings(lambda x, y: x**2).derivatives(mesh)
    assert np.allclose(second, 2 * cosine**2) and np.allclose(first, np.abs(cosine * (start + end)[0]))


def test_the_unit_of_the_data_does_not_matter():
    mesh, u = problems.mesh("33"), problems.SR2
    assert np.allclose(
        DataSprings(u, first=3, second=5)(mesh),
        DataSprings(lambda x, y: 7 - 1e6 * u(x, y), first=3, second=5)(mesh),
    )


def test_linear_data_give_laplacian_smoothing():
    mesh = problems.mesh("33")
    moved = smoothed(mesh, DataSprings(lambda x, y: x + 2 * y)).mesh
    assert np.allclose(moved.nodes, smoothed(mesh).mesh.nodes, atol=1e-6)


@settings(max_examples=30)
@given(
    meshes(most=14, scales=(1.0,)), st.booleans(), st.sampled_from((1, 3, 30)), st.sampled_from((0.4, 1, 3))
)
def test_valid_whatever_the_data(mesh, sliding, sweeps, power):
    u = lambda x, y: np.tanh(5 * (x - 2)) + np.sin(7 * y)  # noqa: E731
    moved = smoothed(
        mesh, DataSprings(u, first=1, second=100, power=power), max_sweeps=sweeps, sliding=sliding
    ).mesh.validate()
    assert np.array_equal(moved.elements, mesh.elements)
    assert moved.domain_area == pytest.approx(mesh.domain_area, rel=1e-12)


def test_nodes_slide_along_sides_and_corners_stay():
    mesh = problems.mesh("81")
    moved = smoothed(mesh, DataSprings(problems.SR3), sliding=True, min_movement=1e-4).mesh
    on_side = (mesh.nodes == 0) | (mesh.nodes == 1)
    assert np.array_equal(moved.nodes[on_side], mesh.nodes[on_side])
    shift = np.abs(moved.nodes - mesh.nodes).max(axis=1)
    assert shift[on_side.all(axis=1)].max() == 0 < shift[on_side.any(axis=1)].max()


def test_a_step_that_would_tangle_is_halved():
    """From (1/2, 0) towards (9/4, 0); the notch is at (1, 0): a quarter of the step is the first inside."""
    result = smoothed(boomerang(), halvings=2, max_sweeps=1)
    assert result.refused == 0 and result.mesh.validate().nodes[4] == pytest.approx([0.5 + 1.75 / 4, 0])
    assert smoothed(boomerang(), halvings=1, max_sweeps=1).refused == 1


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ({"function": 3}, "type: the function is 3; give u(x, y), for nodes move to where no value is known"),
        ({"function": len, "first": -1}, "range: first is -1; give a finite number of at least 0"),
        (
            {"function": len, "second": float("inf")},
            "range: second is inf; give a finite number of at least 0",
        ),
    ],
)
def test_bad_data_springs(arguments, expected):
    with pytest.raises(MeshError) as error:
        DataSprings(**arguments)
    assert str(error.value) == expected


def test_springs_are_asked_on_meshes_that_take_over_the_edges():
    """Moving changes no edge, so that none is derived again."""
    mesh, asked = problems.mesh("33"), []
    smoothed(mesh, lambda moved: asked.append(moved) or DataSprings(problems.SR3)(moved), max_sweeps=3)
    assert len(asked) == 4 and all(moved.edges is mesh.edges for moved in asked)
    assert all(np.array_equal(moved.edges, Mesh(moved.nodes, moved.elements).edges) for moved in asked)


def test_springs_of_the_wrong_shape_are_named_on_the_way():
    with pytest.raises(MeshError) as error:
        smoothed(problems.mesh("33"), lambda mesh: np.ones(3))
    assert str(error.value) == "shape: springs have shape (3,); give one constant for each of the 88 edges"


def test_data_that_are_not_finite_are_named():
    with pytest.raises(MeshError) as error:
        smoothed(problems.mesh("81"), DataSprings(lambda x, y: np.where(x == 0.5, np.nan, x)))
    assert (
        str(error.value) == "finite: the function is nan at (0.5, 0.0); it must be finite in the whole domain"
    )
