"""Values on grids, by rasterising elements, against evaluation point by point."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import lattice

from meshlib import Interpolant, Mesh, MeshError, delaunay, problems


def assert_like_points(u_h, nx, ny=None):
    x, y, grid = u_h.on_grid(nx, ny)
    points = u_h(x[None, :], y[:, None])
    assert grid.shape == (len(y), len(x)) == (ny or nx, nx)
    assert np.array_equal(np.isnan(grid), np.isnan(points))
    scale = np.abs(u_h.values).max() or 1
    assert np.nanmax(np.abs(grid - points), initial=0) < 1e-11 * scale


@settings(max_examples=150)
@given(problems_of(scales=(1.0, 0.1, 1 / 3, 1e-9, 1e6)), st.integers(2, 31), st.integers(2, 31))
def test_on_lattices_every_point_on_a_side_is_met(problem, nx, ny):
    assert_like_points(Interpolant(*problem), nx, ny)


@pytest.mark.parametrize("seed", range(5))
def test_on_random_nodes(seed):
    rng = np.random.default_rng(seed)
    nodes = rng.random((200, 2))
    assert_like_points(Interpolant(delaunay(nodes), rng.standard_normal(200)), 60, 47)


@pytest.mark.parametrize("shift", [1e3, 1e6])
def test_far_from_the_origin(shift):
    mesh = Mesh(lattice(4, 4) + shift, delaunay(lattice(4, 4)).elements)
    assert_like_points(Interpolant(mesh, np.sin(np.arange(25))), 33)


@pytest.mark.parametrize("stretch", [1e-8, 1e5])
def test_flat_domains(stretch):
    mesh = Mesh(lattice(8, 8) * [1, stretch], delaunay(lattice(8, 8)).elements)
    assert_like_points(Interpolant(mesh, np.sin(np.arange(81))), 17)


def test_a_hole_stays_empty(frame):
    x, y, grid = Interpolant(frame, np.ones(16)).on_grid(13)
    inside = (x[None, :] > 1) & (x[None, :] < 2) & (y[:, None] > 1) & (y[:, None] < 2)
    assert np.isnan(grid[inside]).all() and inside.sum() == 9
    assert (grid[~inside] == 1).all()


def test_an_affine_function_is_met_everywhere(start):
    x, y, grid = Interpolant(start, lambda x, y: 1 + 2 * x - 3 * y).on_grid(101)
    assert np.abs(grid - (1 + 2 * x[None, :] - 3 * y[:, None])).max() < 1e-13


def test_slivers_do_not_decide_for_their_neighbours():
    """Nodes on one line but for rounding: the sliver's gradient is noise."""
    nodes = np.array([[0, 0], [0.1, 0.3], [0.2, 0.6], [0.3, 0.9], [1, 0], [0, 1]])
    u_h = Interpolant(delaunay(nodes), lambda x, y: x + y)
    x, y, grid = u_h.on_grid(41)
    known = ~np.isnan(grid)
    assert np.abs(grid - (x[None, :] + y[:, None]))[known].max() < 1e-12


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"nx": 1}, "range: nx is 1; give a whole number of at least 2"),
        ({"ny": 0}, "range: ny is 0; give a whole number of at least 2"),
    ],
)
def test_sizes_are_checked(arguments, message):
    with pytest.raises(MeshError) as error:
        Interpolant(problems.mesh("33"), problems.SR1).on_grid(**arguments)
    assert str(error.value) == message
