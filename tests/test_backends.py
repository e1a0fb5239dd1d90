"""The compiled procedure against an independent one, and numba against plain Python."""

import importlib.util
import json
import os
import subprocess
import sys

import numpy as np
import pytest
import reference
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import lattice, shuffled

from meshlib import delaunay, problems, swapped
from meshlib.mesh.topology import canonical

NAMES = ("jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle")
NORMS = (1, 2, "max")
DECIMALS = 1 / 40  # all nodes of the thesis are multiples of it
LIMITS = ({}, {"min_angle": 10}, {"min_area": 0.01}, {"min_angle": 3, "min_area": 1e-3})


def rows(trace):
    """What was tried, each edge seen from its smaller node: a-b with c, d is b-a with d, c."""
    return [
        (
            r["sweep"],
            r["edge"],
            *min((r["a"], r["b"], r["c"], r["d"]), (r["b"], r["a"], r["d"], r["c"])),
            r["accepted"],
        )
        for r in trace
    ]


def assert_same(mesh, values, name, norm, **arguments):
    ours = swapped(mesh, values, name, norm=norm, **arguments)
    theirs = reference.result(mesh, values, name, norm=norm, **arguments)
    assert (ours.swaps, ours.sweeps, ours.tried) == (theirs.swaps, theirs.sweeps, theirs.tried)
    assert np.array_equal(canonical(ours.mesh.elements), theirs.elements)
    assert rows(ours.history) == rows(theirs.trace)
    for field in ("old", "new"):  # small costs are differences of large gradients
        noise = 1e-12 * theirs.trace[field].max(initial=0)
        assert np.allclose(ours.history[field], theirs.trace[field], rtol=1e-12, atol=noise)
    return ours


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("norm", NORMS)
@pytest.mark.parametrize("problem, function", [("33", "SR1"), ("33", "DD1"), ("81", "SR3")])
def test_on_the_problems_of_the_thesis(name, norm, problem, function):
    mesh = shuffled(problems.mesh(problem), np.random.default_rng(7), steps=60, unit=DECIMALS)
    values = problems.functions[function](*mesh.nodes.T)
    found = assert_same(mesh, values, name, norm, order=np.random.default_rng(3).permutation(mesh.n_edges))
    assert found.swaps > 0


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("limits", LIMITS[1:])
def test_with_limits(name, limits):
    mesh = problems.mesh("33")
    values = problems.functions["SR2"](*mesh.nodes.T)
    for norm in NORMS:
        found = assert_same(mesh, values, name, norm, **limits)
        assert found.tried <= swapped(mesh, values, name, norm=norm).tried or found.sweeps > 1


@settings(max_examples=150)
@given(
    problems_of(scales=(1.0, 2.0**-20, 2.0**20)),
    st.sampled_from(NAMES),
    st.sampled_from(NORMS),
    st.sampled_from(LIMITS),
    st.integers(0, 999),
)
def test_on_lattices_with_small_integers(problem, name, norm, limits, seed):
    mesh, values = problem
    assert_same(
        mesh, values, name, norm, order=np.random.default_rng(seed).permutation(mesh.n_edges), **limits
    )


@settings(max_examples=80)
@given(problems_of(scales=(1.0,)), st.sampled_from(NAMES), st.sampled_from(NORMS), st.integers(0, 999))
def test_on_noisy_data(problem, name, norm, seed):
    mesh, _ = problem
    rng = np.random.default_rng(seed)
    assert_same(mesh, rng.standard_normal(mesh.n_nodes), name, norm, order=rng.permutation(mesh.n_edges))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("norm", NORMS)
def test_a_last_sweep_without_a_try_counts_too(name, norm):
    """One quadrilateral, swapped; the limit forbids trying the way back."""
    mesh = shuffled(delaunay([[0, 0], [3, -1], [6, 0], [3, 1]]), np.random.default_rng(0), steps=1)
    for limits in ({}, {"min_angle": 25}, {"min_angle": 50}):
        assert_same(mesh, np.array([0.0, 1, 0, 0]), name, norm, **limits)


# -- numba against plain Python ---------------------------------------------------------------

PROGRAM = """
import json, sys
import numpy as np
from meshlib import problems, swapped, smoothed, refined
from meshlib.kernels import ANY, for_work
found = {"backend": for_work(ANY).name}
for name in ("jnd", "abn", "dlp", "dfp", "smallest-angle", "largest-angle"):
    for norm in (1, 2, "max"):
        for problem, function in (("33", "SR2"), ("81", "SR3")):
            start = problems.mesh(problem)
            order = np.random.default_rng(5).permutation(start.n_edges)
            r = swapped(start, problems.functions[function], name, norm=norm, order=order, min_angle=2)
            t = r.history
            found[f"{name} {norm} {problem}"] = [r.swaps, r.sweeps, r.tried, r.mesh.elements.tolist(),
                t[["edge", "a", "b", "c", "d", "accepted"]].tolist(), t["old"].tolist(), t["new"].tolist()]
springs = np.random.default_rng(5).random(88)
moved = smoothed(problems.mesh("33"), springs)
found["smoothed"] = [moved.sweeps, moved.refused, moved.mesh.nodes.tolist()]
json.dump(found, sys.stdout)
"""


def run(program, backend):
    """What a fresh interpreter with this backend prints."""
    environment = {**os.environ, "MESHLIB_BACKEND": backend}
    return subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False
    )


