"""Cost functions: values by hand, scaling, rigid motions, and the registry."""

import numpy as np
import pytest

from meshlib import Interpolant, Mesh, MeshError, criteria, delaunay, problems
from meshlib.criteria.norms import NORMS, measure, norm_of, precedes

BUILT_IN = ("jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle", "gradient-spread")
MOTIONS = {
    "shift": (np.eye(2), (3, -7)),
    "turn": (np.array([[0.6, 0.8], [-0.8, 0.6]]), (0, 0)),
    "quarter turn": (np.array([[0.0, 1], [-1, 0]]), (1, 1)),
}


@pytest.fixture
def roof():
    """Two halves of the square [0, 1]^2 on either side of 0-2; u rises by 1 at node 1."""
    return Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]), np.array([0.0, 1, 0, 0])


def inner_cost(roof, name):
    mesh, values = roof
    vector = criteria.costs(mesh, values, name)
    assert vector.shape == (5,) and (vector[mesh.boundary] == 0).all()
    return vector[~mesh.boundary][0]


def test_jump_in_normal_derivatives(roof):
    """Gradients (1, -1) and (0, 0): the jump is along the normal (1, -1)/sqrt(2)."""
    assert inner_cost(roof, "jnd") == pytest.approx(np.sqrt(2))


def test_angle_between_normals(roof):
    """cos = (-1, 1, 1).(0, 0, 1)/sqrt(3)."""
    assert inner_cost(roof, "abn") == pytest.approx(np.arccos(1 / np.sqrt(3)))


def test_deviations_from_linear_polynomials(roof):
    """The plane x - y misses node 3 by 1, the plane 0 misses node 1 by 1."""
    assert inner_cost(roof, "dlp") == pytest.approx(np.sqrt(2))


def test_distances_from_planes(roof):
    """Node 3 is 1/sqrt(3) from the plane x - y, node 1 is 1 from the plane 0."""
    assert inner_cost(roof, "dfp") == pytest.approx(np.sqrt(1 / 3 + 1))


@pytest.mark.parametrize("name, cost", [("smallest-angle", 60 - 45), ("largest-angle", 90 - 60)])
def test_angles(roof, name, cost):
    assert np.degrees(criteria.costs(*roof, name)) == pytest.approx([cost, cost])


def test_gradient_spread(roof):
    """Nodes 0 and 2 see both gradients with equal areas: each is |(1, -1)|/2 from the mean."""
    assert criteria.costs(*roof, "gradient-spread") == pytest.approx([np.sqrt(0.5), 0, np.sqrt(0.5), 0])


def test_min_error(start):
    """With norm 2 the norm of the cost vector is the L2 error; with norm 1 a sum over elements."""
    u = problems.functions["convex"]
    vector = criteria.min_error(u).costs(start, u)
    assert vector.shape == (start.n_elements,)
    assert norm_of(vector, 2) == pytest.approx(Interpolant(start, u).l2_error(u, rule="exact"))


@pytest.mark.parametrize("name", ["jnd", "abn", "dlp", "dfp", "gradient-spread"])
def test_affine_data_cost_nothing(start, name):
    vector = criteria.costs(start, lambda x, y: 3 - 2 * x + 5 * y, name)
    assert np.abs(vector).max() < 1e-11


