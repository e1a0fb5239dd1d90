"""Whole messages: each names the offending item and the remedy, and nothing is changed."""

import numpy as np
import pytest
from support import lattice

from meshlib import (
    Interpolant,
    Mesh,
    MeshError,
    criteria,
    delaunay,
    problems,
    quality,
    refined,
    smoothed,
    swapped,
)
from meshlib.refinement.marking import marked

NAN, INF = float("nan"), float("inf")
CRITERIA = "(known: 'jnd', 'abn', 'dlp', 'dfp', 'smallest-angle', 'largest-angle', 'gradient-spread')"
TRIANGLE = [[0, 0], [1, 0], [0, 1]]

NODES = [
    ([], "shape: nodes have shape (0,); give an (N, 2) array of x and y"),
    ([[0, 0]], "shape: 1 node cannot make an element; give at least 3"),
    ([[0, 0], [1, 1]], "shape: 2 nodes cannot make an element; give at least 3"),
    ([[0, 0, 0]] * 3, "shape: nodes have shape (3, 3); give an (N, 2) array of x and y"),
    ([0, 1, 2], "shape: nodes have shape (3,); give an (N, 2) array of x and y"),
    (np.zeros((3, 2, 1)), "shape: nodes have shape (3, 2, 1); give an (N, 2) array of x and y"),
    ([[0, 0], [1, 0], [1]], "shape: the rows of nodes differ in length; give a regular array"),
    ([[0, 0], [1, 0], [0, 1j]], "dtype: nodes have dtype complex128; give real numbers"),
    ([[0, 0], [1, 0], [0, None]], "dtype: nodes have dtype object; give real numbers"),
    ([["0", "0"], ["1", "0"], ["0", "1"]], "dtype: nodes have dtype <U1; give real numbers"),
    (None, "dtype: nodes have dtype object; give real numbers"),
    (
        [[0, 0], [NAN, 0], [0, 1]],
        "finite: node 1 has the coordinates (nan, 0.0); remove it or give finite numbers",
    ),
    (
        [[0, 0], [1, 0], [0, -INF]],
        "finite: node 2 has the coordinates (0.0, -inf); remove it or give finite numbers",
    ),
]


def message(call, *arguments, **named):
    with pytest.raises(MeshError) as error:
        call(*arguments, **named)
    assert isinstance(error.value, ValueError)
    assert str(error.value).startswith(error.value.clause + ": ")
    return str(error.value)


@pytest.mark.parametrize("nodes, expected", NODES)
def test_bad_nodes(nodes, expected):
    assert message(delaunay, nodes) == expected
    assert message(Mesh, nodes, [[0, 1, 2]]) == expected


@pytest.mark.parametrize(
    "nodes, expected",
    [
        (
            [[0, 0], [1, 0], [0, 1], [1, 0]],
            "duplicate: nodes 1 and 3 coincide at (1.0, 0.0); keep one of them",
        ),
        (
            [[0, 0], [0, 0], [0, 0]],
            "duplicate: nodes 0 and 1 coincide at (0.0, 0.0); keep one of them (2 in all, see .items)",
        ),
        (
            [[1, 0], [-0.0, 0], [0, 1], [0, -0.0]],
            "duplicate: nodes 1 and 3 coincide at (-0.0, 0.0); keep one of them",
        ),
        ([[0, 0], [1, 1], [2, 2]], "collinear: all 3 nodes lie on one line; add a node off the line"),
        (
            [[0, 0], [0.1, 0.1], [0.2, 0.2], [0.3, 0.3]],
            "collinear: all 4 nodes lie on one line; add a node off the line",
        ),
        ([[0, 3], [5, 3], [2, 3], [7, 3]], "collinear: all 4 nodes lie on one line; add a node off the line"),
        (
            [[0, 0], [1, 0], [2, 1e-17]],
            "collinear: the nodes are too nearly on one line to be meshed; scale the flat direction up first",
        ),
    ],
)
def test_nodes_without_a_mesh(nodes, expected):
    assert message(delaunay, nodes) == expected


