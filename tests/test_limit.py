"""The limit of linear interpolation, its constants in closed form, and condition numbers."""

import numpy as np
import pytest
from scipy.integrate import quad
from support import lattice

from meshlib import Interpolant, Mesh, delaunay, problems
from meshlib.thesis.studies import section_7_7a_limit as limit
from meshlib.thesis.studies import section_7_7b_conditioning as conditioning

F = problems.functions
QUADRATIC = {"convex": (4 * 4 / 45) ** 0.5, "hyperbolic": (4 / 90) ** 0.5, "product": (1 / 90) ** 0.5}


@pytest.mark.parametrize("name", QUADRATIC)
def test_the_constant_of_a_quadratic_is_known(name):
    assert limit.constant(F[name], cells=20) == pytest.approx(QUADRATIC[name], rel=1e-5)


@pytest.mark.parametrize("name, known", [("Franke", 0.97625), ("SR3", 0.07928), ("ring", 3.5348)])
def test_the_constant_has_settled(name, known):
    """Half the cells along a side, and a value found by another quadrature."""
    u = limit.FUNCTIONS[name]
    assert limit.limit(name) == pytest.approx(known, rel=2e-4)
    assert limit.constant(u, cells=500) == pytest.approx(limit.limit(name), rel=1e-4)


def test_the_constant_of_a_radial_function_is_an_integral_along_the_radius():
    """The spike of DD1: det = 2.1^2 u'' u' / r, and areas shrink by 2.1."""

    def density(r):
        det = 2.1**2 * (-8 * np.pi**2 * np.cos(4 * np.pi * r)) * (-2 * np.pi * np.sin(4 * np.pi * r)) / r
        return np.cbrt((limit.DEFINITE if det > 0 else limit.INDEFINITE) * abs(det)) * 2 * np.pi * r / 2.1

    parts = [quad(density, *ends)[0] for ends in ((1e-12, 0.125), (0.125, 0.25))]
    assert sum(parts) ** 1.5 == pytest.approx(0.29798, abs=1e-5)
    assert limit.limit("DD1") == pytest.approx(sum(parts) ** 1.5, rel=1e-3)


def test_no_mesh_is_below_the_limit_of_a_quadratic(rng):
    """Part (a) of the theorem, which holds for every mesh, and 1 where all elements are best."""
    for name, bound in QUADRATIC.items():
        meshes = [delaunay(np.concatenate([lattice(1, 1), rng.random((n, 2))])) for n in (0, 5, 50)]
        found = [limit.efficiency(mesh, F[name], bound) for mesh in meshes]
        assert min(found) >= 1 - 1e-12
    assert limit.efficiency(problems.mesh("81"), F["hyperbolic"], QUADRATIC["hyperbolic"]) == pytest.approx(1)


def test_an_equilateral_element_is_best_where_the_surface_is_round():
    """Its squared error is c |det H| A^3, and any other element's is larger."""
    for third, best in (((0.5, 0.75**0.5), True), ((0.4, 0.75**0.5), False)):
        mesh = Mesh([(0, 0), (1, 0), third], [(0, 1, 2)])
        square = Interpolant(mesh, F["convex"]).l2_error(F["convex"], rule="exact") ** 2
        least = limit.DEFINITE * 4 * mesh.domain_area**3
        assert square == pytest.approx(least) if best else square > 1.001 * least


def strips(cuts):
    """The unit square by lines x + y = const: one corner, two nodes on each line, the other corner."""
    ends = [((s, 0), (0, s)) if s < 1 else ((1, s - 1), (s - 1, 1)) for s in cuts]
    nodes = [(0, 0), *(p for pair in ends for p in pair), (1, 1)]
    rows = [(i, i + 1, i + 2) if i % 2 == 0 else (i, i + 2, i + 1) for i in range(len(nodes) - 2)]
    return Mesh(nodes, rows).validate()


@pytest.mark.parametrize("name, known", [("SR1", 0.0966), ("SR2", 0.4347)])
def test_the_constant_of_strips(name, known):
    u = limit.DIRECTED[name]
    assert limit.strip_constant(u) == pytest.approx(known, abs=5e-5)
    assert limit.strip_error(u, 102) == pytest.approx(known / 50**2, rel=1e-3)


