"""Green pairs are remembered as long as they are left alone (section 3.2.4)."""

import pytest

from meshlib import problems, refined, swapped


@pytest.mark.parametrize(
    "again",
    [
        lambda mesh, u: swapped(mesh, u, "jnd", min_angle=25),
        lambda mesh, u: swapped(mesh, u, "jnd", norm="lexicographic", min_angle=25),
        lambda mesh, u: refined(mesh, u, "abn", fraction=0.05, split="centroid"),
        lambda mesh, u: refined(mesh, u, "abn", fraction=0.05, split="longest-edge"),
    ],
)
def test_green_pairs_that_are_left_alone_are_remembered(again):
    u = problems.SR1
    first = refined(problems.mesh("33"), u, "abn").mesh
    second = again(first, u).mesh.validate()
    halves = {frozenset(map(frozenset, first.elements[pair].tolist())) for pair in first.green}
    whole = set(map(frozenset, second.elements.tolist()))
    kept = {frozenset(map(frozenset, second.elements[pair].tolist())) for pair in second.green}
    assert kept == {pair for pair in halves if pair <= whole}
    assert 0 < len(kept) < len(first.green)
    refined(second, u, "abn").mesh.validate()