def test_numba_and_python_agree():
    pytest.importorskip("numba")
    compiled, plain = (json.loads(run(PROGRAM, name).stdout) for name in ("numba", "python"))
    assert (compiled.pop("backend"), plain.pop("backend")) == ("numba", "python")
    first, second = compiled.pop("smoothed"), plain.pop("smoothed")
    assert first[:2] == second[:2] and np.allclose(first[2], second[2], rtol=0, atol=1e-14)
    for case in plain:
        assert compiled[case][:5] == plain[case][:5], case
        assert np.allclose(compiled[case][5:], plain[case][5:], rtol=1e-12, atol=1e-15), case


# Which of both runs, and that it does not matter: lines of results, each with whether numba is loaded.
FRESH = """
import json, sys
import numpy as np
from meshlib import Interpolant, criteria, delaunay, problems, smoothed, swapped
def show(r, *more):
    t = r.history
    exact = [r.swaps, r.sweeps, r.tried, r.mesh.elements.tolist(), t[["edge", "a", "b", "c", "d"]].tolist()]
    near = [r.cost_before, r.cost_after, *t["old"].tolist(), *t["new"].tolist(), *more]
    print(json.dumps(["numba" in sys.modules, exact, near]))
"""
SMALL = (
    FRESH
    + """
for name in ("33", "81"):
    mesh = problems.mesh(name)
    for schedule in ("sweep", "queue"):
        error = Interpolant(mesh, problems.SR2).l2_error(problems.SR2)
        show(swapped(mesh, problems.SR2, schedule=schedule), error, *smoothed(mesh).mesh.nodes.ravel())
"""
)
LARGE = (
    FRESH
    + """
mesh = delaunay(np.random.default_rng(0).random((4100, 2)))
show(swapped(mesh, problems.SR2))
"""
)
MANY_SMALL = (
    FRESH
    + """
from meshlib import kernels
mesh = problems.mesh("33")
kernels.PRICE = 3 * 25 * mesh.n_edges  # of three runs: a result, its trace, and another result
for order in (None, np.arange(mesh.n_edges)[::-1]):
    show(swapped(mesh, problems.SR2, order=order))
"""
)
OWN = (
    FRESH
    + """
def rise(ax, ay, au, bx, by, bu, cx, cy, cu):
    return abs(au - bu) + abs(bu - cu)

own = criteria.pointwise("own", "element", rise)
show(swapped(problems.mesh("33"), problems.SR2, own, norm=1))
"""
)


@pytest.mark.parametrize(
    "program, loaded", [(SMALL, [False] * 4), (LARGE, [True]), (MANY_SMALL, [False, True]), (OWN, [True])]
)
def test_numba_is_loaded_where_it_pays_and_nothing_else_depends_on_it(program, loaded):
    pytest.importorskip("numba")
    by_itself, compiled, plain = (
        [json.loads(line) for line in run(program, name).stdout.splitlines()]
        for name in ("auto", "numba", "python")
    )
    assert [line[0] for line in by_itself] == loaded
    assert [line[0] for line in compiled + plain] == [True] * len(loaded) + [False] * len(loaded)
    for other in (compiled, plain):
        for (_, exact, near), (_, same, close) in zip(by_itself, other, strict=True):
            assert exact == same
            assert np.allclose(near, close, rtol=1e-12, atol=1e-12)


def test_an_unknown_backend_is_named():
    result = run("from meshlib.kernels import for_work; for_work(1)", "nuba")
    assert result.returncode == 1
    assert result.stderr.splitlines()[-1] == (
        "meshlib.errors.UnknownNameError: unknown: MESHLIB_BACKEND 'nuba' is not known; "
        "did you mean 'numba'? "
        "(known: 'auto', 'numba', 'python')"
    )


def test_without_numba_the_extra_is_named():
    hidden = (
        "import sys; sys.modules['numba'] = None\n"
        "from meshlib.kernels import ANY, for_work\nprint(for_work(ANY).name)"
    )
    assert run(hidden, "auto").stdout == "python\n"
    last = run(hidden, "numba").stderr.splitlines()[-1]
    assert last.startswith("ImportError: numba is needed here: pip install '") and last.endswith("[fast]'")


def test_the_backend_of_this_run_is_the_one_asked_for():
    from meshlib.kernels import ANY, for_work

    installed = importlib.util.find_spec("numba") is not None
    asked = os.environ.get("MESHLIB_BACKEND", "auto")
    assert ("numba" if asked != "python" and installed else "python") == for_work(ANY).name


def test_core_needs_neither_numba_nor_matplotlib():
    """numpy and scipy are enough for everything but figures and widgets."""
    hidden = (
        "import sys\nfor name in ('numba', 'matplotlib', 'ipywidgets', 'anywidget', 'meshio'):\n"
        "    sys.modules[name] = None\n"
        "from meshlib import problems, swapped\n"
        "print(swapped(problems.mesh('33'), problems.functions['SR2']).swaps)"
    )
    result = run(hidden, "auto")
    assert result.stdout.strip() == str(swapped(problems.mesh("33"), problems.functions["SR2"]).swaps), (
        result.stderr
    )


def test_a_large_lattice_in_reasonable_time():
    """2,601 nodes; the result is the same whatever the backend, here as a count."""
    mesh = delaunay(lattice(50, 50) / 50)
    result = swapped(mesh, problems.functions["SR2"])
    assert result.mesh.validate().counts == mesh.counts and result.swaps > 1000
