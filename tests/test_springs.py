"""Springs that follow the data: closed forms along an edge, valid meshes, and what they are for."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import lattice

from meshlib import DataSprings, Interpolant, MeshError, delaunay, problems, smoothed, swapped
from meshlib.mesh.boundary_sides import CORNER, sides_of


def test_derivatives_of_a_quadratic_function_are_exact():
    mesh = delaunay(lattice(2, 2))
    first, second, length = DataSprings(lambda x, y: x * x - 3 * y).derivatives(mesh)
    along = np.diff(mesh.nodes[mesh.edges], axis=1)[:, 0]
    middle = mesh.nodes[mesh.edges].mean(axis=1)
    assert length == pytest.approx(np.hypot(*along.T))
    assert first == pytest.approx(abs(2 * middle[:, 0] * along[:, 0] - 3 * along[:, 1]) / length)
    assert second == pytest.approx(2 * (along[:, 0] / length) ** 2)


@pytest.mark.parametrize("nodes", ["33", "81"])
@pytest.mark.parametrize("a, b, c", [(2, -3, 1), (1e6, 1, 7), (1 / 3, 0.1, 1e3), (0, 0, 5)])
def test_a_plane_has_equal_springs(nodes, a, b, c):
    """Though the second differences of most are not 0 but rounding, which has a mean as well."""
    mesh, plane = problems.mesh(nodes), DataSprings(lambda x, y: a * x + b * y + c)
    assert np.array_equal(plane(mesh), np.ones(mesh.n_edges))
    assert np.array_equal(plane.derivatives(mesh)[1], np.zeros(mesh.n_edges))


def test_a_plane_is_not_equally_steep_along_all_edges():
    """On 2 x 2 squares |u_s| of u = x is 1, 0, 1/sqrt 2 on 6, 6, 4 edges of lengths 1, 1, sqrt 2."""
    mesh = delaunay(lattice(2, 2))
    mean = (6 + 4) / (12 + 4 * np.sqrt(2))
    found, counts = np.unique(
        DataSprings(lambda x, y: x, first=1, second=0, power=1)(mesh).round(9), return_counts=True
    )
    assert found == pytest.approx([1, 1 + np.sqrt(0.5) / mean, 1 + 1 / mean]) and counts.tolist() == [6, 4, 6]


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from(["franke", "SR1", "SR2", "SR3"]), st.booleans())
def test_the_mesh_is_valid_after_every_number_of_sweeps(seed, name, sliding):
    inner = 0.05 + 0.9 * np.random.default_rng(seed).random((30, 2))
    mesh = delaunay(np.concatenate([lattice(4, 4) / 4, inner]))
    springs = DataSprings(problems.functions[name], first=1.0)
    for sweeps in (1, 3, 30):
        moved = smoothed(mesh, springs, max_sweeps=sweeps, sliding=sliding).mesh.validate()
        assert moved.domain_area == pytest.approx(mesh.domain_area, rel=1e-12)


def test_boundary_nodes_slide_along_their_side_and_corners_stay():
    mesh = problems.mesh("81")
    moved, side = smoothed(mesh, DataSprings(problems.SR3), sliding=True).mesh, sides_of(mesh).of_node
    corner, left = side == CORNER, mesh.nodes[:, 0] == 0
    assert np.array_equal(moved.nodes[corner], mesh.nodes[corner])
    assert (moved.nodes[left, 0] == 0).all() and (moved.nodes[left, 1] != mesh.nodes[left, 1]).any()
    fixed = smoothed(mesh, DataSprings(problems.SR3)).mesh
    assert np.array_equal(fixed.nodes[mesh.boundary_nodes], mesh.nodes[mesh.boundary_nodes])


def test_moving_before_swapping_beats_swapping_alone():
    mesh, u = problems.mesh("81"), problems.SR3
    moved = smoothed(mesh, DataSprings(u), sliding=True).mesh

    def error(start):
        swap = swapped(start, u, "jnd", norm=2).mesh
        return Interpolant(swap, u).l2_error(u, rule="exact")

    assert error(moved) < error(mesh) / 3


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"function": 3}, "type: the function is 3; give u(x, y), for nodes move to where no value is known"),
        ({"function": np.hypot, "first": -1.0}, "range: first is -1.0; give a finite number of at least 0"),
    ],
)
def test_what_springs_cannot_be(arguments, message):
    with pytest.raises(MeshError) as caught:
        DataSprings(**arguments)
    assert str(caught.value) == message
