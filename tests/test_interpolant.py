"""The interpolant: where it is exact, where it is not defined, and its error in closed form."""

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.interpolate import LinearNDInterpolator
from strategies import problems_of
from support import lattice

from meshlib import Interpolant, Mesh, MeshError, delaunay, problems
from meshlib.geometry import quadrature


def affine(x, y):
    return 3 - 2 * x + 5 * y


@settings(max_examples=60)
@given(problems_of(most=20))
def test_exact_at_the_nodes(problem):
    mesh, values = problem
    found = Interpolant(mesh, values)(*mesh.nodes.T)
    assert np.allclose(found, values, rtol=0, atol=1e-9)


def test_exact_for_affine_functions(start, rng):
    u_h = Interpolant(start, affine)
    x, y = rng.random((2, 1000))
    assert np.abs(u_h(x, y) - affine(x, y)).max() < 1e-13
    assert np.abs(u_h.gradients - [-2, 5]).max() < 1e-11
    gx, gy, u = u_h.on_grid(23, 11)
    assert u.shape == (11, 23)
    assert np.abs(u - affine(gx[None, :], gy[:, None])).max() < 1e-13


def test_the_grid_covers_the_bounding_box():
    u_h = Interpolant(delaunay([[1, 2], [5, 2], [5, 4], [1, 4]]), affine)
    x, y, u = u_h.on_grid(5)
    assert x.tolist() == [1, 2, 3, 4, 5] and y.tolist() == [2, 2.5, 3, 3.5, 4]
    assert not np.isnan(u).any()


def test_inside_an_element_by_hand():
    """On (0,0), (1,0), (0,1) with the values 1, 4, 6 the plane is 1 + 3x + 5y."""
    u_h = Interpolant(Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]), [1, 4, 6])
    assert u_h.gradients.tolist() == [[3.0, 5.0]]
    assert float(u_h(0.25, 0.5)) == 1 + 0.75 + 2.5
    assert u_h([0.25, 0.0], [[0.5], [0.0]]).tolist() == [[4.25, 3.5], [1.75, 1.0]]


@pytest.mark.parametrize(
    "x, y",
    [
        (-0.01, 0.5),
        (2, 2),
        (np.nan, 0.5),
        (0.5, np.nan),
        (np.inf, 0),
        (0, -np.inf),
        (1e300, 0.5),
        (-1e300, -1e300),
    ],
)
def test_nan_outside_and_at_what_is_no_point(square, x, y):
    assert np.isnan(Interpolant(square, affine)(x, y))


def test_nan_in_a_hole(frame):
    u_h = Interpolant(frame, affine)
    assert np.isnan(u_h(1.5, 1.5))
    assert u_h(0.5, 1.5) == affine(0.5, 1.5)


def test_no_points_no_values(square):
    assert Interpolant(square, affine)([], []).shape == (0,)
    assert Interpolant(square, affine)(np.empty((0, 3)), 1.0).shape == (0, 3)


@pytest.mark.parametrize("n", [5, 300])
def test_agrees_with_scipy(n, rng):
    nodes, values = rng.random((n, 2)), rng.standard_normal(n)
    theirs, ours = LinearNDInterpolator(nodes, values), Interpolant(delaunay(nodes), values)
    x, y = rng.uniform(-0.2, 1.2, (2, 3000))
    expected = theirs(x, y)
    assert np.array_equal(np.isnan(ours(x, y)), np.isnan(expected))
    assert np.nanmax(np.abs(ours(x, y) - expected)) < 1e-10


def test_agrees_with_matplotlib(rng):
    tri = pytest.importorskip("matplotlib.tri")
    mesh = problems.mesh("33")
    u = problems.functions["SR3"]
    x, y = rng.random((2, 2000))
    theirs = tri.LinearTriInterpolator(tri.Triangulation(*mesh.nodes.T, mesh.elements), u(*mesh.nodes.T))
    assert np.abs(Interpolant(mesh, u)(x, y) - theirs(x, y).data).max() < 1e-12


@pytest.mark.parametrize("stretch", [1e-3, 1e-8, 1e-12, 1e5])
def test_flat_domains(stretch, rng):
    mesh = Mesh(lattice(8, 8) * [1, stretch], delaunay(lattice(8, 8)).elements)
    x, y = 8 * rng.random((2, 500))
    found = Interpolant(mesh, lambda x, y: affine(x, y / stretch))(x, y * stretch)
    assert np.abs(found - affine(x, y)).max() < 1e-10


@pytest.mark.parametrize("shift", [1e3, 1e6])
def test_far_from_the_origin(shift, rng):
    mesh = Mesh(lattice(4, 4) + shift, delaunay(lattice(4, 4)).elements)
    x, y = 4 * rng.random((2, 500))
    found = Interpolant(mesh, lambda x, y: affine(x - shift, y - shift))(x + shift, y + shift)
    assert np.abs(found - affine(x, y)).max() < 1e-8


def test_values_are_kept_apart(square):
    values = np.zeros(4)
    u_h = Interpolant(square, values)
    values += 1
    assert u_h.values.tolist() == [0, 0, 0, 0]
    with pytest.raises(ValueError, match="read-only"):
        u_h.values[0] = 1


# -- the L2 error --------------------------------------------------------------------------


def closed_form(mesh, h):
    """||u - u_h||^2 = A/720 (sum d_i^2 + (sum d_i)^2), d_i = e_i'He_i, for u = x'Hx / 2."""
    edges = mesh.corners - np.roll(mesh.corners, 1, axis=1)
    d = np.einsum("tki,ij,tkj->tk", edges, h, edges)
    return mesh.areas / 720 * ((d**2).sum(axis=1) + d.sum(axis=1) ** 2)


