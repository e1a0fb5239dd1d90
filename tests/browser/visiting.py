"""What the browser tests share: the site on a server, and a watch over what a page asks for."""
import functools
import threading
from contextlib import contextmanager
from http import HTTPStatus
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

SUBPATH = "/some/where"  # a site need not be at the root of its host
READY_SECONDS = 20  # on a busy machine; the speed is tested apart


class Handler(SimpleHTTPRequestHandler):
    """Serves a folder below the sub-path, without a log."""

    def translate_path(self, path):
        """The file of a path; outside the sub-path there is none."""
        inside = path.startswith(SUBPATH + "/")
        return super().translate_path(path[len(SUBPATH):] if inside else "/nothing")

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
    page.on("request", lambda r: r.url.startswith((address, "data:", "blob:"))
            or wrong.append(f"elsewhere: {r.url}"))
    return wrong


def explorers_of(page):
    """The explorers of a page once they are there."""
    found = page.locator("[class*=tag_explorer-]")
    for k in range(found.count()):
        found.nth(k).locator(".mesh-page").wait_for(timeout=1000 * READY_SECONDS)
    return [found.nth(k) for k in range(found.count())]
