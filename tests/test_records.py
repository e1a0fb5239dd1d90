"""What operations return: one base, one vocabulary, picklable; and the public face of the package."""

import inspect
import pickle
import subprocess
import sys

import numpy as np
import pytest

import meshlib as ml
from meshlib import problems

MESH, U = problems.mesh("33"), problems.SR2
RECORDS = {
    "swapped": lambda: ml.swapped(MESH, U, "abn", norm="L1"),
    "user-defined": lambda: ml.swapped(
        MESH, U, ml.criteria.Criterion("c", "element", lambda a, b, c: a[:, 2] ** 2)
    ),
    "refined": lambda: ml.refined(MESH, U),
    "smoothed": lambda: ml.smoothed(MESH),
    "following": lambda: ml.smoothed(MESH, ml.DataSprings(U), max_sweeps=3),
    "combined": lambda: ml.combined(MESH, U, max_sweeps=1),
    "annealed": lambda: ml.annealed(MESH, U, levels=2, tries=1),
    "local_optima": lambda: ml.local_optima(MESH, U, orders=4),
    "optimal": lambda: ml.optimal(MESH, U, "abn", norm="L1"),
    "approximate": lambda: ml.approximate(U, nodes=12),
}
OPERATIONS = (
    ml.swapped,
    ml.refined,
    ml.smoothed,
    ml.combined,
    ml.annealed,
    ml.local_optima,
    ml.optimal,
    ml.approximate,
)
POSITIONAL = {"mesh", "values", "function", "criterion", "springs"}


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_survives_pickling(name):
    record = RECORDS[name]()
    if name == "following":  # a wrapped function of the module, no lambda
        assert record.values == pytest.approx(U(*record.mesh.nodes.T))
    again = pickle.loads(pickle.dumps(record))
    assert isinstance(again, ml.Record) and again.mesh.equals(record.mesh)
    assert (again.cost_before, again.cost_after) == (record.cost_before, record.cost_after)
    if hasattr(record, "history"):
        assert np.array_equal(again.history, record.history)


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_shows_itself_in_one_line(name):
    record = RECORDS[name]()
    assert repr(record).startswith(f"{type(record).__name__}(mesh=Mesh(") and len(repr(record)) < 220
    assert "\n" not in repr(record) and "array" not in repr(record)


@pytest.mark.parametrize("name", RECORDS)
def test_the_interpolant_of_a_record_has_its_values_at_its_nodes(name):
    record = RECORDS[name]()
    if name == "smoothed":
        with pytest.raises(ml.InvalidInputError) as error:
            _ = record.interpolant
        assert str(error.value) == (
            "values: nodes have moved, and no function gives the values there; "
            "make Interpolant(record.mesh, u) with a function u"
        )
    else:
        assert record.interpolant(*record.mesh.nodes.T) == pytest.approx(record.values, abs=1e-12)


@pytest.mark.parametrize("operation", OPERATIONS, ids=lambda f: f.__name__)
def test_all_but_mesh_data_and_criterion_is_given_by_name(operation):
    kinds = {name: p.kind for name, p in inspect.signature(operation).parameters.items()}
    named = (inspect.Parameter.KEYWORD_ONLY, inspect.Parameter.VAR_KEYWORD)
    positional = {name for name, kind in kinds.items() if kind not in named}
    assert positional <= POSITIONAL


@pytest.mark.parametrize("one, other", [(1, "L1"), (2, "L2"), (np.inf, "max")])
def test_every_norm_has_two_spellings(one, other):
    assert ml.swapped(MESH, U, norm=one).mesh.equals(ml.swapped(MESH, U, norm=other).mesh)
    assert ml.criteria.prefers(MESH, MESH, U, norm=one) == ml.criteria.prefers(MESH, MESH, U, norm=other)
    if other != "L1":
        found = [ml.approximate(U, nodes=12, norm=norm) for norm in (one, other)]
        assert found[0].mesh.equals(found[1].mesh)


def test_smoothing_lowers_the_energy_of_its_springs():
    """Two springs from (0, 0) and (4, 0) to a node at (1, 1): at rest it is the mean of its neighbours."""
    corners = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1]]
    mesh = ml.Mesh(corners, [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    found = ml.smoothed(mesh)
    assert found.mesh.nodes[4] == pytest.approx([2, 2])
    assert found.cost_before == (4 * 16 + 2 + 10 + 18 + 10) / 2  # four sides; distances to the corners
    assert found.cost_after == pytest.approx((4 * 16 + 4 * 8) / 2)


def test_every_public_name_is_there():
    for name in ml.__all__:
        assert getattr(ml, name) is not None
    assert set(ml.__all__) <= set(dir(ml))


def test_modules_for_people_are_loaded_on_first_use():
    told = "print('meshlib.io' in sys.modules)"
    program = f"import sys, meshlib; {told}; meshlib.io; {told}"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\nTrue\n"


@pytest.mark.parametrize(
    "kind, call",
    [
        (ml.InvalidMeshError, lambda: ml.Mesh([[0, 0], [1, 0], [0, 1]], [[0, 2, 1]]).validate()),
        (ml.InvalidInputError, lambda: ml.swapped(MESH, [1.0, 2.0])),
        (ml.UnknownNameError, lambda: ml.swapped(MESH, U, "jmd")),
        (
            ml.CostError,
            lambda: ml.swapped(MESH, U, ml.criteria.Criterion("n", "element", lambda a, b, c: -a[:, 0] - 1)),
        ),
        (ml.NotReachedError, lambda: ml.optimal(MESH, U, "abn", seconds=0)),
    ],
    ids=lambda x: getattr(x, "__name__", ""),
)
def test_errors_have_kinds_and_survive_pickling(kind, call):
    with pytest.raises(kind) as caught:
        call()
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is kind and isinstance(again, ml.MeshError)
    assert (str(again), again.items, again.clause) == (
        str(caught.value),
        caught.value.items,
        caught.value.clause,
    )


def test_all_offending_items_are_listed():
    nodes = [[0, 0], [1, 0], [1, 1], [0, 1]]
    with pytest.raises(ml.InvalidMeshError) as caught:
        ml.Mesh(nodes, [[0, 2, 1], [0, 3, 2]]).validate()
    assert caught.value.items == (0, 1)
    assert str(caught.value) == (
        "orientation: element 0 with nodes (0, 2, 1) is clockwise; reverse its nodes (2 in all, see .items)"
    )


def test_elements_numbered_from_one_are_recognised():
    with pytest.raises(ml.InvalidMeshError) as caught:
        ml.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 2, 3], [1, 3, 4]]).validate()
    assert str(caught.value) == (
        "index range: element 1 names node 4; nodes are numbered 0 to 3; "
        "they seem to be numbered from 1: subtract 1"
    )