@pytest.mark.parametrize(
    "elements, expected",
    [
        ([0, 1, 2], "shape: elements have shape (3,); give a (T, 3) array of node numbers"),
        ([[0, 1]], "shape: elements have shape (1, 2); give a (T, 3) array of node numbers"),
        ([[0, 1, 2], [0, 1]], "shape: the rows of elements differ in length; give a regular array"),
        (np.empty((0, 3), dtype=int), "shape: there are no elements; give at least one"),
        ([[0.0, 1.0, 2.0]], "dtype: elements have dtype float64; give whole numbers"),
        ([[True, False, True]], "dtype: elements have dtype bool; give whole numbers"),
        ([[0, 1, None]], "dtype: elements have dtype object; give whole numbers"),
        (
            np.array([[0, 1, 2**64 - 1]], dtype=np.uint64),
            "index range: element 0 names node 18446744073709551615; the largest number is 2147483647",
        ),
    ],
)
def test_bad_elements(elements, expected):
    assert message(Mesh, TRIANGLE, elements) == expected


VALUES = [
    ([0, 0, 1], "shape: values have shape (3,); give one value for each of the 4 nodes"),
    ([[0, 0, 1, 1]], "shape: values have shape (1, 4); give one value for each of the 4 nodes"),
    (1.0, "shape: values have shape (); give one value for each of the 4 nodes"),
    ([0, 0, 1, NAN], "finite: the value at node 3 is nan; fill it in or remove the node"),
    (
        [0, INF, 1, NAN],
        "finite: the value at node 1 is inf; fill it in or remove the node (2 in all, see .items)",
    ),
    ([0, 0, 1, 1j], "dtype: values have dtype complex128; give real numbers"),
    ([0, 0, 1, None], "dtype: values have dtype object; give real numbers"),
    ([0, 0, 1, [1]], "shape: the rows of values differ in length; give a regular array"),
    (None, "dtype: values have dtype object; give real numbers"),
    (
        lambda x, y: np.where(x > 0, np.nan, y),
        "finite: the value at node 1 is nan; fill it in or remove the node (2 in all, see .items)",
    ),
    (lambda x, y: x[:2], "shape: values have shape (2,); give one value for each of the 4 nodes"),
]


@pytest.mark.parametrize("values, expected", VALUES)
@pytest.mark.parametrize("call", [Interpolant, swapped, refined, marked, criteria.costs])
def test_bad_values(square, call, values, expected):
    assert message(call, square, values) == expected


