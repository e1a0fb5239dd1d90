"""User-defined criteria on a page without a kernel: drawn, played, and told with their costs."""

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from user_criteria import NAMES, registered
from visiting import READY_SECONDS, assert_numbers, elements, shown, stage_of

from meshlib import criteria
from meshlib.refinement.marking import averaged
from meshlib.thesis import explorers

EXTENSIONS = Path(__file__).parents[2] / "book" / "_ext"
EVERY = (*NAMES, "gradient-spread")
DRAWN = 50  # different colours at least of a mesh that is drawn
PARTS = {"edge": "five edges", "element": "two elements", "node": "four nodes"}
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Explorer</title>
<link rel="stylesheet" href="_static/explorers.css"><script async src="_static/explorers.js"></script>
<script async src="_static/explorers/NAME.js"></script>
<div class="tag_explorer-NAME"><div class="cell_output">The picture.</div></div></html>"""
COLOURS = """canvas => { const pen = canvas.getContext('2d');
    const { data } = pen.getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size; }"""


def on_page(exploration, **values):
    """An exploration with these values of its controls on the page, and the initial ones of others."""
    return replace(exploration, controls=tuple(
        replace(c, given_on_page=tuple(values.get(c.name, [exploration.initial[c.name]])))
        for c in exploration.controls))  # fmt: skip


@pytest.fixture(scope="module")
def visit(chromium, tmp_path_factory):
    """Leads to a state of the page of an exploration, which is made as for the book."""
    pytest.importorskip("sphinx")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(EXTENSIONS)
        from explorers import write
    folder, wrong = tmp_path_factory.mktemp("site"), []
    with registered(), chromium.new_page() as page:
        page.on("pageerror", lambda error: wrong.append(str(error)))
        made = on_page(explorers.SWAPS, criterion=EVERY, norm=(2, "lexicographic"))
        write(folder / "_static", (made, on_page(explorers.REFINEMENT, refine_by=NAMES)))
        for name in ("swaps", "refinement"):
            (folder / f"{name}.html").write_text(PAGE.replace("NAME", name), encoding="utf-8")

        def explorer(name, **settings):
            wanted = "&".join(f"{key}={value}" for key, value in settings.items())
            page.goto("about:blank")
            page.goto(f"{(folder / name).as_uri()}.html#explorer-{name}?{wanted}")
            found = page.locator(f".tag_explorer-{name}")
            found.locator(".mesh-page").wait_for(timeout=1000 * READY_SECONDS)
            return found

        yield explorer
    assert wrong == []


def numbers_in(text):
    """The numbers in the last sentence of a text."""
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?(?:e-\d+)?", re.split("[:°]", text)[-1])]


def costs_by_hand(mesh, function, name, place):
    criterion = criteria.get(name)
    return averaged(mesh, criterion.costs(mesh, function), criterion.on, place)


@pytest.mark.parametrize("norm", [2, "lexicographic"])
@pytest.mark.parametrize("name", EVERY)
def test_tries_are_drawn_and_told_with_the_costs_of_the_trace(visit, name, norm):
    scene = explorers.SWAPS.computed(explorers.SWAPS.initial | {"criterion": name, "norm": norm})
    for frame in (0, 1, len(scene.trace) // 2, len(scene.trace)):
        explorer = visit("swaps", criterion=name, norm=norm, frame=frame)
        found = shown(explorer)
        assert_numbers(found, scene, frame)
        mesh = stage_of(scene, frame).mesh
        assert elements(np.reshape(found["corners"], (-1, 3, 2))) == elements(mesh.corners)
        assert explorer.locator(".mesh canvas").evaluate(COLOURS) > DRAWN
        if frame:
            note, row = explorer.locator(".note").text_content(), scene.trace[frame - 1]
            pattern = rf"Cost of the {PARTS[criteria.get(name).on]}: (\S+) before, (\S+) after. (\w+)\.$"
            old, new, done = re.search(pattern, note).groups()
            assert (float(old), float(new)) == pytest.approx((row["old"], row["new"]), rel=1e-3)
            assert done == ("Swapped" if row["accepted"] else "Kept")


@pytest.mark.parametrize("name", EVERY)
def test_the_cost_of_an_edge_is_told_after_the_last_swap(visit, name):
    scene = explorers.SWAPS.computed(explorers.SWAPS.initial | {"criterion": name})
    explorer, mesh = visit("swaps", criterion=name), scene.film[-1]
    on, costs = criteria.get(name).on, criteria.costs(mesh, scene.function, name)
    edges = {frozenset(map(tuple, mesh.nodes[edge].tolist())): e for e, edge in enumerate(mesh.edges)}
    canvas, told = explorer.locator(".mesh canvas"), 0
    for _ in range(30):
        canvas.press("ArrowRight")
        text = explorer.locator(".readout").text_content()
        places = re.findall(r"\((\d\.\d+), (\d\.\d+)\)", text)
        e = edges[frozenset((float(x), float(y)) for x, y in places)]
        if text.endswith("on the boundary."):
            assert mesh.boundary[e] and on != "node"
            continue
        parts = {"edge": [e], "element": mesh.edge_elements[e], "node": mesh.edges[e]}[on]
        assert sorted(numbers_in(text)) == pytest.approx(sorted(costs[parts]), rel=1e-3, abs=1e-12)
        told += 1
    assert told > 10


@pytest.mark.parametrize("name", NAMES)
def test_the_cost_of_an_element_is_told_in_every_frame_of_a_film(visit, name):
    scene = explorers.REFINEMENT.computed(explorers.REFINEMENT.initial | {"refine_by": name})
    for frame, mesh in enumerate(scene.meshes):
        explorer = visit("refinement", refine_by=name, frame=frame)
        largest = mesh.areas.argmax()
        expected = costs_by_hand(mesh, scene.function, name, "element")[largest]
        canvas = explorer.locator(".mesh canvas")
        size = canvas.bounding_box()["width"] - 12  # without its margins
        x, y = mesh.corners[largest].mean(axis=0)
        canvas.hover(position={"x": 6 + size * x, "y": 6 + size * (1 - y)})
        told = explorer.locator(".readout").text_content()
        assert told.startswith("Element with an angle of")
        assert numbers_in(told) == [pytest.approx(expected, rel=1e-3, abs=1e-12)]


def test_the_film_of_a_user_defined_criterion_plays_to_its_end(visit):
    explorer = visit("refinement", refine_by="valence", frame=0)
    button, frame = explorer.locator(".play"), explorer.locator("#refinement-frame")
    button.click()
    assert button.text_content() == "Pause"
    explorer.page.wait_for_function("document.querySelector('#refinement-frame').value === '3'")
    assert button.text_content() == "Play" and frame.input_value() == "3"


def test_the_menu_of_a_page_leads_from_a_built_in_to_a_user_defined_criterion(visit):
    explorer = visit("swaps", criterion="gradient-spread")
    titles = []
    for option in range(len(EVERY)):
        explorer.locator("#swaps-criterion").select_option(index=option)
        titles.append(shown(explorer)["title"])
    assert titles == [f"SR1 on 33 nodes, {name.upper()}-L2" for name in EVERY]
