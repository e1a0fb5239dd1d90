"""What the browser tests share: the site on a server, and a watch over what a page asks for."""

import functools
import os
import threading
from contextlib import contextmanager
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import numpy as np
import pytest

from meshlib import Mesh
from meshlib.explorer.scene import Stage, numbers

SUBPATH = "/some/where"  # a site need not be at the root of its host
PLACES = {
    "swaps": "03-methods",
    "refinement": "05-results",
    "movement": "05-results",
    "limits": "06-modifications",
    "orders": "06-modifications",
    "approximation": "07-further-work",
}
SHOWN = """e => { const shown = e.querySelector('.mesh-explorer').shown(), { mesh } = shown;
    return { numbers: shown.numbers.map(([label, value]) => [label, value]), frame: shown.frame,
             title: e.querySelector('.title').textContent,
             corners: Array.from(mesh.elements, n => [mesh.x[n], mesh.y[n]]),
             rows: Array.from(e.querySelectorAll('tbody tr'), r => [0, 2].map(k => r.cells[k].textContent)),
             pictures: Array.from(e.querySelectorAll('canvas'), c => c.toDataURL()) }; }"""
TIMES = "MESHLIB_TIMES"
READY_SECONDS = 20  # on a busy machine; the speed is tested apart


def skip_unless_timed():
    """Skip a test of speed, which says something only on a machine with nothing else to do."""
    if not os.environ.get(TIMES):
        pytest.skip(f"times are compared with {TIMES}=1 only, on a machine with nothing else to do")


class Handler(SimpleHTTPRequestHandler):
    """Serves a folder below the sub-path, without a log."""

    def translate_path(self, path):
        """The file of a path; outside the sub-path there is none."""
        inside = path.startswith(SUBPATH + "/")
        return super().translate_path(path[len(SUBPATH) :] if inside else "/nothing")

    def do_GET(self):
        """As asked for; of the host, not of the site, is the icon of a page that names none."""
        if self.path == "/favicon.ico":
            self.send_response(HTTPStatus.NO_CONTENT)
            self.end_headers()
        else:
            super().do_GET()

    def log_message(self, *_):
        """Nothing."""


@contextmanager
def served(folder):
    """The address at which the folder is served on this machine."""
    handler = functools.partial(Handler, directory=folder)
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}{SUBPATH}"
        finally:
            server.shutdown()
            thread.join()


def watched(page, address):
    """A list to which is added whatever goes wrong on the page, and requests to other places."""
    wrong = []
    page.on("console", lambda m: m.type in ("error", "warning") and wrong.append(f"{m.type}: {m.text}"))
    page.on("pageerror", lambda error: wrong.append(f"uncaught: {error}"))
    page.on("requestfailed", lambda r: wrong.append(f"failed: {r.url}"))
    page.on("response", lambda r: r.status >= 400 and wrong.append(f"{r.status}: {r.url}"))
    page.on(
        "request",
        lambda r: r.url.startswith((address, "data:", "blob:")) or wrong.append(f"elsewhere: {r.url}"),
    )
    return wrong


def pages_of(site):
    """The pages of a site, but for other people's programs and those that only lead to another page."""
    pages = [
        path for path in site.rglob("*.html") if path.relative_to(site).parts[0] not in ("_static", "lite")
    ]
    return sorted(
        str(path.relative_to(site))
        for path in pages
        if 'http-equiv="refresh"' not in path.read_text(encoding="utf-8")[:1000].lower()
    )


def explorers_of(page):
    """The explorers of a page once they are there."""
    found = page.locator("[class*=tag_explorer-]")
    for k in range(found.count()):
        found.nth(k).locator(".mesh-page").wait_for(timeout=1000 * READY_SECONDS)
    return [found.nth(k) for k in range(found.count())]


def visited(page, site, name, fragment=""):
    """The explorer of that name, on the page to which the browser is led."""
    page.goto(f"{site.as_uri()}/notebooks/{PLACES[name]}.html{fragment}")
    explorers_of(page)
    return page.locator(f".tag_explorer-{name}")


def shown(explorer):
    """What an explorer shows: numbers, mesh, texts and pictures."""
    return explorer.evaluate(SHOWN)


def elements(corners):
    """Comparable form of the corners of elements."""
    return sorted(sorted(map(tuple, element)) for element in corners.round(9).tolist())


def stage_of(scene, frame):
    """The stage that a frame shows, by library objects."""
    if not frame:
        return scene.before
    if not len(scene.trace):
        return Stage(scene.function, scene.film[frame - 1], scene.swaps)
    accepted = scene.trace[:frame][scene.trace["accepted"][:frame]]
    return Stage(scene.function, replayed(scene.start, accepted), len(accepted))


def replayed(mesh, accepted):
    """The mesh after these swaps, made one by one."""
    rows = mesh.elements.tolist()
    for a, b, c, d in accepted[["a", "b", "c", "d"]].tolist():
        rows = [row for row in rows if not {a, b} <= set(row)] + [[c, d, a], [d, c, b]]
    rows = np.array(rows)
    rows[Mesh(mesh.nodes, rows).areas < 0] = rows[Mesh(mesh.nodes, rows).areas < 0][:, ::-1]
    return Mesh(mesh.nodes, rows)


def assert_numbers(found, scene, frame):
    """Numbers and their texts on the page are those of the library."""
    expected = numbers(stage_of(scene, frame))
    assert found["frame"] == frame
    assert [label for label, _ in found["numbers"]] == list(expected)
    for (label, value), (_, text) in zip(found["numbers"], found["rows"], strict=True):
        assert value == pytest.approx(expected[label], rel=1e-5, abs=1e-9), (label, scene.title, frame)
        assert float(text) == pytest.approx(value, rel=0.006, abs=0.0006), label