def test_equal_strips_of_a_parabola_across():
    """(x + y)^2 has f'' = 4 across: m strips of the width that the length asks for."""

    def parabola(x, y):
        return (x + y) ** 2

    # K^(2/5) = integral of (16 l / 120)^(1/5) over s, l = 2 s to the middle at s = 1 / sqrt 2, twice
    half = (32 / 120) ** 0.2 * (0.5**0.5) ** 1.2 / 1.2
    assert limit.strip_constant(parabola) == pytest.approx((2 * half) ** 2.5, rel=1e-4)
    m = 400  # cuts at equal shares of the integral, which grows as s^(6/5)
    shares = np.arange(1, m // 2 + 1) / (m / 2)
    cuts = np.concatenate([shares ** (1 / 1.2), 2 - shares[-2::-1] ** (1 / 1.2)])
    found = limit.error(strips(cuts), parabola)
    assert found == pytest.approx(limit.strip_constant(parabola) / m**2, rel=0.01)


def test_a_zigzag_has_three_quarters_of_the_error_of_strips():
    """One element of each, long along the contours: the third node at the end and half way."""

    def across(x, y):
        return x**2

    errors = [
        Interpolant(mesh, across).l2_error(across, rule="exact")
        for mesh in (Mesh([(0, 0), (1, 0), (top, 9)], [(0, 1, 2)]) for top in (1, 0.5))
    ]
    assert errors[1] / errors[0] == pytest.approx(limit.ZIGZAG)


# -- conditioning ----------------------------------------------------------------------------


def test_the_matrix_of_a_lattice_is_the_five_point_stencil():
    """Eigenvalues 4 - 2 cos(k pi h) - 2 cos(l pi h), so the condition number is cot^2(pi h / 2)."""
    for n in (3, 6, 8):
        mesh = delaunay(lattice(n, n) / n)
        plain, scaled = conditioning.conditions(mesh)
        assert plain == pytest.approx(np.tan(np.pi / (2 * n)) ** -2)
        assert scaled == pytest.approx(plain)
        assert np.diag(conditioning.stiffness(mesh)) == pytest.approx(4)


def test_scaling_the_domain_changes_no_condition_number():
    mesh = problems.mesh("33")
    larger = Mesh(1000 * mesh.nodes, mesh.elements)
    assert conditioning.conditions(larger) == pytest.approx(conditioning.conditions(mesh))


def test_thin_elements_spoil_the_condition():
    """The 33 nodes of the thesis, Delaunay and swapped for SR1: eight times worse."""
    from meshlib.thesis.studies.experiments import run

    start, swapped = (conditioning.conditions(run(key).mesh)[0] for key in ("start-33", "SR1-33-ABN-L1"))
    assert start == pytest.approx(13.3, abs=0.05) and swapped == pytest.approx(108.6, abs=0.05)


# -- what is shown ---------------------------------------------------------------------------


def test_terrain_made_for_it_is_nearer_than_a_lattice():
    ground = limit.terrain()
    made, regular = (np.sqrt((ground.differences(s) ** 2).mean()) for s in (ground.made, ground.regular))
    assert ground.made.mesh.n_nodes == ground.regular.mesh.n_nodes == limit.TERRAIN_NODES
    assert made < 0.65 * regular
    corners = ground.heights[[0, 0, -1, -1], [0, -1, 0, -1]]
    rows, columns = ground.heights.shape
    assert ground.made([0, columns - 1] * 2, [0, 0, rows - 1, rows - 1]) == pytest.approx(corners)


def test_the_hole_stays():
    start, found = limit.square_with_hole(), limit.around_hole().mesh
    assert start.domain_area == pytest.approx(found.domain_area)
    sector = np.sin(2 * np.pi / limit.HOLE_SIDES) / 2 * limit.HOLE_RADIUS**2
    assert found.validate().domain_area == pytest.approx(1 - limit.HOLE_SIDES * sector)