@pytest.mark.parametrize(
    "call",
    [
        quality,
        smoothed,
        lambda m: Interpolant(m, [0, 0, 0, 0]),
        lambda m: swapped(m, [0, 0, 0, 0]),
        lambda m: refined(m, [0, 0, 0, 0], "abn"),
        lambda m: criteria.costs(m, [0, 0, 0, 0]),
    ],
)
def test_every_operation_refuses_a_mesh_that_is_not_valid(call):
    wrong = Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 3, 2]])
    assert (
        message(call, wrong) == "orientation: element 1 with nodes (0, 3, 2) is clockwise; reverse its nodes"
    )


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ({"criterion": "jmd"}, f"unknown: criterion 'jmd' is not known; did you mean 'jnd'? {CRITERIA}"),
        (
            {"criterion": "smallest angle"},
            f"unknown: criterion 'smallest angle' is not known; did you mean 'smallest-angle'? {CRITERIA}",
        ),
        ({"criterion": "xyz"}, f"unknown: criterion 'xyz' is not known {CRITERIA}"),
        ({"criterion": None}, f"unknown: criterion None is not known {CRITERIA}"),
        ({"criterion": "min-error"}, "unknown: 'min-error' needs the function u; pass criteria.min_error(u)"),
    ],
)
@pytest.mark.parametrize("call", [swapped, refined, marked, criteria.costs])
def test_unknown_criteria(square, call, arguments, expected):
    assert message(call, square, [0, 0, 1, 1], **arguments) == expected


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ({"norm": 3}, "unknown: norm 3 is not known (known: 'L1', 'L2', 'max', 'lexicographic')"),
        (
            {"norm": "maxx"},
            "unknown: norm 'maxx' is not known; did you mean 'max'? "
            "(known: 'L1', 'L2', 'max', 'lexicographic')",
        ),
        (
            {"norm": "lexicographical"},
            "unknown: norm 'lexicographical' is not known; did you mean 'lexicographic'? "
            "(known: 'L1', 'L2', 'max', 'lexicographic')",
        ),
        ({"norm": [1, 2]}, "unknown: norm [1, 2] is not known (known: 'L1', 'L2', 'max', 'lexicographic')"),
        (
            {"norm": np.array([1, 2])},
            "unknown: norm array([1, 2]) is not known (known: 'L1', 'L2', 'max', 'lexicographic')",
        ),
        (
            {"order": [0, 1, 2, 3]},
            "shape: order has shape (4,) and dtype int64; give the 5 edge numbers, each once",
        ),
        (
            {"order": [0.0, 1, 2, 3, 4]},
            "shape: order has shape (5,) and dtype float64; give the 5 edge numbers, each once",
        ),
        ({"order": [0, 1, 2, 3, 3]}, "order: edge 4 is not in order; name each edge once"),
        ({"order": [0, 1, 2, 3, 5]}, "order: edge 4 is not in order; name each edge once"),
        ({"order": [-1, 1, 2, 3, 4]}, "order: edge 0 is not in order; name each edge once"),
        ({"order": [[0, 1], [2]]}, "shape: the rows of order differ in length; give a regular array"),
        ({"min_angle": -1}, "range: min_angle is -1; give degrees from 0 to below 60"),
        ({"min_angle": 60}, "range: min_angle is 60; give degrees from 0 to below 60"),
        ({"min_angle": NAN}, "range: min_angle is nan; give degrees from 0 to below 60"),
        ({"min_angle": "8"}, "range: min_angle is '8'; give degrees from 0 to below 60"),
        ({"min_angle": [8]}, "range: min_angle is [8]; give degrees from 0 to below 60"),
        ({"min_area": -0.1}, "range: min_area is -0.1; give a finite area of at least 0"),
        ({"min_area": INF}, "range: min_area is inf; give a finite area of at least 0"),
        ({"min_area": NAN}, "range: min_area is nan; give a finite area of at least 0"),
        ({"min_gain": -1}, "range: min_gain is -1; give a finite gain of at least 0"),
        ({"min_gain": NAN}, "range: min_gain is nan; give a finite gain of at least 0"),
    ],
)
def test_arguments_of_swapped(square, arguments, expected):
    assert message(swapped, square, [0, 0, 1, 1], **arguments) == expected


FRACTION = "; give a number from 0 to 1, 0.2 for 20 %"


@pytest.mark.parametrize(
    "arguments, expected",
    [
        ({"fraction": 1.2}, "range: fraction is 1.2" + FRACTION),
        ({"fraction": 20}, "range: fraction is 20" + FRACTION),
        ({"fraction": -0.1}, "range: fraction is -0.1" + FRACTION),
        ({"fraction": NAN}, "range: fraction is nan" + FRACTION),
        ({"fraction": None}, "range: fraction is None" + FRACTION),
        ({"fraction": "0.2"}, "range: fraction is '0.2'" + FRACTION),
        ({"fraction": 1j}, "range: fraction is 1j" + FRACTION),
        ({"fraction": [0.2]}, "range: fraction is [0.2]" + FRACTION),
        (
            {"mark": "elements"},
            "unknown: mark 'elements' is not known; did you mean 'element'? "
            "(known: 'element', 'edge', 'node', 'density')",
        ),
        ({"mark": None}, "unknown: mark None is not known (known: 'element', 'edge', 'node', 'density')"),
        (
            {"split": "red"},
            "unknown: split 'red' is not known (known: 'red-green', 'centroid', 'longest-edge')",
        ),
        (
            {"split": "longest"},
            "unknown: split 'longest' is not known; did you mean 'longest-edge'? "
            "(known: 'red-green', 'centroid', 'longest-edge')",
        ),
        ({"ties": "last"}, "unknown: ties 'last' is not known (known: 'first', 'all')"),
        ({"order": [0, 0]}, "order: element 1 is not in order; name each element once"),
        (
            {"order": [0, 1, 2]},
            "shape: order has shape (3,) and dtype int64; give the 2 element numbers, each once",
        ),
        (
            {"order": [0, 1], "mark": "node"},
            "shape: order has shape (2,) and dtype int64; give the 4 node numbers, each once",
        ),
    ],
)
def test_arguments_of_refined(square, arguments, expected):
    assert message(refined, square, [0, 0, 1, 1], **arguments) == expected


