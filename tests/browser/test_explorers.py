"""Every control of every explorer, by keyboard and by mouse, against what Python computes."""

import numpy as np
import pytest
from visiting import PLACES, assert_numbers, elements, shown, stage_of, visited

from meshlib.thesis import explorers


@pytest.fixture(scope="module")
def pages(chromium, site):
    """Opens the page of an explorer, each page once."""
    opened = {}

    def explorer(name):
        if PLACES[name] not in opened:
            opened[PLACES[name]] = chromium.new_page(reduced_motion="reduce")
            visited(opened[PLACES[name]], site, name)
        return opened[PLACES[name]].locator(f".tag_explorer-{name}")

    yield explorer
    for page in opened.values():
        page.close()


def settings_of(explorer, exploration):
    """The settings that the controls of a page show."""
    found = {}
    for control in exploration.controls:
        value = explorer.locator(f"#{exploration.name}-{control.name}").input_value()
        found[control.name] = control.paged[int(value)]
    return found


def assert_agrees(explorer, exploration):
    """Numbers, their texts and the mesh on the page are those of the library."""
    found = shown(explorer)
    scene = exploration.computed(settings_of(explorer, exploration))
    assert_numbers(found, scene, found["frame"])
    corners = np.array(found["corners"]).reshape(-1, 3, 2)
    assert elements(corners) == elements(stage_of(scene, found["frame"]).mesh.corners)
    return found


def moved_by(way, explorer, control):
    """Move a control one option on, or back from its end."""
    target = explorer.locator(f"#{control}")
    before, tag = target.input_value(), target.evaluate("e => e.tagName")
    if tag == "SELECT":
        last = target.locator("option").count() - 1
        if way == "mouse":
            target.select_option(index=(int(before) + 1) % (last + 1))
        else:
            target.press("ArrowUp" if int(before) == last else "ArrowDown")
    elif way == "mouse":
        box, last = target.bounding_box(), int(target.get_attribute("max"))
        share = 0.4 if int(before) > last / 2 or (last == 1 and before == "1") else 0.75
        target.click(position={"x": share * box["width"], "y": box["height"] / 2})
    else:
        target.press("ArrowLeft" if before == target.get_attribute("max") else "ArrowRight")
    assert target.input_value() != before
    return target


@pytest.mark.parametrize("way", ["keyboard", "mouse"])
@pytest.mark.parametrize("name", explorers.ALL)
def test_each_control_leads_to_the_state_that_python_computes(pages, name, way):
    exploration, explorer = explorers.ALL[name], pages(name)
    assert_agrees(explorer, exploration)
    for control in exploration.controls:
        if len(control.paged) == 1:
            continue
        before = shown(explorer)
        moved_by(way, explorer, f"{name}-{control.name}")
        after = assert_agrees(explorer, exploration)
        assert after["title"] != before["title"], control.name
        if after["corners"] != before["corners"]:
            assert after["pictures"] != before["pictures"], control.name
    before = shown(explorer)
    moved_by(way, explorer, f"{name}-frame")
    after = assert_agrees(explorer, exploration)
    assert after["frame"] != before["frame"]
    if after["corners"] != before["corners"]:  # a limit may leave nothing to swap
        assert after["pictures"] != before["pictures"]
