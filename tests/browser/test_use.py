"""Explorers in use: links, files, costs under the pointer, films, themes, and readers with aids."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from conftest import SITE
from visiting import PLACES, READY_SECONDS, explorers_of, pages_of, shown, visited

from meshlib import criteria, quality
from meshlib.thesis import explorers

AXE = "axe-core@4"
MARGIN = 6  # pixels around a mesh, as in drawing.js
MOVING = ".title, .note, .readout, .scale span:not(.bar), output, caption, th, td"  # texts, in their places
BOXES = f"""e => {{ const top = e.querySelector('.mesh-page').getBoundingClientRect().y;
    return Array.from(e.querySelectorAll('.mesh-page *:not({MOVING}):not(option)'), part => {{
        const {{ x, y, width, height }} = part.getBoundingClientRect();
        return [part.tagName, part.className, ...[x, y - top, width, height].map(Math.round)]; }}); }}"""


@pytest.fixture
def page(chromium):
    """A page of its own, with a clipboard and downloads."""
    with chromium.new_page(accept_downloads=True) as opened:
        yield opened


# -- links and files ------------------------------------------------------------------------


@pytest.mark.parametrize("name", PLACES)
def test_a_link_leads_to_the_same_state(page, site, name):
    explorer = visited(page, site, name)
    explorer.locator("select").first.select_option(index=1)
    explorer.locator(f"#{name}-frame").press("ArrowLeft")
    before, link = shown(explorer), explorer.get_by_role("link", name="Link to this state")
    fragment = link.evaluate("e => e.hash")
    assert fragment.startswith(f"#explorer-{name}?")
    page.goto("about:blank")
    after = shown(visited(page, site, name, fragment))
    assert after == before


def test_a_wrong_link_shows_what_it_can(page, site):
    explorer = visited(page, site, "swaps", "#explorer-swaps?function=SR2&nodes=none&frame=9999")
    assert shown(explorer)["title"].startswith("SR2 on 33 nodes")


def saved(page, explorer, kind):
    with page.expect_download() as download:
        explorer.get_by_role("button", name=f"Save as {kind}").click()
    return download.value


def test_a_state_is_saved_as_svg(page, site):
    explorer = visited(page, site, "limits")
    file = saved(page, explorer, "SVG")
    assert file.suggested_filename == "SR3-on-81-nodes-ABN-L2-angles-from-8-adapted.svg"
    picture = ET.fromstring(Path(file.path()).read_text(encoding="utf-8"))
    texts = [text.text for text in picture.findall(".//{*}text")]
    assert texts[0] == "SR3 on 81 nodes, ABN-L2, angles from 8°: adapted"
    assert "Edges 208" in texts[1] and "L2 error 0.0550" in texts[1]
    assert len(picture.findall(".//{*}g")) == 4 and len(picture.findall(".//{*}image")) == 1
    lines = [path for path in picture.findall(".//{*}path") if path.get("stroke") == "white"]
    edges = max(path.get("d").count("M") for path in lines)
    assert edges == 208


def test_a_state_is_saved_as_png(page, site):
    file = saved(page, visited(page, site, "limits"), "PNG")
    assert file.suggested_filename.endswith("-adapted.png")
    assert Path(file.path()).read_bytes().startswith(b"\x89PNG\r\n")


# -- costs under the pointer ----------------------------------------------------------------------


def told(explorer):
    return explorer.locator(".readout").text_content()


def coordinates(text):
    return [(float(x), float(y)) for x, y in re.findall(r"\((\d\.\d+), (\d\.\d+)\)", text)]


@pytest.mark.parametrize("criterion", ["jnd", "abn", "dlp", "dfp"])
def test_arrow_keys_tell_the_cost_of_one_edge_after_the_other(page, site, criterion):
    explorer = visited(page, site, "swaps", f"#explorer-swaps?criterion={criterion}&frame=0")
    scene = explorers.SWAPS.computed(explorers.SWAPS.initial | {"criterion": criterion})
    costs = criteria.costs(scene.start, scene.function, criterion)
    expected = {
        frozenset(map(tuple, scene.start.nodes[edge].round(2).tolist())): cost
        for edge, cost in zip(scene.start.edges, costs, strict=True)
    }
    seen, mesh = set(), explorer.locator(".mesh canvas")
    for _ in range(20):
        mesh.press("ArrowRight")
        ends = frozenset(coordinates(told(explorer)))
        cost = re.search(r": \w+ (\S+)\.$", told(explorer))
        assert float(cost[1] if cost else 0) == pytest.approx(expected[ends], rel=1e-3, abs=1e-12)
        seen.add(ends)
    assert len(seen) == 20
    mesh.blur()
    assert told(explorer).startswith("Point at")


def test_the_pointer_tells_edges_and_elements(page, site):
    explorer = visited(page, site, "swaps", "#explorer-swaps?criterion=largest-angle&frame=0")
    scene, plain = explorers.SWAPS.computed(explorers.SWAPS.initial), shown(explorer)["pictures"]
    largest, canvas = scene.start.areas.argmax(), explorer.locator(".mesh canvas")

    def hover(x, y):
        size = canvas.bounding_box()["width"] - 2 * MARGIN
        canvas.hover(position={"x": MARGIN + size * x, "y": MARGIN + size * (1 - y)})
        return told(explorer)

    angle = quality(scene.start).maximum_angle[largest]
    cost = np.radians(angle) - np.pi / 3
    assert hover(*scene.start.corners[largest].mean(axis=0)) == (
        f"Element with an angle of {angle:.4g}°: largest-angle {cost:.4g}."
    )
    edge = scene.start.nodes[scene.start.edges[~scene.start.boundary]][0]
    assert sorted(coordinates(hover(*edge.mean(axis=0)))) == sorted(map(tuple, edge.tolist()))
    assert shown(explorer)["pictures"][0] != plain[0]


# -- films ------------------------------------------------------------------------------------------


def test_a_film_plays_to_its_end_and_pauses(page, site):
    explorer = visited(page, site, "refinement")
    frame, button = explorer.locator("#refinement-frame"), explorer.locator(".play")
    button.click()
    assert button.text_content() == "Pause"
    page.wait_for_function("document.querySelector('#refinement-frame').value === '3'", timeout=20_000)
    assert button.text_content() == "Play"
    button.click()
    button.click()
    assert button.text_content() == "Play" and int(frame.input_value()) < 3


def test_where_motion_is_not_wanted_nothing_moves_by_itself(chromium, site):
    with chromium.new_page(reduced_motion="reduce") as page:
        explorer = visited(page, site, "refinement")
        frame, button = explorer.locator("#refinement-frame"), explorer.locator(".play")
        assert button.text_content() == "Next"
        for expected in ("0", "1", "2"):
            button.click()
            page.wait_for_timeout(500)
            assert frame.input_value() == expected


def test_the_tried_edge_is_told_with_its_cost(page, site):
    trace = explorers.SWAPS.computed(explorers.SWAPS.initial).trace
    for k in (0, 11, 40):
        explorer = visited(page, site, "swaps", f"#explorer-swaps?frame={k + 1}")
        note = explorer.locator(".note").text_content()
        old, new = map(float, re.search(r"edges: (\S+) before, (\S+) after", note).groups())
        assert (old, new) == pytest.approx((trace["old"][k], trace["new"][k]), rel=1e-3)
        assert note.endswith("Swapped." if trace["accepted"][k] else "Kept.")
        page.goto("about:blank")


def test_controls_without_effect_are_disabled(page, site):
    explorer = visited(page, site, "refinement", "#explorer-refinement?percentage=0")
    assert explorer.locator("#refinement-mark").is_disabled()
    explorer.locator("#refinement-percentage").press("ArrowRight")
    assert explorer.locator("#refinement-mark").is_enabled()


# -- surface, size and theme ---------------------------------------------------------------------------


def test_the_surface_turns_by_keys_mouse_and_touch(chromium, site):
    with chromium.new_page(has_touch=True) as page:
        explorer = visited(page, site, "swaps")
        surface, pictures = explorer.locator(".surface canvas"), [shown(explorer)["pictures"][3]]
        surface.press("ArrowRight")
        pictures.append(shown(explorer)["pictures"][3])
        surface.evaluate("e => e.scrollIntoView({ block: 'center', behavior: 'instant' })")
        box = surface.bounding_box()
        page.mouse.move(box["x"] + 50, box["y"] + 50)
        page.mouse.down()
        page.mouse.move(box["x"] + 90, box["y"] + 60)
        page.mouse.up()
        pictures.append(shown(explorer)["pictures"][3])
        touch(page, box)
        pictures.append(shown(explorer)["pictures"][3])
        assert len(set(pictures)) == 4


def touch(page, box):
    """A finger drawn to the right."""
    session = page.context.new_cdp_session(page)
    for kind, dx in (("touchStart", 50), ("touchMove", 70), ("touchMove", 110)):
        points = [{"x": box["x"] + dx, "y": box["y"] + 80}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


@pytest.mark.parametrize("width", [1300, 375])
@pytest.mark.parametrize("name", PLACES)
def test_nothing_jumps_when_a_control_moves(chromium, site, name, width):
    with chromium.new_page(viewport={"width": width, "height": 900}) as page:
        explorer = visited(page, site, name)
        before = explorer.evaluate(BOXES)
        for control in explorers.ALL[name].controls:
            target = explorer.locator(f"#{name}-{control.name}")
            if target.is_enabled():
                target.press("ArrowDown")
                assert explorer.evaluate(BOXES) == before, control.name
        explorer.locator(f"#{name}-frame").press("ArrowLeft")
        assert explorer.evaluate(BOXES) == before


def test_dark_pages_have_light_ink(chromium, site):
    inks = {}
    for scheme in ("light", "dark"):
        with chromium.new_page(color_scheme=scheme) as page:
            explorer = visited(page, site, "swaps")
            inks[scheme] = explorer.locator(".mesh-explorer").evaluate("e => getComputedStyle(e).color")
            inks[scheme, "lines"] = shown(explorer)["pictures"][1]
    light, dark = (sum(map(int, re.findall(r"\d+", inks[scheme])[:3])) for scheme in ("light", "dark"))
    assert light < 200 < 500 < dark
    assert inks["light", "lines"] != inks["dark", "lines"]


# -- readers with aids --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def axe(tmp_path_factory):
    """The script of axe-core, from npm."""
    npm, folder = shutil.which("npm"), tmp_path_factory.mktemp("axe")
    if not npm:
        pytest.skip("no npm, from which axe-core comes")
    done = subprocess.run(
        [npm, "install", "--prefix", folder, "--no-audit", "--no-fund", AXE],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    if done.returncode:
        pytest.skip(f"axe-core could not be installed: {done.stderr.strip().splitlines()[-1:]}")
    return (folder / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", pages_of(SITE))
def test_no_page_has_a_serious_fault(chromium, site, axe, name, scheme):
    with chromium.new_page(color_scheme=scheme) as page:
        page.goto((site / name).as_uri(), timeout=1000 * READY_SECONDS)
        explorers_of(page)
        page.evaluate(axe)
        found = page.evaluate("axe.run({ resultTypes: ['violations'] })")
        serious = [fault for fault in found["violations"] if fault["impact"] in ("serious", "critical")]
        assert not serious, [
            (fault["id"], [node["html"][:150] for node in fault["nodes"][:5]]) for fault in serious
        ]
