"""Every clause of validate(): what breaks it, the whole message, and what must pass."""

import numpy as np
import pytest

from meshlib import Mesh, MeshError
from meshlib.mesh import validation

SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]

BROKEN = {
    "a node number too large": (
        SQUARE,
        [[0, 1, 2], [0, 2, 4]],
        "index range: element 1 names node 4; nodes are numbered 0 to 3",
        (1,),
    ),
    "a negative node number": (
        SQUARE,
        [[0, 1, 2], [0, 2, -1]],
        "index range: element 1 names node -1; nodes are numbered 0 to 3",
        (1,),
    ),
    "a number that does not fit 32 bits": (
        SQUARE,
        [[0, 1, 2], [0, 2, 2**32 + 3]],
        "index range: element 1 names node 4294967299; the largest number is 2147483647",
        (1,),
    ),
    "duplicate nodes": (
        [[0, 0], [1, 0], [1, 1], [0, 0]],
        [[0, 1, 2]],
        "duplicate: nodes 0 and 3 coincide at (0.0, 0.0); keep one of them",
        (0, 3),
    ),
    "duplicate nodes, one at minus zero": (
        [[0, 0], [1, 0], [1, 1], [-0.0, 0]],
        [[0, 1, 2]],
        "duplicate: nodes 0 and 3 coincide at (0.0, 0.0); keep one of them",
        (0, 3),
    ),
    "duplicate elements": (
        SQUARE,
        [[0, 1, 2], [0, 2, 3], [1, 2, 0]],
        "duplicate: elements 0 and 2 have the same nodes (0, 1, 2); remove one",
        (0, 2),
    ),
    "an element without area": (
        [*SQUARE, [2, 2]],
        [[0, 1, 2], [0, 2, 3], [0, 2, 4]],
        "degenerate: element 2 with nodes (0, 2, 4) has no area; remove it or move a node",
        (2,),
    ),
    "an element that names a node twice": (
        SQUARE,
        [[0, 1, 2], [0, 2, 2]],
        "degenerate: element 1 with nodes (0, 2, 2) has no area; remove it or move a node",
        (1,),
    ),
    "a clockwise element": (
        SQUARE,
        [[0, 1, 2], [0, 3, 2]],
        "orientation: element 1 with nodes (0, 3, 2) is clockwise; reverse its nodes",
        (1,),
    ),
    "an unused node": (
        SQUARE,
        [[0, 1, 2]],
        "unused node: node 3 belongs to no element; remove it or mesh it",
        (3,),
    ),
    "elements on the same side of an edge": (
        [[0, 0], [2, 0], [0, 2], [2, 2]],
        [[0, 1, 2], [0, 1, 3]],
        "overlap: elements 0 and 1 lie on the same side of edge (0, 1); remove one or reverse its nodes",
        (0, 1),
    ),
    "elements that cross, without a common edge": (  # common part: (1,0), (2,0), (1,1)
        [[0, 0], [2, 0], [0, 2], [1, 0], [3, 0], [1, 2]],
        [[0, 1, 2], [3, 4, 5]],
        "overlap: elements 0 and 1 overlap by an area of 0.5; remove one or untangle their nodes",
        (0, 1),
    ),
    "an element inside another": (
        [[0, 0], [8, 0], [0, 8], [1, 1], [3, 1], [1, 3]],
        [[0, 1, 2], [3, 4, 5]],
        "overlap: elements 0 and 1 overlap by an area of 2; remove one or untangle their nodes",
        (0, 1),
    ),
    "a star of David": (  # of the nine parts of either, its three corners stand out: 6/9 of 4.5
        [[0, 0], [3, 0], [0, 3], [2, 2], [-1, 2], [2, -1]],
        [[0, 1, 2], [3, 4, 5]],
        "overlap: elements 0 and 1 overlap by an area of 3; remove one or untangle their nodes",
        (0, 1),
    ),
    "a hanging node": (  # Figure 2.1
        [[0, 0], [2, 0], [0, 2], [2, 2], [1, 1]],
        [[0, 1, 2], [1, 3, 4], [4, 3, 2]],
        "hanging node: node 4 hangs on edge (1, 2) of element 0; split the element there",
        (4, 0),
    ),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_breaks_a_clause_is_named(case):
    nodes, elements, message, items = BROKEN[case]
    with pytest.raises(MeshError) as error:
        Mesh(nodes, elements).validate()
    assert str(error.value) == message
    assert error.value.clause == message.split(":")[0]
    assert error.value.items == items


def test_every_clause_is_broken_by_some_case():
    clauses = {clause.__name__.replace("_", " ") for clause in validation.CLAUSES}
    assert clauses - {"green pair"} == {message.split(":")[0] for _, _, message, _ in BROKEN.values()}


@pytest.mark.parametrize("derive", ["edges", "corners", "areas", "neighbours", "boundary_nodes"])
def test_nothing_is_derived_from_bad_indices(derive):
    with pytest.raises(MeshError, match=r"^index range: element 0 names node 3; nodes are numbered 0 to 2$"):
        getattr(Mesh([[0, 0], [1, 0], [0, 1]], [[0, 1, 3]]), derive)


def test_valid_meshes_pass_and_are_returned(start, frame, square):
    for mesh in (start, frame, square):
        assert mesh.validate() is mesh


def test_elements_may_touch_in_a_single_node():
    Mesh([[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]], [[0, 1, 2], [0, 3, 4]]).validate()


def test_elements_may_lie_apart_with_boxes_that_overlap():
    """Their boxes share (1, 2) x (1, 2); the line x + y = 2.2 parts the elements."""
    Mesh([[0, 0], [2, 0], [0, 2], [2, 1], [2, 2], [1, 2]], [[0, 1, 2], [3, 4, 5]]).validate()


def test_decisions_are_exact_to_the_last_bit():
    """Node 4 lies one ulp off the edge 1-2: outside it hangs nowhere, on it it hangs."""
    above = np.nextafter(1.0, 2.0)
    nodes = [[0, 0], [2, 0], [0, 2], [2, 2], [1, above]]
    Mesh(nodes, [[0, 1, 2], [1, 3, 4], [4, 3, 2]]).validate()
    nodes[4] = [1, np.nextafter(1.0, 0.0)]
    with pytest.raises(MeshError, match=r"^overlap: elements 0 and [12] overlap by an area of "):
        Mesh(nodes, [[0, 1, 2], [1, 3, 4], [4, 3, 2]]).validate()


@pytest.mark.parametrize(
    "clip, area",
    [
        ([[0, 0], [1, 0], [0, 1]], 0.5),
        ([[0.5, 0], [1.5, 0], [0.5, 1]], 0.125),
        ([[2, 0], [3, 0], [2, 1]], 0.0),
        ([[1, 1], [0, 1], [1, 0]], 0.0),
        ([[-5, -5], [20, -5], [-5, 20]], 0.5),
    ],
)
def test_common_area_of_triangles(clip, area):
    unit = np.array([[0.0, 0], [1, 0], [0, 1]])
    assert validation.common_area(unit, np.array(clip, dtype=float)) == pytest.approx(area)
    assert validation.common_area(np.array(clip, dtype=float), unit) == pytest.approx(area)


@pytest.mark.parametrize(
    "green, message",
    [
        ([[0, 7]], "green pair: a pair names element 7; elements are numbered 0 to 1"),
        ([[0, 1]], "green pair: elements 0 and 1 do not halve a larger one; leave the pair out"),
        ([[0, 0]], "green pair: element 0 is in two places; leave one of its pairs out"),
    ],
)
def test_green_pairs_are_checked(square, green, message):
    with pytest.raises(MeshError) as error:
        Mesh(square.nodes, square.elements, green).validate()
    assert str(error.value) == message


@pytest.mark.parametrize(
    "green, message",
    [
        ([[0, 1, 0]], "shape: green pairs have shape (1, 3); give a (G, 2) array of element numbers"),
        ([0, 1], "shape: green pairs have shape (2,); give a (G, 2) array of element numbers"),
        ([[0.5, 1]], "dtype: green pairs have dtype float64; give whole numbers"),
    ],
)
def test_green_pairs_are_a_table_of_numbers(square, green, message):
    with pytest.raises(MeshError) as error:
        Mesh(square.nodes, square.elements, green)
    assert str(error.value) == message
