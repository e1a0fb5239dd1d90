"""Settings of the test run and the start meshes that several files share."""
import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from meshlib import Mesh, problems

settings.register_profile("deterministic", deadline=None, derandomize=True, database=None,
                          suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("deterministic")


@pytest.fixture
def square():
    """Four nodes, five edges, two elements."""
    return Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])


@pytest.fixture
def frame():
    """The square [0, 3]^2 without its middle cell: 16 nodes, 8 cells, one hole."""
    cells = [(i, j) for j in range(3) for i in range(3) if (i, j) != (1, 1)]
    corner = [i + 4 * j for i, j in cells]
    elements = [t for n in corner for t in ([n, n + 1, n + 5], [n, n + 5, n + 4])]
    return Mesh([(i, j) for j in range(4) for i in range(4)], elements)


@pytest.fixture
def rng():
    return np.random.default_rng(2001)


@pytest.fixture(params=problems.names)
def start(request):
    """Each start mesh of the thesis in turn."""
    return problems.mesh(request.param)