@pytest.mark.parametrize("alpha, beta", [(3, 0), (-2, 5), (1e-6, 1), (1e6, -1)])
def test_jnd_scales_with_the_data(start, alpha, beta):
    u = problems.functions["SR3"](*start.nodes.T)
    scaled, plain = (criteria.costs(start, v, "jnd") for v in (alpha * u + beta, u))
    assert np.allclose(scaled, abs(alpha) * plain, rtol=1e-7, atol=1e-11 * max(abs(beta), abs(alpha)))


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("name", BUILT_IN)
def test_rigid_motions_leave_every_cost(name, motion):
    mesh, (q, shift) = problems.mesh("33"), MOTIONS[motion]
    u = problems.functions["SR1"](*mesh.nodes.T)
    moved = Mesh(mesh.nodes @ q + shift, mesh.elements)
    assert np.allclose(criteria.costs(moved, u, name), criteria.costs(mesh, u, name), rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_mirrored_mesh_costs_the_same(name):
    mesh = problems.mesh("33")
    u = problems.functions["SR1"](*mesh.nodes.T)
    mirrored = Mesh(mesh.nodes * [-1, 1], mesh.elements[:, ::-1])
    assert (
        np.allclose(criteria.costs(mirrored, u, name), criteria.costs(mesh, u, name), atol=1e-11)
        or criteria.get(name).on == "element"
    )
    assert np.sort(criteria.costs(mirrored, u, name)) == pytest.approx(np.sort(criteria.costs(mesh, u, name)))


@pytest.mark.parametrize("name", BUILT_IN)
def test_costs_are_not_negative_and_finite(start, name):
    vector = criteria.costs(start, problems.functions["DD1"], name)
    assert np.isfinite(vector).all() and (vector >= 0).all()


def test_jnd_of_all_edges_is_the_jump_along_the_normal(rng):
    """The jump of the gradient has no part along the edge, so JND is its length."""
    mesh = delaunay(rng.random((30, 2)))
    values = rng.standard_normal(30)
    g = Interpolant(mesh, values).gradients
    left, right = mesh.edge_elements[~mesh.boundary].T
    assert np.allclose(
        criteria.costs(mesh, values)[~mesh.boundary], np.linalg.norm(g[left] - g[right], axis=1)
    )


# -- norms ---------------------------------------------------------------------------------


def test_norms_by_hand():
    vector = np.array([3.0, 4.0, 0.0])
    assert [norm_of(vector, n) for n in NORMS] == [7, 5, 4, 4]
    assert [measure(vector, n) for n in NORMS] == [7, 25, 4, (4.0, 3.0, 0.0)]
    assert norm_of(vector, np.inf) == 4


@pytest.mark.parametrize(
    "first, second, before",
    [
        ((2, 1), (2, 3), (1, 2, "max", "lexicographic")),
        ((2, 1), (2, 2), (1, 2, "lexicographic")),
        ((2, 2), (3, 0), ("max", "lexicographic", 2)),
        ((3, 3), (1, 4), ("max", "lexicographic")),
        ((1, 1), (1, 1), ()),
        ((1, 2), (2, 1), ()),
    ],
)
def test_orders_by_hand(first, second, before):
    """(2, 2): sum 4, squares 8; (3, 0): sum 3, squares 9; (3, 3): 6, 18; (1, 4): 5, 17."""
    assert {n for n in NORMS if precedes(first, second, n)} == set(before)
    assert not any(precedes(second, first, n) for n in before)


def test_rounding_is_no_gain():
    for norm in NORMS:
        assert not precedes([1.0, 2.0 * (1 - 1e-15)], [1.0, 2.0], norm, scale=1.0)
        assert precedes([1.0, 2.0 * (1 - 1e-9)], [1.0, 2.0], norm, scale=1.0)
    assert not precedes([1e-12], [2e-12], 1, scale=1.0)
    assert precedes([1e-12], [2e-12], 1, scale=0.0)


# -- the registry -----------------------------------------------------------------------------


def test_names_by_place():
    assert criteria.names() == BUILT_IN
    assert criteria.names("edge") == ("jnd", "abn", "dlp", "dfp")
    assert criteria.names("element") == ("smallest-angle", "largest-angle")
    assert criteria.names("node") == ("gradient-spread",)


def test_a_criterion_of_ones_own(roof):
    def length(p, q, left, right):
        return np.hypot(*(q - p)[:, :2].T)

    mine = criteria.register(criteria.Criterion("length", "edge", length))
    try:
        assert criteria.get("length") is mine is criteria.get(mine)
        assert inner_cost(roof, "length") == pytest.approx(np.sqrt(2))
        with pytest.raises(MeshError) as error:
            criteria.register(mine)
        assert str(error.value) == "duplicate: a criterion 'length' exists; choose another name"
    finally:
        criteria.unregister("length")
    assert criteria.names() == BUILT_IN


def test_prefers(roof):
    mesh, values = roof
    other = Mesh(mesh.nodes, [[0, 1, 3], [1, 2, 3]])
    flat = Mesh(mesh.nodes * [1, 0.5], mesh.elements)
    assert not criteria.prefers(mesh, other, values) and not criteria.prefers(other, mesh, values)
    assert criteria.prefers(mesh, flat, criterion="smallest-angle", norm="max")
    assert not criteria.prefers(flat, mesh, criterion="smallest-angle", norm="max")
    assert criteria.prefers(mesh, mesh, (np.zeros(4), values))
    # on u = xy the diagonals 0-2 and 1-3 both bend; with (0, 0, 1, 1) = y neither does
    assert not criteria.prefers(mesh, other, lambda x, y: y)
