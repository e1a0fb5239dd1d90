"""Nodes along a curved boundary: equidistribution, the area that is lost, meshes of the domain."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshlib import MeshError, curves, quality

A, B = 4.0, 1.0  # half axes
DENSITIES = ("curvature", "length", "parameter")


def circle(t):
    return np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)


def ellipse(t):
    x, y = circle(t)
    return A * x, B * y


def trefoil(t):
    """r = 1 + 0.35 cos(3 phi): not convex."""
    x, y = circle(t)
    r = 1 + 0.35 * np.cos(6 * np.pi * t)
    return r * x, r * y


def limacon(t):
    """r = 1 + 2 cos(phi): crosses itself."""
    x, y = circle(t)
    return (1 + 2 * x) * x, (1 + 2 * x) * y


def square(t):
    """Corners at t = 0, 1/4, 1/2, 3/4."""
    corner = np.interp(t % 1, np.arange(5) / 4, [0, 1, 1, 0, 0])
    return corner, np.interp(t % 1, np.arange(5) / 4, [0, 0, 1, 1, 0])


def perimeter(curve, parts=1 << 14):
    x, y = curve(np.linspace(0, 1, parts + 1))
    return np.hypot(np.diff(x), np.diff(y)).sum()


def polygon_area(nodes):
    (x, y), (p, q) = nodes.T, np.roll(nodes, -1, axis=0).T
    return (x * q - y * p).sum() / 2


def lost(curve, n, density):
    return n**2 * curves.deviation(curve, curves.boundary_parameters(curve, n, density))


# -- equidistribution -------------------------------------------------------------------------


@given(st.lists(st.integers(1, 9), min_size=1, max_size=30), st.integers(1, 20))
def test_the_law_of_equidistribution(density, n):
    """Of the density that is constant between samples, every part gets the same integral."""
    found = curves.equidistributed(density, n)
    assert found[0] == 0 and (np.diff(found, append=1) > 0).all()
    between = (np.array(density) + np.roll(density, -1)) / 2
    total = np.concatenate([[0], np.cumsum(between)]) / between.sum()
    reached = np.interp(np.append(found, 1), np.linspace(0, 1, len(total)), total)
    assert np.allclose(np.diff(reached), 1 / n, rtol=1e-9)


def test_a_constant_density_is_even():
    assert curves.equidistributed([2, 2, 2], 5) == pytest.approx(np.arange(5) / 5)


def test_no_node_where_the_density_is_zero():
    found = curves.equidistributed([0, 0, 0, 0, 1, 1, 1, 0], 6)
    assert ((found[1:] > 3 / 8) & (found[1:] < 7 / 8)).all()


def test_even_shares_the_nodes_out():
    """A square has no curvature but at its corners; an even share of 1 is the arc length."""
    by_length = curves.boundary_parameters(square, 16, "length")
    assert by_length == pytest.approx(np.arange(16) / 16, abs=1e-4)  # corners are rounded
    assert curves.boundary_parameters(square, 16, even=1.0) == pytest.approx(by_length)
    pure, mixed = (
        np.diff(curves.boundary_parameters(square, 16, even=e), append=1).max() for e in (0.0, 0.5)
    )
    assert pure == pytest.approx(1 / 4, rel=0.01) and mixed < 0.13  # half the nodes are 1/8 apart


def test_half_of_the_nodes_are_even():
    """With even = e no gap is longer than the perimeter over e n."""
    x, y = ellipse(np.append(curves.boundary_parameters(ellipse, 40, even=0.5), 1))
    assert np.hypot(np.diff(x), np.diff(y)).max() <= perimeter(ellipse) / (0.5 * 40)


@pytest.mark.parametrize("density", DENSITIES)
def test_on_a_circle_all_densities_are_alike(density):
    assert curves.boundary_parameters(circle, 7, density) == pytest.approx(np.arange(7) / 7, abs=1e-6)


def test_another_speed_along_the_curve_moves_no_node():
    """Curvature and arc length belong to the curve, not to its parameter."""

    def warped(t):
        return ellipse(t + 0.1 * np.sin(2 * np.pi * t))

    for density in DENSITIES[:2]:
        nodes = [np.column_stack(c(curves.boundary_parameters(c, 12, density))) for c in (ellipse, warped)]
        assert np.allclose(*nodes, atol=1e-4)


# -- the area that is lost ------------------------------------------------------------------------


@pytest.mark.parametrize("curve, area", [(circle, np.pi), (ellipse, np.pi * A * B)])
def test_the_deviation_of_a_convex_domain_is_the_area_outside_the_polygon(curve, area):
    t = curves.boundary_parameters(curve, 11, "length")
    assert curves.deviation(curve, t) == pytest.approx(
        area - polygon_area(np.column_stack(curve(t))), rel=1e-4
    )


def test_slivers_on_both_sides_do_not_cancel():
    t = curves.boundary_parameters(trefoil, 30, "length")
    between = np.pi * (1 + 0.35**2 / 2) - polygon_area(np.column_stack(trefoil(t)))
    assert curves.deviation(trefoil, t) > abs(between) * 1.5


def test_the_best_polygons_of_an_ellipse():
    """n^2 times the area lost tends to L^3/12, L the affine length 2 pi (a b)^(1/3): 2 pi^3 a b / 3."""
    assert lost(ellipse, 256, "curvature") == pytest.approx(2 * np.pi**3 * A * B / 3, rel=1e-3)


def test_equal_arcs_of_a_convex_curve():
    """Arcs of length l/n lose sum k (l/n)^3 / 12 = l^2/(12 n^2) times the total curvature 2 pi."""
    assert lost(ellipse, 256, "length") == pytest.approx(np.pi * perimeter(ellipse) ** 2 / 6, rel=2e-3)


@pytest.mark.parametrize("curve", [ellipse, trefoil])
@pytest.mark.parametrize("n", [32, 64, 128])
def test_no_other_density_loses_less(curve, n):
    """By Hoelder's inequality, to leading order."""
    best, *others = (lost(curve, n, density) for density in DENSITIES)
    assert best <= min(others) * (1 + 1e-9)


