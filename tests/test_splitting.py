"""Marking and splitting against slow references, which know edges as pairs of nodes."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import problems_of
from support import lattice

from meshlib import Mesh, criteria, delaunay, problems, refined
from meshlib.mesh.topology import grouped, unique
from meshlib.refinement.marking import MARKS, TIED, TIES, averaged, marked

FRACTIONS = (0.05, 0.3, 0.7, 1.0)


def key(a, b):
    return min(a, b), max(a, b)


def sides(nodes):
    """The side opposite each node."""
    a, b, c = nodes
    return key(b, c), key(c, a), key(a, b)


def bisect(pairs, middle, n):
    """Give the pairs a middle, new nodes in the order of the pairs."""
    new = sorted(pairs - middle.keys())
    middle.update({pair: n + i for i, pair in enumerate(new)})
    return new


def needs_red(nodes, middle):
    hanging = [pair for pair in sides(nodes) if pair in middle]
    deep = any(key(end, middle[pair]) in middle for pair in hanging for end in pair)
    return deep or len(hanging) > 1


def in_four(nodes, middle):
    a, b, c = nodes
    bc, ca, ab = (middle[pair] for pair in sides(nodes))
    return [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]


def red_green(mesh, chosen):
    """Elements, parents, green pairs and ends of the bisected edges, element by element."""
    elements, leaves, middle, chosen = mesh.elements.tolist(), {}, {}, set(chosen.tolist())
    leaves = {t: (nodes, t, t in chosen) for t, nodes in enumerate(elements)}
    for first, second in mesh.green.tolist():
        (m, c, a), b = elements[first], elements[second][1]
        leaves[first] = (c, a, b), first, bool(chosen & {first, second})
        del leaves[second]
        middle[key(a, b)] = m
    leaves, ends = list(leaves.values()), []
    while any(red for *_, red in leaves):
        ends += bisect(
            {pair for nodes, _, red in leaves if red for pair in sides(nodes)},
            middle,
            mesh.n_nodes + len(ends),
        )
        parts = [(part, t) for nodes, t, red in leaves if red for part in in_four(nodes, middle)]
        leaves = [
            (nodes, t, needs_red(nodes, middle))
            for nodes, t in [(nodes, t) for nodes, t, red in leaves if not red] + parts
        ]
    return *closed(leaves, middle), ends


def closed(leaves, middle):
    rows, pairs = [], []
    for nodes, t, _ in leaves:
        k = [k for k, pair in enumerate(sides(nodes)) if pair in middle]
        if k:
            a, b, c = (nodes[(k[0] + i) % 3] for i in (1, 2, 0))
            m = middle[key(a, b)]
            pairs += [(t, (m, c, a)), (t, (m, b, c))]
        else:
            rows.append((t, nodes))
    every = sorted(range(len(rows) + len(pairs)), key=lambda i: (rows + pairs)[i][0])
    place = {i: row for row, i in enumerate(every)}
    green = [[place[i], place[i + 1]] for i in range(len(rows), len(every), 2)]
    parents, elements = zip(*((rows + pairs)[i] for i in every), strict=True)
    return [list(nodes) for nodes in elements], list(parents), green


@settings(max_examples=80)
@given(
    problems_of(most=12, scales=(1.0,)),
    st.lists(st.sampled_from(FRACTIONS[:3]), min_size=1, max_size=4),
    st.integers(0, 999),
)
def test_red_green_is_what_the_reference_makes(problem, fractions, seed):
    mesh, rng = problem[0], np.random.default_rng(seed)
    for fraction in fractions:
        result = refined(mesh, rng.standard_normal(mesh.n_nodes), "abn", fraction=fraction)
        elements, parents, green, ends = red_green(mesh, result.marked)
        assert result.mesh.elements.tolist() == elements and result.parents.tolist() == parents
        assert result.mesh.green.tolist() == green
        assert np.array_equal(result.mesh.nodes[mesh.n_nodes :], mesh_means(result.mesh, ends))
        mesh = Mesh(result.mesh.nodes, elements, rng.permutation(result.mesh.green))


def mesh_means(mesh, ends):
    return mesh.nodes[np.array(ends, dtype=int).reshape(-1, 2)].mean(axis=1)


def test_parts_of_parts_next_to_a_green_pair():
    """One point, eight times: generations of leaves are cut within one call, and halves bisected."""
    mesh = delaunay(lattice(3, 3))
    for _ in range(8):
        away = np.hypot(*(mesh.corners.mean(axis=1) - 1.4).T)
        nearest = criteria.Criterion("near", "element", lambda a, b, c, away=away: np.exp(-away))
        result = refined(mesh, np.zeros(mesh.n_nodes), nearest, fraction=3 / mesh.n_elements)
        elements, parents, green, _ = red_green(mesh, result.marked)
        assert result.mesh.elements.tolist() == elements and result.parents.tolist() == parents
        assert result.mesh.green.tolist() == green
        mesh = result.mesh.validate()


def test_a_long_chain_of_longest_edges():
    """A growing fan: the longest edge of each element is the shorter spoke of the next."""
    n = 60
    turn = np.arange(n + 1) / 40
    rim = 1.05 ** np.arange(n + 1)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
    mesh = Mesh(np.vstack([rim, [[0, 0]]]), [[i, i + 1, n + 1] for i in range(n)])
    first = criteria.Criterion("first", "element", lambda a, b, c: (np.arange(n) == 0) * 1.0)
    result = refined(mesh, np.zeros(n + 2), first, fraction=1 / n, split="longest-edge")
    spokes = sorted(key(i, n + 1) for i in range(1, n + 1))
    assert np.array_equal(result.mesh.nodes[n + 2 :], mesh_means(result.mesh, spokes))
    assert result.mesh.n_elements == n + 1 + (n - 1) * 2


def ranking(costs, order):
    """Numbers by descending cost, those that tie in the given order; and the groups that tie."""
    numbers = sorted(order, key=lambda i: -costs[i])
    groups = [[numbers[0]]]
    for i, j in pairwise(numbers):
        if costs[i] - costs[j] > TIED * max(costs):
            groups.append([])
        groups[-1].append(j)
    place = {number: i for i, number in enumerate(order)}
    return [sorted(group, key=place.get) for group in groups]


def chosen_by(mesh, costs, mark, ties, target, order):
    groups, found = ranking(costs, order), set()
    for number in (number for group in groups for number in group):
        group = next(group for group in groups if number in group)
        corners = {"edge": mesh.element_edges, "node": mesh.elements}.get(mark)
        if len(found) < target or (mark == "element" and ties == "all" and found & set(group)):
            found |= {number} if corners is None else set(np.nonzero(corners == number)[0].tolist())
    return sorted(found)


@settings(max_examples=100)
@given(
    problems_of(most=12),
    st.sampled_from(("element", "edge", "node")),
    st.sampled_from(TIES),
    st.integers(1, 9),
    st.sampled_from((0, 1e-12, 5e-10, 2e-9)),
    st.integers(0, 999),
)
def test_marking_is_what_the_reference_marks(problem, mark, ties, target, noise, seed):
    mesh, rng = problem[0], np.random.default_rng(seed)
    target = min(target, mesh.n_elements)
    size = {"edge": mesh.n_edges, "node": mesh.n_nodes, "element": mesh.n_elements}[mark]
    costs = rng.integers(0, 4, size) + noise * rng.random(size)
    if mark == "edge":
        costs[mesh.boundary] = 0
    inner = costs[~mesh.boundary] if mark == "edge" else costs
    order, criterion = rng.permutation(size), criteria.Criterion("given", mark, lambda *_: inner)
    found = marked(
        mesh,
        np.zeros(mesh.n_nodes),
        criterion,
        fraction=target / mesh.n_elements,
        mark=mark,
        ties=ties,
        order=order,
    )
    assert found.tolist() == chosen_by(mesh, costs.tolist(), mark, ties, target, order.tolist())


@pytest.mark.parametrize("mark", MARKS)
def test_all_equal_costs_are_marked_in_the_given_order(mark):
    mesh = problems.mesh("81")
    flat = criteria.Criterion("flat", "element", lambda a, b, c: np.ones(128))
    first = marked(mesh, np.zeros(81), flat, fraction=1 / 128, mark=mark)
    assert 0 in (first if mark in ("element", "density") else mesh.elements[first])


def test_averages_over_elements_do_not_depend_on_the_way():
    """Three times the mean is the sum over the corners."""
    mesh, costs = problems.mesh("33"), np.arange(33.0)
    assert np.array_equal(averaged(mesh, costs, "node", "element"), costs[mesh.elements].sum(axis=1) / 3)


@pytest.mark.parametrize("count", [0, 1, 500, 20_000])
def test_rows_of_equal_numbers(count, rng):
    numbers = rng.integers(0, 97, count).astype(np.int32)
    rows, starts = grouped(numbers, 100)
    assert np.array_equal(rows, np.argsort(numbers, kind="stable"))
    assert np.array_equal(np.diff(starts), np.bincount(numbers, minlength=100)) and starts[0] == 0
    assert np.array_equal(unique(numbers), np.unique(numbers))
