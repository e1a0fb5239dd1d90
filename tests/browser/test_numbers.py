"""Numbers of random states, and how fast and how heavy explorers are."""
import gzip
import statistics

import numpy as np
import pytest
from visiting import PLACES, READY_SECONDS, assert_numbers, shown, skip_unless_timed, visited

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
            page.evaluate("hash => { location.hash = hash; window.dispatchEvent(new Event('hashchange')); }",
                          f"explorer-{name}?{values}&frame={frame}")
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
def test_an_explorer_is_usable_soon(chromium, site, quiet, name):
    times = []
    for _ in range(5):
        with chromium.new_page() as page:
            page.goto(f"{site.as_uri()}/notebooks/{PLACES[name]}.html", wait_until="commit")
            page.locator(f".tag_explorer-{name} .mesh-page").wait_for(timeout=1000 * READY_SECONDS)
            times.append(page.evaluate("performance.now()"))
    assert statistics.median(times) <= USABLE, times


@pytest.mark.parametrize("place", sorted(set(PLACES.values())))
def test_explorers_of_a_page_weigh_little(site, place):
    static = site / "_static"
    files = [static / "explorers.js", static / "explorers.css",
             *(static / "explorers" / f"{name}.js" for name in PLACES if PLACES[name] == place)]
    assert sum(len(gzip.compress(file.read_bytes())) for file in files) <= WEIGHT