@pytest.mark.parametrize(
    "arguments, expected",
    [
        (
            {"springs": [1, 1, 1, 1]},
            "shape: springs have shape (4,); give one constant for each of the 5 edges",
        ),
        ({"springs": 1.0}, "shape: springs have shape (); give one constant for each of the 5 edges"),
        (
            {"springs": [1, 1, -1, 1, 1]},
            "range: the spring constant of edge 2 is -1.0; give finite numbers of at least 0",
        ),
        (
            {"springs": [1, NAN, 1, 1, 1]},
            "range: the spring constant of edge 1 is nan; give finite numbers of at least 0",
        ),
        ({"springs": [1j] * 5}, "dtype: springs have dtype complex128; give real numbers"),
        ({"springs": ["a"] * 5}, "dtype: springs have dtype <U1; give real numbers"),
        ({"springs": [[1], [1, 2]]}, "shape: the rows of springs differ in length; give a regular array"),
        ({"max_sweeps": 0}, "range: max_sweeps is 0; give a whole number of at least 1"),
        ({"max_sweeps": 1.5}, "range: max_sweeps is 1.5; give a whole number of at least 1"),
        ({"min_movement": -1}, "range: min_movement is -1; give a finite number of at least 0"),
        ({"min_movement": "a"}, "range: min_movement is 'a'; give a finite number of at least 0"),
        ({"min_area": INF}, "range: min_area is inf; give a finite number of at least 0"),
    ],
)
def test_arguments_of_smoothed(square, arguments, expected):
    assert message(smoothed, square, **arguments) == expected


def test_criteria_and_problems_by_name():
    assert (
        message(criteria.Criterion, "x", "egde", len)  # codespell:ignore egde
        == "unknown: place 'egde' is not known; did you mean 'edge'? (known: 'edge', 'element', 'node')"
    )
    assert (
        message(criteria.unregister, "jmd")
        == f"unknown: criterion 'jmd' is not known; did you mean 'jnd'? {CRITERIA}"
    )
    for call in (problems.mesh, problems.nodes, problems.order):
        assert message(call, "34") == (
            "unknown: node set '34' is not known (known: '33', '33-refined', '81', '33-franke')"
        )


def test_items_are_plain_numbers():
    with pytest.raises(MeshError) as error:
        delaunay([[0, 0], [1, 0], [0, 1], [1, 0]])
    assert error.value.items == (1, 3) and {type(i) for i in error.value.items} == {int}
    with pytest.raises(MeshError) as error:
        Interpolant(delaunay(TRIANGLE), [NAN, 0, NAN])
    assert error.value.items == (0, 2)


def test_nothing_is_changed_by_a_refusal(rng):
    mesh, values = delaunay(lattice(3, 3)), rng.standard_normal(16)
    before = mesh.nodes.copy(), mesh.elements.copy(), values.copy()
    for call, arguments in (
        (swapped, {"norm": 3}),
        (refined, {"fraction": 2}),
        (refined, {"split": "red"}),
        (swapped, {"order": np.zeros(33, dtype=int)}),
        (swapped, {"min_angle": 99}),
    ):
        message(call, mesh, values, **arguments)
    message(smoothed, mesh, -np.ones(33))
    for array, copy in zip((mesh.nodes, mesh.elements, values), before, strict=True):
        assert np.array_equal(array, copy)


