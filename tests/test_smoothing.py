"""Node movement: equilibria that are known, and moves that must be refused."""
import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshlib import Mesh, delaunay, problems, refined, smoothed
from strategies import meshes
from support import lattice


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
    result = smoothed(mesh, springs, tolerance=1e-13)
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
    result = smoothed(mesh, springs, sweeps=sweeps)
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
        mesh = refined(mesh, rng.standard_normal(mesh.n_nodes), fraction=0.2).mesh.validate()
        mesh = smoothed(mesh, rng.choice([0.01, 1.0, 100.0], mesh.n_edges), sweeps=3).mesh.validate()


def test_green_pairs_at_rest_are_remembered():
    mesh = refined(problems.mesh("81"), problems.functions["SR1"], fraction=0.1).mesh
    assert len(smoothed(mesh, np.zeros(mesh.n_edges)).mesh.green) == len(mesh.green) > 0


def test_nothing_inside_nothing_moves(square):
    result = smoothed(square)
    assert result.mesh.equals(square) and (result.sweeps, result.movement) == (1, 0)
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.sweeps = 2


@pytest.mark.parametrize("shift, scale", [(0, 2.0 ** -30), (2.0 ** 20, 1)])
def test_place_and_size_do_not_matter(shift, scale, rng):
    mesh = delaunay(rng.integers(0, 100, (30, 2)))
    moved = smoothed(Mesh(mesh.nodes * scale + shift, mesh.elements)).mesh.nodes
    assert np.allclose((moved - shift) / scale, smoothed(mesh).mesh.nodes, atol=1e-5)
