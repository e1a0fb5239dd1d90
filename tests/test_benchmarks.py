"""What the benchmarks measure and report of meshes made for functions."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from support import lattice

from meshlib import Mesh, delaunay, problems

sys.path.insert(0, str(Path(__file__).parents[1] / "benchmarks"))
import approximation
import remeshing
import report
import report_approximation as page
import run


def made(function, nodes, who="ours", **numbers):
    """A line as `approximation.line` writes it."""
    return {
        "function": function,
        "who": who,
        "nodes": nodes,
        "found": nodes,
        "elements": 2 * nodes,
        "seconds": 1.0,
        "valid": True,
    } | numbers


LINES = [
    *(
        made("ring", 6400, seed=k, error=e, claimed=e, seconds=s)
        for k, e, s in ((0, 1e-4, 3.0), (1, 2e-4, 5.0), (2, 1e-4, 4.0))
    ),
    made("ring", 25_600, error=2.5e-5, claimed=2.51e-5, seconds=20.0),
    made("ring", 6400, "mmg2d", error=9e-5, found=12_800, floor=0.1, seconds=2.0),
    made("ring", 6400, "mmg2d", error=1.5e-4, floor=0.01, seconds=7.0),
    made("ring", 6400, "pydelatin", error=3e-4, largest=0.2),
    made("ring", 6400, "ours, max", error=2e-4, largest=0.1),
    made("SR1", 402, error=2e-6, claimed=2e-6),
    made("SR1", 402, "mmg2d", error=1e-6, found=804, floor=0.1, seconds=2.0),
    made("SR1", 402, "tolerance", error=1e-6, found=412, bisected=400),
]


@pytest.fixture
def results(monkeypatch):
    monkeypatch.setattr(
        page, "results", lambda: {"approximate": {"lines": LINES, "B": {"ring": 2.0}, "K": {"SR1": 0.1}}}
    )


def test_measures_of_lines(results):
    assert page.efficiency("ring", 6400) == pytest.approx(2e-4 * 12_800 / 2)  # of the worst seed
    assert page.efficiency("SR1", 402) is None and page.efficiency("ring", 100) is None
    assert page.over_strips("SR1", 402) == pytest.approx(2e-6 * 200**2 / 0.1)
    assert page.greedy_error("ring", 6400) == pytest.approx(3)
    assert page.greedy_largest("ring", 6400) == pytest.approx(2)
    assert page.growth("ring", 25_600) == pytest.approx(20 / 4)
    assert page.unconfirmed("ring", 25_600) == pytest.approx(0.4)
    assert page.tolerance("SR1", 402) == pytest.approx(1.03)


def test_errors_are_compared_at_equal_nodes(results):
    """A mesh of twice the nodes has half the error, or a quarter of it where one direction is all."""
    assert page.best_remeshed("ring", 6400)["floor"] == 0.01  # 1.5e-4 at 6400 nodes, not 9e-5 at 12,800
    assert page.mmg_error("ring", 6400) == pytest.approx(1.5)
    assert page.mmg_time("ring", 6400) == pytest.approx(4 / 7)
    assert page.mmg_error("SR1", 402) == pytest.approx(4 * 1e-6 / 2e-6)


def test_the_worst_decides(results):
    assert page.worst(page.mmg_error, None, None, ">=") == (pytest.approx(1.5), "ring", 6400)
    assert page.worst(page.growth, None, (100,), "<=") is None
    rows = page.goals().data.splitlines()[2:]
    assert len(rows) == len(page.GOALS)
    verdicts = {row.split(" | ")[0].strip("| "): row.rstrip("| ").split(" | ")[-1] for row in rows}
    assert verdicts["$L_2$ error of MMG / ours, anywhere"] == "met"
    assert verdicts["error / error of parallel strips"] == "met"
    assert verdicts["time / time for a quarter of the nodes"] == "met"
    assert verdicts["nodes for a tolerance / fewest by bisection"] == "met"
    assert verdicts["the same on a front that leaves the domain, and on a mixture"].strip() == "not measured"


def test_what_falls_short_says_what_no_mesh_could_do(results, monkeypatch):
    assert "pydelatin" not in page.falls_short().data
    better = [row | {"error": 1.6e-4} if row["who"] == "pydelatin" else row for row in LINES]
    monkeypatch.setattr(
        page, "results", lambda: {"approximate": {"lines": better, "B": {"ring": 2.0}, "K": {"SR1": 0.1}}}
    )
    (text,) = (t for t in page.falls_short().data.split("\n\n") if "of pydelatin" in t)
    assert "1.6 instead of 1.7 for ring on 6,400 nodes" in text
    assert "1.02 times above the limit" in text  # 1.6e-4 * 12,800 / 2


def test_no_results_no_verdicts(monkeypatch):
    monkeypatch.setattr(page, "results", dict)
    assert page.goals().data.count("not measured") == len(page.GOALS)
    assert page.falls_short().data == "All goals that were measured are met."


def test_the_limit_of_a_panel(results):
    assert page.least("ring", 100) == pytest.approx(2 / 200)
    assert page.least("SR1", 402) == pytest.approx(0.75 * 0.1 / 200**2)


# -- measuring ---------------------------------------------------------------------------------


def test_the_confirming_quadrature_finds_what_is_known_and_what_is_small():
    assert approximation.confirmed(problems.mesh("81"), problems.functions["convex"]) == pytest.approx(
        0.0054625461, rel=1e-8
    )

    def spike(x, y):  # of width 0.005, on two elements
        return np.exp(-((x - 0.5) ** 2 + (y - 0.25) ** 2) / (2 * 0.005**2))

    mesh = delaunay(lattice(1, 1))
    assert approximation.confirmed(mesh, spike) == pytest.approx(np.sqrt(np.pi) * 0.005, rel=1e-3)


def test_the_largest_error_of_a_paraboloid_is_the_square_of_the_circumradius():
    mesh = delaunay(lattice(4, 4) / 4)
    assert approximation.largest(mesh, problems.functions["convex"]) == pytest.approx(1 / 32, rel=1e-3)


def test_floors_are_tuned_with_few_nodes():
    row = {"who": "mmg2d", "error": 1.0, "found": 100}
    before = [
        row | {"nodes": 1600, "floor": floor, "error": abs(k - 2) + 0.1}
        for k, floor in enumerate(approximation.FLOORS)
    ]
    assert approximation.floors_for(1600, before) == approximation.FLOORS
    assert approximation.floors_for(6400, []) == approximation.FLOORS
    assert approximation.floors_for(6400, before) == approximation.FLOORS[1:4]


def test_the_metric_is_optimal_for_a_quadratic():
    """|det H|^(-1/6) |H| for x^2 - y^2 is 4^(-1/6) 2 times the unit matrix; twice the nodes, twice that."""
    nodes, u = lattice(2, 2) / 2, problems.functions["hyperbolic"]
    found = remeshing.metrics(u, nodes, 1e-6, 1e-4, 1.0)
    assert found == pytest.approx(np.tile(2 * 4 ** (-1 / 6) * np.array([1.0, 0, 1]), (9, 1)), abs=1e-5)
    assert remeshing.metrics(u, nodes, 1e-6, 1e-4, 2.0) == pytest.approx(2 * found)


def test_a_run_renews_only_what_it_measures(tmp_path, monkeypatch):
    file, old = (
        tmp_path / "results.json",
        {"date": "then", "results": [{"measure": "grid"}], "approximate": {"date": "then", "lines": []}},
    )
    file.write_text(json.dumps(old))
    new = {"approximate": {"date": "now", "lines": [{"nodes": 100}, {"nodes": 400}]}}
    monkeypatch.setattr(run, "approximated", lambda chosen: new)
    run.main(["--nodes", "--sizes", "100", "--json", str(file)])
    assert json.loads(file.read_text()) == old | new
    monkeypatch.setattr(run, "timed", lambda chosen: {"date": "now", "results": []})
    run.main(["--nodes", "100", "--json", str(file)])
    assert json.loads(file.read_text()) == {"date": "now", "results": []} | new


def test_a_mesh_that_is_not_valid_is_noticed():
    assert approximation._valid(problems.mesh("33"))
    assert not approximation._valid(Mesh([(0, 0), (1, 0), (0, 1)], [(0, 2, 1)]))


def test_stored_results_have_every_function():
    """What the page shows is there: of every function at least one size, and all meshes valid."""
    stored = report.results()["approximate"]
    assert {row["function"] for row in stored["lines"]} == set(approximation.FUNCTIONS)
    assert set(stored["B"]) | set(stored["K"]) == set(approximation.FUNCTIONS)
    assert all(row["valid"] for row in stored["lines"] if row["who"] == "ours")
