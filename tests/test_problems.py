"""Node sets, start meshes, orders and functions by name."""

import numpy as np
import pytest
from support import is_delaunay

from meshlib import Mesh, problems
from meshlib.problems.start_meshes import split_in_four

FUNCTIONS = (
    "SR1",
    "SR2",
    "SR3",
    "DD1",
    "franke",
    "cliff",
    "saddle",
    "gentle",
    "steep",
    "sphere",
    "convex",
    "hyperbolic",
    "product",
)


@pytest.mark.parametrize(
    "name, counts",
    [
        ("33", (33, 88, 56)),
        ("33-refined", (33 + 88, 2 * 88 + 3 * 56, 4 * 56)),
        ("81", (81, 208, 128)),
        ("33-franke", (33, 88, 56)),
    ],
)
def test_counts(name, counts):
    mesh = problems.mesh(name)
    assert mesh.validate().counts == counts
    assert mesh.nodes.shape == problems.nodes(name).shape and np.array_equal(mesh.nodes, problems.nodes(name))
    assert mesh.domain_area == pytest.approx(1, rel=1e-14)
    assert mesh.nodes.min() == 0 and mesh.nodes.max() == 1


def test_names():
    assert set(problems.names()) == {"33", "33-refined", "81", "33-franke"}
    assert tuple(problems.functions) == FUNCTIONS


def test_the_81_nodes_are_a_lattice():
    assert {tuple(8 * p) for p in problems.nodes("81")} == {(i, j) for i in range(9) for j in range(9)}
    assert is_delaunay(problems.mesh("81"))


def test_appendix_a_is_franke_with_one_decimal_but_for_one_node():
    """Only (.70, .65), printed as (.7, .6), is not what formatting with one decimal gives."""
    ours, franke = problems.nodes("33"), problems.nodes("33-franke")
    assert np.array_equal(ours, ours.round(1))
    rounded = np.array([[float(f"{v:.1f}") for v in p] for p in franke])
    (other,) = np.flatnonzero((ours != rounded).any(axis=1))
    assert franke[other].tolist() == [0.7, 0.65] and ours[other].tolist() == [0.7, 0.6]


@pytest.mark.parametrize("a, b", [(20, 33), (4, 11), (17, 26), (2, 14), (7, 32), (16, 29)])
def test_the_six_free_diagonals_of_the_33_nodes(a, b):
    """Numbered from 1, as in Appendix A."""
    problems.mesh("33").edge_numbers([[a - 1, b - 1]])


def test_orders_are_permutations():
    for name in problems.names():
        assert np.array_equal(np.sort(problems.order(name)), np.arange(problems.mesh(name).n_edges))


def test_the_canonical_order_begins_with_the_halves_of_the_first_edge():
    """(0,1) is halved three times: nodes 0, .., 1 from left to right along y = 0."""
    mesh, order = problems.mesh("81"), problems.order("81")
    along = mesh.nodes[mesh.edges[order[:8]]]
    assert (along[..., 1] == 0).all()
    assert np.sort(along[..., 0], axis=1).tolist() == [[k / 8, (k + 1) / 8] for k in range(8)]


def test_splitting_in_four_by_hand():
    nodes, edges, elements = split_in_four(
        np.array([[0.0, 0], [2, 0], [0, 2]]), np.array([[0, 1], [1, 2], [2, 0]]), np.array([[0, 1, 2]])
    )
    assert nodes[3:].tolist() == [[1, 0], [1, 1], [0, 1]]
    assert edges.tolist() == [[0, 3], [3, 1], [1, 4], [4, 2], [2, 5], [5, 0], [3, 5], [3, 4], [4, 5]]
    assert elements.tolist() == [[0, 3, 5], [1, 4, 3], [2, 5, 4], [3, 4, 5]]
    assert Mesh(nodes, elements).validate().counts == (6, 9, 4)


# -- functions: values that can be worked out ---------------------------------------------------


@pytest.mark.parametrize(
    "name, x, y, value",
    [
        ("SR1", 0.3, 0.3, 1 / 9),
        ("SR1", 0, 1, (np.tanh(9) + 1) / 9),
        ("cliff", 0.3, 0.3, 1 / 9),
        ("SR2", 0.5, 0.5, 1 / 2),
        ("SR2", 0, 0, (np.tanh(-9) + 1) / 2),
        ("SR3", 0, 0, 1 + np.tanh(-3 * (0.595576 * 3.79762**2 - 10))),
        ("DD1", 0, 1, 1),
        ("DD1", 1, 0, 0),
        ("DD1", 1.6 / 2.1, 0.5, 1),
        ("DD1", 0.5, 1.2, 0.5),
        ("DD1", 1.6 / 2.1, 0.7, 0),
        ("DD1", 0, 0.2, 0.6),
        ("saddle", 1 / 3, 0, 2.25 / 6),
        ("gentle", 0.5, 0.5, 1 / 3),
        ("steep", 0.5, 0.5, 1 / 3),
        ("sphere", 0.5, 0.5, 8 / 9 - 1 / 2),
        ("convex", 0.6, 0.8, 1),
        ("hyperbolic", 1, 1, 0),
        ("product", 0.5, 0.5, 0.25),
    ],
)
def test_values(name, x, y, value):
    if (name, x, y) == ("DD1", 1.6 / 2.1, 0.7):
        value = (1 + np.cos(4 * np.pi * 0.2)) / 2  # 0.2 above the top of the spike, below the ramp
    if (name, x, y) == ("DD1", 0.5, 1.2):
        value = 2 * (1.2 - 0.95) if 1.2 - 0.95 < 0.5 else 1  # phi = 2.1/2 - 0.1
    assert problems.functions[name](x, y) == pytest.approx(value, abs=1e-12)


def test_franke_at_the_origin():
    """(9x, 9y) = (0, 0): exponents -(4 + 4)/4, -1/49 - 1/10, -(49 + 9)/4, -16 - 49."""
    value = 0.75 * np.exp(-2) + 0.75 * np.exp(-1 / 49 - 0.1) + 0.5 * np.exp(-14.5) - 0.2 * np.exp(-65)
    assert float(problems.functions["franke"](0, 0)) == pytest.approx(value)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_take_arrays_and_numbers(name, rng):
    u = problems.functions[name]
    x, y = rng.random((2, 3, 4))
    assert u(x, y).shape == (3, 4) and np.isfinite(u(x, y)).all()
    assert float(u(x[1, 2], y[1, 2])) == pytest.approx(u(x, y)[1, 2])
    assert u.name == name and u.formula and u.source
    assert repr(u) == f"TestFunction({name!r})"


def test_dd1_is_continuous():
    x, y = np.meshgrid(np.linspace(0, 1, 801), np.linspace(0, 1, 801))
    u = problems.functions["DD1"](x, y)
    assert max(np.abs(np.diff(u, axis=0)).max(), np.abs(np.diff(u, axis=1)).max()) < 0.02
