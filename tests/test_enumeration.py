"""All triangulations of small sets of nodes: published counts, and theorems about the best."""

import numpy as np
import pytest
from support import Flips, all_meshes, as_set, is_delaunay, lattice, polygon, shuffled

from meshlib import Interpolant, delaunay

CATALAN = {3: 1, 4: 2, 5: 5, 6: 14, 7: 42, 8: 132, 9: 429, 10: 1430}
STRIPS = {1: 2, 2: 6, 3: 20, 4: 70}  # 1 x n unit squares: binomial(2n, n)
DOUBLE_STRIPS = {1: 6, 2: 64, 3: 852, 4: 12170}  # 2 x n: OEIS A296165, Kaibel & Ziegler 2003


def count(nodes):
    """Number of triangulations that use all nodes; the flip graph is connected (Lawson 1972)."""
    return len(Flips(nodes).reachable(as_set(delaunay(nodes))))


@pytest.mark.parametrize("n, number", CATALAN.items())
def test_convex_polygons_have_catalan_many(n, number):
    assert count(polygon(n)) == number


@pytest.mark.parametrize("n, number", STRIPS.items())
def test_strips_of_unit_squares(n, number):
    assert count(lattice(n, 1)) == number


@pytest.mark.parametrize("n, number", DOUBLE_STRIPS.items())
def test_double_strips_of_unit_squares(n, number):
    assert count(lattice(n, 2)) == number


@pytest.mark.parametrize("nodes", [lattice(2, 2), polygon(6), lattice(3, 1)])
def test_every_one_of_them_is_valid(nodes):
    for mesh in all_meshes(delaunay(nodes)):
        assert mesh.counts == delaunay(nodes).counts


# -- theorems about the best of all ----------------------------------------------------------


def generic(seed, n=7):
    """Seven random nodes with at most a few hundred triangulations, and no ties."""
    return np.random.default_rng(seed).random((n, 2))


def dirichlet(mesh, values):
    """The integral of |grad u_h|^2."""
    return float(mesh.areas @ (Interpolant(mesh, values).gradients ** 2).sum(axis=1))


@pytest.mark.parametrize("seed", range(4))
def test_delaunay_has_the_least_dirichlet_energy_of_all(seed):
    """Rippa 1990: whatever the data."""
    best, rng = delaunay(generic(seed)), np.random.default_rng(seed)
    others = [m for m in all_meshes(best) if not m.equals(best)]
    assert others
    for _ in range(3):
        values = rng.standard_normal(best.n_nodes)
        least = dirichlet(best, values)
        assert all(dirichlet(m, values) > least for m in others)


def test_delaunay_meshes_that_tie_have_the_same_energy():
    """Eight meshes or more are Delaunay on a 3 x 1 lattice: 2^3, one choice for each square."""
    meshes, values = all_meshes(delaunay(lattice(3, 1))), np.sin(np.arange(8) ** 2)
    tied = [dirichlet(m, values) for m in meshes if is_delaunay(m)]
    others = [dirichlet(m, values) for m in meshes if not is_delaunay(m)]
    assert len(tied) == 8 and len(others) == 20 - 8
    assert np.ptp(tied) < 1e-12 < min(others) - max(tied)


def test_no_random_flips_lower_the_energy(rng):
    best, values = delaunay(rng.random((40, 2))), rng.standard_normal(40)
    for _ in range(10):
        other = shuffled(best, rng, steps=5)
        assert other.equals(best) or dirichlet(other, values) > dirichlet(best, values)


@pytest.mark.parametrize("seed", range(3))
def test_delaunay_is_the_l2_best_mesh_for_the_paraboloid(seed):
    def u(x, y):
        return x**2 + y**2

    meshes = all_meshes(delaunay(generic(seed)))
    errors = [Interpolant(m, u).l2_error(u, rule="exact") for m in meshes]
    assert meshes[np.argmin(errors)].equals(delaunay(generic(seed)))
    assert np.sort(errors)[1] > np.min(errors) + 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_a_stretched_delaunay_mesh_is_best_for_any_convex_quadratic(seed):
    """u = x'Hx / 2 with H = LL': Delaunay after x -> L'x."""
    lower = np.array([[1.0, 0.0], [2.0, 0.5]])
    h = lower @ lower.T
    nodes = generic(seed)

    def u(x, y):
        return (h[0, 0] * x**2 + 2 * h[0, 1] * x * y + h[1, 1] * y**2) / 2

    meshes = all_meshes(delaunay(nodes))
    errors = [Interpolant(m, u).l2_error(u, rule="exact") for m in meshes]
    stretched = delaunay(nodes @ lower)
    assert as_set(meshes[np.argmin(errors)]) == as_set(stretched)
    assert not meshes[np.argmin(errors)].equals(delaunay(nodes))  # else nothing is shown
