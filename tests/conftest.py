"""Settings of the test run, the start meshes that several files share, and a browser."""

import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from meshlib import Mesh, problems

SITE = Path(__file__).parents[1] / "_build" / "html"
BROWSERS = "chromium", "chromium-browser", "google-chrome"

settings.register_profile(
    "deterministic",
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.too_slow],
)
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


@pytest.fixture(params=problems.names())
def start(request):
    """Each start mesh of the thesis in turn."""
    return problems.mesh(request.param)


@pytest.fixture(scope="session")
def site():
    """The folder of the built book."""
    if not (SITE / "index.html").exists():
        pytest.skip("the book is not built: make book")
    return SITE


@pytest.fixture(scope="module", params=["server", "disk"])
def address(request, site):
    """Where the site is, on a server of this machine or in a folder."""
    from visiting import served  # beside the tests in a browser, which alone need it

    if request.param == "disk":
        yield site.as_uri()
    else:
        with served(site) as found:
            yield found


@pytest.fixture(scope="session")
def chromium():
    """A browser without a window, that of MESHLIB_BROWSER or the first one found."""
    playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    program = os.environ.get("MESHLIB_BROWSER") or next(filter(None, map(shutil.which, BROWSERS)), None)
    if not program:
        pytest.skip("no browser: apt-get install chromium, or set MESHLIB_BROWSER")
    with playwright.sync_playwright() as running:
        browser = running.chromium.launch(executable_path=program, args=["--no-sandbox"])
        yield browser
        browser.close()