def quadratic(h):
    return lambda x, y: (h[0, 0] * x**2 + 2 * h[0, 1] * x * y + h[1, 1] * y**2) / 2


@pytest.mark.parametrize(
    "h", [[[2, 0], [0, 2]], [[0, 1], [1, 0]], [[2, 0], [0, -2]], [[3, 1], [1, 5]], [[1, 0], [0, 0]]]
)
def test_error_of_a_quadratic_in_closed_form(start, h):
    h = np.array(h, dtype=float)
    found = Interpolant(start, quadratic(h)).squared_errors(quadratic(h), degree=4)
    assert np.allclose(found, closed_form(start, h), rtol=1e-9, atol=1e-20)


@pytest.mark.parametrize(
    "name, error", [("convex", np.sqrt(11 / 90) / 64), ("product", 1 / (64 * np.sqrt(90)))]
)
def test_error_on_81_nodes(name, error):
    """Right-angled elements with legs 1/8.

    For x^2 + y^2, d = 2|e|^2 = (2, 2, 4)/64, so that
    A/720 (24 + 64)/64^2 summed over 2A = 1/64 is 88/720/64^2 = (11/90)/64^2.
    """
    u = problems.functions[name]
    assert Interpolant(problems.mesh("81"), u).l2_error(u, rule="exact") == pytest.approx(error, rel=1e-12)


@pytest.mark.parametrize("degree", range(12))
def test_quadrature_is_exact_to_its_degree(degree):
    """The integral of x^i y^j over the reference triangle is i! j! / (i + j + 2)!."""
    from math import factorial

    points, weights = quadrature.rule(degree)
    assert weights.min() > 0 and np.allclose(points.sum(axis=1), 1) and points.min() > 0
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            exact = 2 * factorial(i) * factorial(j) / factorial(i + j + 2)
            assert weights @ (points[:, 1] ** i * points[:, 2] ** j) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("points", [1, 100, 26 * 25])
def test_batches_do_not_matter(points, monkeypatch):
    """An element has 25 points of degree 8: one, four and 26 elements at once."""
    from meshlib.interpolation import on_elements

    u = problems.functions["franke"]
    u_h = Interpolant(problems.mesh("81"), u)
    expected = u_h.squared_errors(u)
    assert len(quadrature.rule(8)[1]) == 25
    monkeypatch.setattr(on_elements, "POINTS_AT_ONCE", points)
    assert np.allclose(u_h.squared_errors(u), expected, rtol=1e-12, atol=0)


def test_trapezium_rule_by_hand(square):
    """u = 1 against u_h = 0 with 3 x 3 points: every weight times 1, the area."""
    u_h = Interpolant(square, np.zeros(4))
    assert u_h.l2_error(lambda x, y: 1 + 0 * x, points=3, rule="trapezium") == 1.0
    # u = x: the rule on 0, 1/2, 1 gives (0/2 + 1/4 + 1/2)/2 = 3/8 for the integral of x^2
    assert u_h.l2_error(lambda x, y: x + 0 * y, points=3, rule="trapezium") == pytest.approx(np.sqrt(3 / 8))


def test_both_rules_agree_in_the_limit():
    u = problems.functions["franke"]
    u_h = Interpolant(problems.mesh("81"), u)
    assert u_h.l2_error(u, points=401, rule="trapezium") == pytest.approx(
        u_h.l2_error(u, rule="exact", degree=20), rel=1e-4
    )


@pytest.mark.parametrize("nodes", [[[0, 0], [1, 0], [0, 1]], [[0, 0], [2, 0], [3, 1], [1, 1]]])
def test_trapezium_needs_a_rectangle(nodes):
    message = 'domain: the trapezium rule needs a rectangular domain; use rule="exact"'
    for points in (2, 3, 101):
        with pytest.raises(MeshError) as error:
            Interpolant(delaunay(nodes), affine).l2_error(affine, points=points, rule="trapezium")
        assert str(error.value) == message


def test_a_hole_between_the_points_of_the_grid_is_noticed(frame):
    """With 4 x 4 points none lies inside the hole."""
    with pytest.raises(MeshError, match=r"^domain: the trapezium rule needs a rectangular domain; "):
        Interpolant(frame, affine).l2_error(affine, points=4, rule="trapezium")


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"rule": "simpson"}, "unknown: rule 'simpson' is not known (known: 'exact', 'trapezium')"),
        (
            {"rule": "trapezum"},
            "unknown: rule 'trapezum' is not known; did you mean 'trapezium'? (known: 'exact', 'trapezium')",
        ),
        ({"points": 1}, "range: points is 1; give a whole number of at least 2"),
        ({"points": 10.5}, "range: points is 10.5; give a whole number of at least 2"),
        ({"rule": "exact", "degree": -1}, "range: degree is -1; give a whole number of at least 0"),
        ({"rule": "exact", "degree": 2.5}, "range: degree is 2.5; give a whole number of at least 0"),
    ],
)
def test_arguments_of_the_error_are_checked(square, arguments, message):
    with pytest.raises(MeshError) as error:
        Interpolant(square, affine).l2_error(affine, **{"rule": "trapezium", **arguments})
    assert str(error.value) == message


@pytest.mark.parametrize("rule", ["trapezium", "exact"])
def test_a_function_that_is_not_finite_is_named_as_the_cause(square, rule):
    with pytest.raises(MeshError) as error:
        Interpolant(square, affine).l2_error(lambda x, y: np.where(x > 0.5, np.nan, x + y), rule=rule)
    assert (
        str(error.value)
        == "finite: the function is not finite everywhere in the domain; l2_error needs it to be"
    )
