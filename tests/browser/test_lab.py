"""An explorer in JupyterLab: the kernel computes states that no page has."""

import inspect
import os
import re
import socket
import statistics
import subprocess
import sys
import time
from urllib.request import urlopen

import nbformat
import pytest
from user_criteria import kink, registered
from visiting import SHOWN, assert_numbers, skip_unless_timed

from meshlib.criteria import Criterion
from meshlib.thesis import explorers

pytest.importorskip("jupyterlab")

CODE = f"""from meshlib.thesis import explorers
import numpy as np
from meshlib.criteria import Criterion, plane_gradients, register

{inspect.getsource(kink)}
register(Criterion("kink", "edge", kink, "jump along x"))
explorers.swaps()"""
KERNEL = {"name": "python3", "display_name": "Python 3"}
START_SECONDS, RUN_SECONDS, TRY_SECONDS = 120, 60, 10
ON_DEMAND = 100  # milliseconds
LATENCY = """([select, text]) => new Promise((done, fail) => {
    const texts = Array.from(select.options, option => option.textContent.replaceAll('\u00a0', ' '));
    const title = document.querySelector('.mesh-explorer .title'), start = performance.now();
    const watcher = new MutationObserver(() => (watcher.disconnect(), done(performance.now() - start)));
    watcher.observe(title, { childList: true, characterData: true, subtree: true });
    setTimeout(() => fail(new Error(`nothing follows from ${text}, one of ${texts}`)), 30_000);
    select.selectedIndex = texts.indexOf(text);
    select.dispatchEvent(new Event('change', { bubbles: true })); })"""


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    """The address of a JupyterLab with a notebook that has one explorer."""
    folder, port = tmp_path_factory.mktemp("lab"), free_port()
    cell = nbformat.v4.new_code_cell(CODE)
    notebook = nbformat.v4.new_notebook(cells=[cell], metadata={"kernelspec": KERNEL})
    nbformat.write(notebook, folder / "explorer.ipynb")
    command = [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--allow-root",
        f"--port={port}",
        "--IdentityProvider.token=",
        "--ServerApp.port_retries=0",
        "--expose-app-in-browser",
        f"--ServerApp.root_dir={folder}",
    ]
    own = {
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTERLAB_SETTINGS_DIR": str(folder / "settings"),
        "JUPYTERLAB_WORKSPACES_DIR": str(folder / "workspaces"),
    }
    with (
        (folder / "log").open("w") as log,
        subprocess.Popen(command, env=os.environ | own, stdout=log, stderr=log) as process,
    ):
        address = f"http://127.0.0.1:{port}"
        wait_for(f"{address}/api", process)
        yield address
        process.kill()


def wait_for(address, process):
    """Until the server answers."""
    end = time.monotonic() + START_SECONDS
    while process.poll() is None and time.monotonic() < end:
        try:
            return urlopen(address).close()
        except OSError:
            time.sleep(0.2)
    raise RuntimeError("JupyterLab did not start")


@pytest.fixture(scope="module")
def page(chromium, lab):
    """The notebook, with its cell run."""
    with chromium.new_page(viewport={"width": 1300, "height": 1400}) as opened:
        opened.goto(f"{lab}/lab/tree/explorer.ipynb")
        opened.locator(".jp-Notebook .jp-Cell").first.wait_for(timeout=1000 * RUN_SECONDS)
        opened.wait_for_function("window.jupyterapp", timeout=1000 * RUN_SECONDS)
        run(opened)
        yield opened


def run(page):
    """Run the cell; before the kernel is connected nothing comes of it, so more than once."""
    row = page.locator(".mesh-explorer table tbody tr").first
    for _ in range(RUN_SECONDS // TRY_SECONDS):
        page.evaluate("void jupyterapp.commands.execute('notebook:run-all-cells')")
        page.wait_for_timeout(1000 * TRY_SECONDS)
        if row.count():
            break
    row.wait_for()


def choose(page, label, text):
    """An option of a menu by its text; the milliseconds until the view shows another state."""
    select = page.locator(".widget-dropdown", has_text=label).locator("select")
    return page.evaluate(LATENCY, [select.element_handle(), text])


def shown_by(page):
    return page.locator(".jp-OutputArea").first.evaluate(SHOWN)


def test_a_state_that_no_page_has_is_computed(page):
    settings = explorers.SWAPS.initial | {"function": "sphere"}
    assert "sphere" not in explorers.SWAPS.controls[0].paged
    choose(page, "function", "sphere")
    scene = explorers.SWAPS.computed(settings)
    assert_numbers(shown_by(page), scene, scene.frames - 1)


def test_the_player_leads_the_view(page):
    assert shown_by(page)["frame"] > 0
    # stop, which goes back to the start; by a call, as a dialogue of JupyterLab may lie above
    page.locator(".widget-play button").nth(1).evaluate("button => button.click()")
    page.wait_for_function("() => document.querySelector('.mesh-explorer').shown().frame === 0")


def test_a_user_defined_criterion_is_drawn_and_played_with_its_costs(page):
    choose(page, "criterion", "KINK: jump along x")
    choose(page, "function", "SR1")
    with registered(Criterion("kink", "edge", kink, "jump along x")):
        scene = explorers.SWAPS.computed(explorers.SWAPS.initial | {"criterion": "kink"})
    page.locator(".widget-play button").first.evaluate("button => button.click()")
    page.wait_for_function("() => document.querySelector('.mesh-explorer').shown().frame > 3")
    page.locator(".widget-play button").first.evaluate("button => button.click()")
    found, note = shown_by(page), page.locator(".mesh-explorer .note").text_content()
    assert found["title"] == "SR1 on 33 nodes, KINK-L2"
    assert_numbers(found, scene, found["frame"])
    row = scene.trace[found["frame"] - 1]
    costs = re.search(r"five edges: (\S+) before, (\S+) after", note).groups()
    assert tuple(map(float, costs)) == pytest.approx((row["old"], row["new"]), rel=1e-3)


def test_a_state_on_demand_is_there_at_once(page):
    times = [choose(page, "function", name) for name in ("franke", "saddle", "gentle", "steep", "convex")]
    skip_unless_timed()
    assert statistics.median(times) <= ON_DEMAND, times
