"""Hypothesis strategies: node sets full of cocircular and collinear cases."""

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from support import shuffled

from meshlib import delaunay

SCALES = (1.0, 0.1, 1 / 3, 1e-9, 1e6)
WIDTH = 5


@st.composite
def lattice_nodes(draw, most=14, scales=SCALES):
    """Distinct points of a small integer lattice, scaled, not all on one line."""
    cells = st.tuples(st.integers(0, WIDTH), st.integers(0, WIDTH))
    nodes = np.array(draw(st.lists(cells, min_size=4, max_size=most, unique=True)), dtype=float)
    away = nodes - nodes[0]
    assume(np.linalg.matrix_rank(away) == 2)
    return nodes * draw(st.sampled_from(scales))


@st.composite
def meshes(draw, most=14, scales=SCALES):
    """Valid meshes, some flips away from Delaunay."""
    scale = draw(st.sampled_from(scales))
    mesh = delaunay(draw(lattice_nodes(most, (scale,))))
    seed = draw(st.integers(0, 2**16))
    return shuffled(mesh, np.random.default_rng(seed), draw(st.integers(0, 20)), unit=scale)


@st.composite
def problems_of(draw, most=14, scales=SCALES):
    """A mesh and nodal values, small integers: many flat and many equal quadrilaterals."""
    mesh = draw(meshes(most, scales))
    heights = st.lists(st.integers(-3, 3), min_size=mesh.n_nodes, max_size=mesh.n_nodes)
    return mesh, np.array(draw(heights), dtype=float)
