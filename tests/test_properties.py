"""Chains of operations on hard nodes: every mesh is valid, no input is changed, all is repeatable."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from strategies import lattice_nodes, meshes, problems_of
from support import as_set, exact_turn

from meshlib import Interpolant, Mesh, criteria, delaunay, quality, refined, smoothed, swapped
from meshlib.criteria.norms import NORMS
from meshlib.refinement.marking import MARKS
from meshlib.refinement.splitting import SPLITS

STEPS = st.one_of(
    st.tuples(st.just("swap"), st.sampled_from(criteria.names()), st.sampled_from(NORMS)),
    st.tuples(st.just("refine"), st.sampled_from(MARKS), st.sampled_from(sorted(SPLITS))),
    st.tuples(st.just("smooth"), st.sampled_from((1, 10)), st.sampled_from((0.0, 1.0))),
)


def step(mesh, values, kind, first, second):
    """The mesh and nodal values after one operation."""
    if kind == "swap":
        return swapped(mesh, values, first, norm=second, min_angle=1).mesh, values
    if kind == "refine":
        result = refined(mesh, values, "abn", fraction=0.3, mark=first, split=second)
        return result.mesh, result.values
    springs = np.arange(mesh.n_edges) % 3 + second
    return smoothed(mesh, springs, max_sweeps=first).mesh, values


@settings(max_examples=100)
@given(problems_of(most=9), st.lists(STEPS, min_size=2, max_size=6))
def test_any_chain_of_operations_is_valid_and_repeatable(problem, steps):
    results = []
    for _ in range(2):
        mesh, values = problem
        for arguments in steps:
            nodes, elements = mesh.nodes.copy(), mesh.elements.copy()
            new, new_values = step(mesh, values, *arguments)
            assert np.array_equal(mesh.nodes, nodes) and np.array_equal(mesh.elements, elements)
            mesh, values = Mesh(new.nodes, new.elements, new.green).validate(), new_values
        results.append(mesh)
    assert results[0].nodes.tobytes() == results[1].nodes.tobytes()
    assert results[0].elements.tobytes() == results[1].elements.tobytes()


@settings(max_examples=100)
@given(meshes())
def test_counts_and_incidences(mesh):
    n, e, t = mesh.counts
    nb = int(mesh.boundary_nodes.sum())
    assert (t, e) == (2 * (n - 1) - nb, 3 * (n - 1) - nb)
    assert np.bincount(mesh.element_edges.ravel(), minlength=e).tolist() == (2 - mesh.boundary).tolist()
    inside = mesh.neighbours >= 0
    rows = np.repeat(np.arange(t), 3).reshape(-1, 3)[inside]
    assert (mesh.neighbours[mesh.neighbours[inside]] == rows[:, None]).any(axis=1).all()
    assert Mesh.from_arrays(*mesh.to_arrays()).equals(mesh)


@settings(max_examples=60)
@given(meshes(most=8))
def test_every_element_is_counter_clockwise_in_rationals(mesh):
    assert all(exact_turn(*corners) == 1 for corners in mesh.corners)


@settings(max_examples=60)
@given(lattice_nodes(most=12, scales=(1.0, 2.0**-20)), st.integers(0, 99))
def test_the_order_of_nodes_changes_ties_only(nodes, seed):
    """Delaunay meshes that differ in ties alone have the same energy, the least (Rippa 1990)."""
    meshes_ = delaunay(nodes), delaunay(np.random.default_rng(seed).permutation(nodes))
    gradients = [
        Interpolant(m, lambda x, y: np.sin(3 * x / nodes.max()) + (y / nodes.max()) ** 3).gradients
        for m in meshes_
    ]
    first, second = (m.areas @ (g**2).sum(axis=1) for m, g in zip(meshes_, gradients, strict=True))
    assert meshes_[0].counts == meshes_[1].counts
    assert np.isclose(first, second, rtol=1e-9)


@settings(max_examples=60)
@given(
    problems_of(scales=(1.0, 0.5)),
    st.sampled_from(("jnd", "dlp")),
    st.sampled_from(NORMS),
    st.sampled_from((-4.0, 0.25, 1024.0)),
)
def test_scaled_data_swap_alike(problem, name, norm, alpha):
    mesh, values = problem
    plain, scaled = (swapped(mesh, v, name, norm=norm) for v in (values, alpha * values))
    assert as_set(plain.mesh) == as_set(scaled.mesh)
    assert np.isclose(scaled.cost_after, abs(alpha) * plain.cost_after, rtol=1e-12)


@settings(max_examples=60)
@given(problems_of(scales=(1.0, 0.5)), st.integers(-2, 2), st.integers(-2, 2), st.integers(-2, 2))
def test_an_affine_function_added_changes_no_jump(problem, a, b, c):
    """JND and DLP see second differences only."""
    mesh, values = problem
    tilted = values + (a * mesh.nodes[:, 0] + b * mesh.nodes[:, 1] + c)
    for name in ("jnd", "dlp"):
        assert np.allclose(criteria.costs(mesh, tilted, name), criteria.costs(mesh, values, name), atol=1e-10)


@settings(max_examples=60)
@given(problems_of(most=12, scales=(1.0, 1e6)))
def test_a_swapped_interpolant_keeps_its_nodes_and_range(problem):
    mesh, values = problem
    result = swapped(mesh, values)
    u_h = Interpolant(result.mesh, values)
    assert np.allclose(u_h(*mesh.nodes.T), values, atol=1e-9)
    _, _, u = u_h.on_grid(7)
    inside = u[~np.isnan(u)]
    assert inside.min(initial=values.min()) >= values.min() - 1e-9
    assert inside.max(initial=values.max()) <= values.max() + 1e-9


@settings(max_examples=60)
@given(meshes())
def test_quality_is_finite_even_where_elements_are_flat(mesh):
    q = quality(mesh)
    for name in ("maximum_angle", "skewness", "aspect_ratio"):
        assert np.isfinite(getattr(q, name)).all()
    assert (q.aspect_ratio >= 0).all() and (q.maximum_angle <= 180).all()