@pytest.mark.parametrize("curve", [circle, ellipse, trefoil])
def test_four_times_as_many_nodes_lose_a_sixteenth(curve):
    few, many = (curves.deviation(curve, curves.boundary_parameters(curve, n)) for n in (60, 240))
    assert few / many == pytest.approx(16, rel=0.03)


def test_data_on_the_boundary_decide():
    """Linear interpolation along the curve is better between nodes placed by u than between even ones."""

    def u(x, y):
        return np.tanh(9 * (y - x))

    def error(t):
        """L2, along the circle."""
        s = np.linspace(0, 1, 20_001)
        return np.sqrt(
            np.mean((u(*circle(s)) - np.interp(s, np.append(t, 1), u(*circle(np.append(t, 1))))) ** 2)
        )

    by_data, even = (error(curves.boundary_parameters(circle, 48, density)) for density in (u, "length"))
    assert by_data < even / 3


# -- meshes -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("density", DENSITIES)
@pytest.mark.parametrize("curve, n", [(circle, 3), (circle, 12), (ellipse, 30), (trefoil, 40)])
def test_the_mesh_covers_the_polygon(curve, n, density):
    t = curves.boundary_parameters(curve, n, density)
    mesh = curves.domain_mesh(curve, t)
    ring = np.column_stack(curve(t))
    assert np.array_equal(mesh.nodes[:n], ring)
    assert np.flatnonzero(mesh.boundary_nodes).tolist() == list(range(n))
    assert mesh.domain_area == pytest.approx(polygon_area(ring))
    assert mesh.n_elements == 2 * (mesh.n_nodes - 1) - n


def test_inner_nodes_keep_their_distance():
    """A lattice of equilateral triangles, and no needle at the boundary."""
    mesh = curves.domain_mesh(circle, curves.boundary_parameters(circle, 40))
    shape = quality(mesh)
    assert shape.mean["maximum_angle"] < 70 and shape.max["maximum_angle"] < 120
    coarse = curves.domain_mesh(circle, curves.boundary_parameters(circle, 40), spacing=0.5)
    assert 40 < coarse.n_nodes < mesh.n_nodes


# -- what is refused --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "call, message",
    [
        (
            lambda: curves.equidistributed([1, -1], 2),
            "range: the density of sample 1 is -1.0; give finite numbers of at least 0",
        ),
        (
            lambda: curves.equidistributed([0, 0], 2),
            "range: the density is 0 everywhere, so that no place is better than another; "
            'use density="length"',
        ),
        (lambda: curves.equidistributed([1, 1], 0), "range: n is 0; give a whole number of at least 1"),
        (lambda: curves.boundary_parameters(circle, 2), "range: n is 2; give a whole number of at least 3"),
        (
            lambda: curves.boundary_parameters(circle, 9, "curvatur"),
            "unknown: density 'curvatur' is not known; did you mean 'curvature'? "
            "(known: 'curvature', 'length', 'parameter')",
        ),
        (lambda: curves.boundary_parameters(circle, 9, even=2), "range: even is 2; give a share from 0 to 1"),
        (
            lambda: curves.boundary_parameters(circle, 9, lambda x, y: x / 0 * 0),
            "finite: the function must return one finite value for each point of the curve",
        ),
        (
            lambda: curves.boundary_parameters(lambda t: (t, t), 9),
            "closed: the curve is at (0, 0) for t = 0 and at (1, 1) for t = 1; give a closed one",
        ),
        (
            lambda: curves.boundary_parameters(lambda t: (t, np.nan * t), 9),
            "finite: the curve must return finite x and y for every t from 0 to 1",
        ),
        (
            lambda: curves.boundary_parameters("circle", 9),
            "type: the curve is a str; give a function of t that returns x and y",
        ),
        (
            lambda: curves.deviation(circle, [0, 0.5]),
            "shape: parameters have shape (2,); give one number for each of at least 3 nodes",
        ),
        (
            lambda: curves.deviation(circle, [0, 0.5, 0.25]),
            "order: parameter 2 is 0.25, which does not follow 0.5; give them ascending, within one period",
        ),
        (
            lambda: curves.domain_mesh(circle, [0, 0.5, 1]),
            "order: parameter 0 is 0, which does not follow 1; give them ascending, within one period",
        ),
        (
            lambda: curves.domain_mesh(lambda t: circle(-t), [0, 0.3, 0.6]),
            "orientation: the curve goes round clockwise; reverse its parameter",
        ),
        (
            lambda: curves.domain_mesh(circle, [0, 0.3, 0.6], spacing=0),
            "range: spacing is 0; give a finite length above 0",
        ),
        (
            lambda: curves.domain_mesh(limacon, np.arange(16) / 16),
            "boundary: boundary nodes 5 and 6 are not joined in the Delaunay mesh; "
            "give more boundary nodes or a larger spacing",
        ),
    ],
)
def test_messages(call, message):
    with np.errstate(all="ignore"), pytest.raises(MeshError) as error:
        call()
    assert str(error.value) == message