def test_masked_values_are_not_taken_for_numbers():
    mesh = problems.mesh("33")
    values = np.ma.masked_array(np.zeros(33), mask=np.arange(33) == 7)
    with pytest.raises(MeshError) as error:
        swapped(mesh, values)
    assert str(error.value) == "finite: the value at node 7 is nan; fill it in or remove the node"


def test_a_criterion_that_returns_nan_does_not_pass_for_one_that_swaps_nothing():
    mesh, bad = problems.mesh("33"), criteria.Criterion("bad", "element", lambda a, b, c: a[:, 0] * NAN)
    with pytest.raises(MeshError) as error:
        swapped(mesh, np.zeros(33), bad)
    assert str(error.value) == (
        "cost: the cost of element 0 is nan; a criterion must return finite numbers of at least 0 "
        "(56 in all, see .items)"
    )


def test_a_cost_that_becomes_nan_on_the_way_is_named():
    square = Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    known = {(0.0, 1.0), (1.0, 0.0), (0.0, 0.0)}  # values left and right of the first diagonal

    def cost(p, q, left, right):
        return np.array([0.0 if pair in known else NAN for pair in zip(left[:, 2], right[:, 2], strict=True)])

    with pytest.raises(MeshError) as error:
        swapped(square, [2.0, 0.0, 2.0, 1.0], criteria.Criterion("known", "edge", cost))
    assert str(error.value) == (
        "cost: a cost around edge (0, 2) is negative or not finite; "
        "a criterion must return finite numbers of at least 0"
    )


@pytest.mark.parametrize(
    "cost, expected",
    [
        (
            lambda a, b, c: a[:, 0] * 0 - 1,
            "cost: the cost of element 0 is -1.0; a criterion must return finite numbers of at least 0 "
            "(2 in all, see .items)",
        ),
        (
            lambda a, b, c: a,
            "shape: the criterion returned costs of shape (2, 3) for 2 elements; return one number for each",
        ),
        (
            lambda a, b, c: 1.0,
            "shape: the criterion returned costs of shape () for 2 elements; return one number for each",
        ),
    ],
)
def test_costs_of_ones_own_are_checked(cost, expected):
    square = delaunay([[0, 0], [1, 0], [1, 1], [0, 1]])
    with pytest.raises(MeshError) as error:
        swapped(square, np.zeros(4), criteria.Criterion("own", "element", cost), norm=1)
    assert str(error.value) == expected


def test_a_result_in_place_of_its_mesh_is_told_apart():
    mesh = problems.mesh("33")
    with pytest.raises(MeshError) as error:
        refined(swapped(mesh, problems.SR1), problems.SR1, "abn")
    assert str(error.value) == "type: a mesh is needed, this is a Swapping; take its .mesh"
    with pytest.raises(MeshError) as error:
        quality(mesh.nodes)
    assert str(error.value) == (
        "type: a mesh is needed, this is a ndarray; make a meshlib.Mesh or use meshlib.delaunay"
    )


def test_criteria_that_depend_on_the_data_ask_for_values():
    mesh = problems.mesh("33")
    with pytest.raises(MeshError) as error:
        criteria.prefers(mesh, mesh)
    assert str(error.value) == "shape: criterion 'jnd' depends on the data; give values"
    assert not criteria.prefers(mesh, mesh, criterion="smallest-angle", norm="max")


@pytest.mark.parametrize(
    "arguments, hint",
    [
        ({"criterion": "JND"}, "did you mean 'jnd'?"),
        ({"norm": "l2"}, "did you mean 'L2'?"),
        ({"norm": "Max"}, "did you mean 'max'?"),
    ],
)
def test_the_nearest_name_is_found_in_any_case(arguments, hint):
    with pytest.raises(MeshError) as error:
        swapped(problems.mesh("33"), problems.SR1, **arguments)
    assert hint in str(error.value)


@pytest.mark.parametrize("factor", [1e300, 1e-170])
def test_values_whose_squares_are_out_of_range_are_refused(factor):
    with pytest.raises(MeshError, match="measure u in another unit"):
        swapped(problems.mesh("33"), problems.SR1(*problems.nodes("33").T) * factor)
