"""Numbers of random states, and how fast and how heavy explorers are."""

import gzip
import re
import statistics

import numpy as np
import pytest
from visiting import PLACES, READY_SECONDS, assert_numbers, pages_of, shown, skip_unless_timed, visited

from meshlib.thesis import explorers

STATES = {"swaps": 60, "refinement": 50, "limits": 40, "orders": 40, "movement": 6, "approximation": 4}
SEED = 200  # of the states
FRAME, WORST, WEIGHT, USABLE = 16, 50, 1.5e6, 1000  # milliseconds and bytes
TIMED = """async e => {
    const input = e.querySelector('.mesh-controls select, .mesh-controls input'), times = [];
    for (let k = 0; k < 40; k++) {
        const last = input.tagName === 'SELECT' ? input.options.length : Number(input.max) + 1;
        input.value = (Number(input.value) + 1) % last;
        const start = performance.now();
        input.dispatchEvent(new Event('input', { bubbles: true }));
        e.querySelector('canvas').getContext('2d').getImageData(0, 0, 1, 1);  // all is drawn
        times.push(performance.now() - start);
        await new Promise(requestAnimationFrame); }
    return times; }"""

USING = """(() => {  // in each frame: is the mesh drawn, and does a control that is moved change it?
    const opaque = (canvas) => canvas?.width && canvas.getContext('2d')
        .getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[3];
    const look = () => {
        const page = document.querySelector('.tag_explorer-NAME .mesh-page');
        const canvas = page?.querySelector('.mesh canvas'), frame = page?.querySelector('[id$=-frame]');
        if (opaque(canvas)) {
            const before = canvas.toDataURL();
            frame.value = 0;
            frame.dispatchEvent(new Event('input', { bubbles: true }));
            if (canvas.toDataURL() !== before) return (window.usable = performance.now()); }
        requestAnimationFrame(look); };
    requestAnimationFrame(look); })();"""


@pytest.mark.parametrize("name", PLACES)
def test_random_states_have_the_numbers_of_python(chromium, site, name):
    """Two hundred of them, by their links."""
    exploration, rng = explorers.ALL[name], np.random.default_rng(SEED)
    with chromium.new_page() as page:
        explorer = visited(page, site, name)
        for _ in range(STATES[name]):
            settings = {c.name: c.paged[rng.integers(len(c.paged))] for c in exploration.controls}
            scene = exploration.computed(settings)
            frame = int(rng.integers(scene.frames))
            values = "&".join(f"{key}={value}" for key, value in settings.items())
            page.evaluate(
                "hash => { location.hash = hash; window.dispatchEvent(new Event('hashchange')); }",
                f"explorer-{name}?{values}&frame={frame}",
            )
            assert_numbers(shown(explorer), scene, frame)


def test_there_are_two_hundred_states():
    assert sum(STATES.values()) == 200


# -- speed and weight ---------------------------------------------------------------------------------


@pytest.fixture
def quiet():
    """A machine that somebody says has nothing else to do."""
    skip_unless_timed()


@pytest.mark.parametrize("name", PLACES)
def test_a_change_is_drawn_within_a_frame(chromium, site, quiet, name):
    with chromium.new_page() as page:
        explorer = visited(page, site, name)
        explorer.evaluate(TIMED)  # by then compiled
        times = explorer.evaluate(TIMED)
    assert statistics.median(times) <= FRAME, times
    assert max(times) <= WORST, times


@pytest.mark.parametrize("name", PLACES)
def test_an_explorer_is_usable_soon(chromium, address, quiet, name):
    times = []
    for _ in range(5):
        with chromium.new_page() as page:
            page.add_init_script(USING.replace("NAME", name))
            page.goto(f"{address}/notebooks/{PLACES[name]}.html", wait_until="commit")
            used = page.wait_for_function("window.usable", timeout=1000 * READY_SECONDS)
            times.append(used.json_value())
    assert statistics.median(times) <= USABLE, times


def test_pages_carry_no_state_of_widgets_that_they_do_not_show(site):
    assert not [
        path for path in pages_of(site) if "widget-state+json" in (site / path).read_text(encoding="utf-8")
    ]


def test_no_page_waits_for_its_icons(site):
    for path in pages_of(site):
        (script,) = re.findall("<script.*fontawesome.js", (site / path).read_text(encoding="utf-8"))
        assert " defer " in script, path


@pytest.mark.parametrize("place", sorted(set(PLACES.values())))
def test_explorers_of_a_page_weigh_little(site, place):
    static = site / "_static"
    files = [
        static / "explorers.js",
        static / "explorers.css",
        *(static / "explorers" / f"{name}.js" for name in PLACES if PLACES[name] == place),
    ]
    assert sum(len(gzip.compress(file.read_bytes())) for file in files) <= WEIGHT
