"""The studies of sections 7.1, 7.2 and 7.5: what their tables and figures are made of."""

import numpy as np
import pytest

from meshlib import Interpolant, combined, delaunay, problems, refined
from meshlib.mesh.quality import angles
from meshlib.refinement.marking import MARKS
from meshlib.refinement.splitting import SPLITS
from meshlib.thesis.studies import section_7_1_splittings as splittings
from meshlib.thesis.studies import section_7_2_boundaries as boundaries
from meshlib.thesis.studies import section_7_5_combining as combining
from meshlib.thesis.studies.section_7_1_splittings import AIM, MOST_NODES, Rounds, rounds
from meshlib.thesis.tables import section_7_1, section_7_2, section_7_5


def rows(table):
    """The cells of a numbered table, without its head."""
    lines = [line for line in table.data.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


# -- 7.1 ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("split", SPLITS)
def test_rounds_end_at_the_aim_or_at_the_limit(split):
    found = rounds("SR1", split, "element")
    reached = found.errors <= AIM * found.errors[0]
    assert not reached[:-1].any() and (found.nodes[:-1] < MOST_NODES).all()
    assert reached[-1] or found.nodes[-1] >= MOST_NODES
    assert np.isnan(found.needed) == (not reached[-1])
    assert (np.diff(found.nodes) > 0).all()
    found.meshes[3].validate()


def test_the_number_needed_lies_on_a_line_between_two_rounds():
    """On a double logarithmic plot: 100 nodes at 4 %, 400 at 0.25 %, so 200 at 1 %."""

    class Sized:
        def __init__(self, n_nodes):
            self.n_nodes = n_nodes

    meshes = [Sized(n) for n in (10, 100, 400)]
    assert Rounds(meshes, np.array([2, 0.08, 0.005]), 1.0).needed == pytest.approx(200)
    assert np.isnan(Rounds(meshes, np.array([2, 0.08, 0.021]), 1.0).needed)


@pytest.mark.parametrize("mark", MARKS)
def test_bisection_of_longest_edges_halves_no_angle_of_the_start(mark):
    """Rosenberg and Stenger (1975): never below half of the smallest."""
    found = rounds("SR2", "longest-edge", mark).smallest_angles
    assert found.min() >= found[0] / 2 and found.min() > 15


@pytest.mark.parametrize("mark", MARKS)
def test_green_closure_halves_some_angles_once(mark):
    """Every angle is one of the start or of the bisection of one of its elements, however many rounds."""
    found = rounds("SR2", "red-green", mark).smallest_angles
    assert found[-1] == pytest.approx(found[len(found) // 2]) and found[-1] > 7


@pytest.mark.parametrize("mark", ["edge", "density"])
def test_midpoint_insertion_cuts_no_edge(mark):
    """So the error on the edges of the start stays, and angles shrink in geometric progression."""
    found = rounds("SR3", "centroid", mark)
    start, end = found.meshes[0], found.meshes[-1]
    assert {tuple(e) for e in start.edges.tolist()} <= {tuple(e) for e in end.edges.tolist()}
    u = problems.functions["SR3"]
    middles = start.nodes[start.edges].mean(axis=1)
    before, after = (Interpolant(mesh, u)(*middles.T) for mesh in (start, end))
    assert np.allclose(before, after, atol=1e-9)
    assert np.isnan(found.needed) and found.smallest_angles[-1] < 1e-3


def test_marking_by_density_starves_the_rest():
    """Cost falls like h and area like h^2: the smaller an element, the likelier it is split again."""
    found = rounds("SR1", "longest-edge", "density")
    early, late = found.meshes[6], found.meshes[-1]
    assert late.areas.min() < early.areas.min() / 30 and late.areas.max() == pytest.approx(early.areas.max())
    assert found.errors[-1] > 0.9 * found.errors[6]


def test_a_red_element_takes_its_neighbours_along():
    """All of a lattice marked: nothing else changes; a single one: three more."""
    mesh = delaunay([(i, j) for i in range(5) for j in range(5)])
    all_of_it = refined(mesh, np.zeros(25), fraction=1)
    assert (np.bincount(all_of_it.parents) != 1).sum() == len(all_of_it.marked)
    for function in ("SR1", "SR2"):
        red, longest = (rounds(function, split, "element").changed for split in ("red-green", "longest-edge"))
        assert red > 1.5 * longest > 1.5
        assert rounds(function, "centroid", "element").changed == 1


def test_the_tables_of_7_1(monkeypatch):
    monkeypatch.setattr(splittings, "FUNCTIONS", ("SR1",))
    needed = rows(section_7_1.needed())
    assert [row[:2] for row in needed] == [["SR1", "red-green"], ["", "centroid"], ["", "longest-edge"]]
    for row in needed:
        for mark, cell in zip(splittings.MARKINGS, row[2:], strict=True):
            found = rounds("SR1", row[1], mark)
            assert cell.startswith("(") == np.isnan(found.needed)
            value = 100 * found.errors[-1] / found.errors[0] if cell.startswith("(") else found.needed
            assert float(cell.strip("()")) == pytest.approx(value, rel=6e-3)
    reasons = rows(section_7_1.reasons())
    assert [row[4] for row in reasons] == [
        f"{rounds('SR1', split, 'element').mean_largest_angle:.0f}°" for split in SPLITS
    ]
    kinks = [float(row[5].strip("°")) for row in reasons]
    assert kinks[1] > 179 and max(kinks[0], kinks[2]) < 15  # only where no edge is cut do they get steeper


# -- 7.2 ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", boundaries.CURVES)
@pytest.mark.parametrize("density", boundaries.DENSITIES)
def test_the_area_lost_tends_to_its_limit(name, density):
    found, limit = boundaries.lost(name, density), boundaries.limits(name)[density]
    assert found[-1] == pytest.approx(limit, rel=4e-3)
    assert (np.diff(found) > 0).all() and (found < limit).all()


def test_the_limits_in_closed_form():
    """Affine length cubed over 12, and for equal arcs of a convex curve pi l^2 / 6."""
    ellipse = boundaries.limits("ellipse")
    assert ellipse["curvature"] == pytest.approx(2 * np.pi**3 * 4 / 3)
    x, y = boundaries.ellipse(np.linspace(0, 1, 20_001))
    assert ellipse["length"] == pytest.approx(np.pi * np.hypot(np.diff(x), np.diff(y)).sum() ** 2 / 6)
    assert ellipse["parameter"] == pytest.approx(ellipse["curvature"])


def test_the_table_of_measures_knows_the_sum_of_valences():
    for name, n_nodes, n_elements, *_, mean, most in rows(section_7_2.measures()):
        assert float(mean) == pytest.approx(3 * int(n_elements) / int(n_nodes), abs=6e-4), name
        assert int(most) >= float(mean)


def test_the_table_of_areas_ends_with_the_limits():
    found = [float(row[-1]) for row in rows(section_7_2.lost())]
    assert found == pytest.approx(
        [v for name in boundaries.CURVES for v in boundaries.limits(name).values()], abs=6e-3
    )


def test_the_error_along_the_boundary_tends_to_its_limit():
    """Between nodes placed by the data; equal arcs are fifty times worse on a narrow cliff."""
    by_data, even = (boundaries.missed("trefoil", "SR1", by_data) for by_data in (True, False))
    limit = boundaries.missed_limit("trefoil", "SR1")
    assert by_data[-1] == pytest.approx(limit, rel=0.02) and (np.diff(by_data) < 0).all()
    assert even[-1] > 45 * limit
    (first, second) = rows(section_7_2.missed())
    assert [float(cell) for cell in first[1:]] == pytest.approx([*by_data, limit], abs=6e-4)
    assert [float(cell) for cell in second[1:-1]] == pytest.approx(even, abs=6e-4)


# -- 7.5 ------------------------------------------------------------------------------------------


def test_the_table_of_the_cycle():
    assert rows(section_7_5.cycle()) == [
        ["left out", "swap around node 4", "2.86", "9.50", "7.68"],
        ["", "swap around node 5", "2.43", "7.68", "9.50"],
        ["counted", "swap around node 4", "1.82", "9.50", "7.68"],
        ["", "swap around node 5", "2.68", "7.68", "5.00"],
    ]


def test_the_table_of_errors(monkeypatch):
    monkeypatch.setattr(combining, "FUNCTIONS", ("SR1",))
    ((_, start, swapped, moved, in_turn, both, free, flat),) = rows(section_7_5.errors())
    assert float(start) > float(swapped) > float(moved) > float(both) >= float(in_turn) > float(free)
    few, all_of_them = map(int, flat.split(" of "))
    assert all_of_them / 2 <= few <= all_of_them  # where nothing moves, what cannot be mended is made thin
    mesh = combining.adapted("SR1").mesh
    assert np.degrees(angles(mesh.corners).min()) == pytest.approx(10, abs=0.01)


def test_the_table_of_gains(monkeypatch):
    monkeypatch.setattr(combining, "POWERS", (1, 2, 3))
    found = rows(section_7_5.gains())
    steps, errors = ([float(row[k]) for row in found] for k in (1, 3))
    assert steps == sorted(steps) and errors == sorted(errors, reverse=True)
    assert all(n <= 10**power for n, power in zip(steps, (1, 2, 3), strict=True))


def test_in_turn_ends_where_neither_way_gains():
    mesh = combining.in_turn("SR2")
    assert np.degrees(angles(mesh.corners).min()) > 9.99
    for way in ("swap", "move"):
        assert not len(combined(mesh, problems.SR2, ways=way, min_angle=combining.LIMIT).history)


# -- figures --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "draw, panels",
    [
        ("splittings.splittings_compared", 2),
        ("splittings.splittings_meshes", 3),
        ("boundaries.boundaries_compared", 4),
        ("combining.combining_cycle", 3),
        ("combining.combining_compared", 6),
    ],
)
def test_figures_draw_something(draw, panels, monkeypatch):
    plt = pytest.importorskip("matplotlib.pyplot")
    import importlib

    module, name = draw.split(".")
    module = importlib.import_module(f"meshlib.thesis.figures.{module}")
    monkeypatch.setattr(splittings, "FUNCTIONS", ("SR1",))
    figure = getattr(module, name)(
        *{"splittings_meshes": ["SR1"], "combining_compared": ["SR1"]}.get(name, [])
    )
    assert plt.get_fignums() == [figure.number]
    assert len(figure.axes) == panels and all(ax.has_data() for ax in figure.axes)
    plt.close(figure)


def test_the_cycle_is_shown_step_by_step():
    """(a) and (c) are the same mesh; (b) has one edge that they do not have."""
    pytest.importorskip("matplotlib.pyplot")
    from meshlib.thesis.figures import combining as figures

    (first, second, third), _ = figures._meshes()
    assert first.equals(third)
    a, b = ({tuple(e) for e in mesh.edges.tolist()} for mesh in (first, second))
    assert (a - b, b - a) == ({(3, 4)}, {(0, 5)})
