"""The explorer: its engine gives the library's numbers, its view follows its controls."""
import base64
import re

import numpy as np
import pytest

from meshlib import Interpolant, MeshError, problems, quality, refined, swapped
from meshlib.explorer import Explorer, Settings, state
from meshlib.explorer.engine import LARGEST_ANGLE_LIMIT, NO_SWAPS

ANYWIDGET = pytest.importorskip("anywidget")
VIEW_MIME = "application/vnd.jupyter.widget-view+json"
PNG_HEAD = b"\x89PNG\r\n"


# -- the engine ---------------------------------------------------------------------------


def by_hand(settings):
    """The adapted mesh, by library calls written out."""
    u, mesh = problems.functions[settings.problem], problems.mesh(settings.nodes)
    if settings.criterion != NO_SWAPS:
        mesh = swapped(mesh, u, settings.criterion, settings.norm,
                       order=problems.order(settings.nodes), min_angle=settings.min_angle).mesh
    return refined(mesh, u, settings.refine_by, settings.fraction, settings.mark,
                   settings.split).mesh


@pytest.mark.parametrize("settings", [
    Settings(),
    Settings("SR2", "81", "abn", 1),
    Settings("DD1", "33-refined", "dlp", "max", min_angle=10),
    Settings("SR1", "33", NO_SWAPS, fraction=0.2, mark="edge"),
    Settings("SR3", "33", "largest-angle", fraction=1.0, refine_by="jnd", split="red-green"),
    Settings("franke", "33-franke", "dfp", fraction=0.5, mark="density", split="longest-edge"),
], ids=str)
def test_numbers_are_those_of_library_calls(settings):
    u, mesh, adapted = problems.functions[settings.problem], by_hand(settings), state(settings).adapted
    assert adapted.mesh.equals(mesh)
    assert adapted.l2_error == pytest.approx(Interpolant(mesh, u).l2_error(u), rel=1e-13)
    assert adapted.quality.mean == quality(mesh).mean
    assert np.array_equal(adapted.error, Interpolant(mesh, u).error_on_grid(u)[2])


def test_start_stage_is_the_start_mesh():
    found = state(Settings("SR1", "81", fraction=0.4))
    assert found.start.mesh.equals(problems.mesh("81")) and found.start.swaps == 0
    assert found.adapted.mesh.n_nodes > found.start.mesh.n_nodes


def test_nothing_to_do_leaves_the_start_stage():
    found = state(Settings(criterion=NO_SWAPS))
    assert found.adapted is found.start


def test_rows_name_every_number_once_before_and_after():
    rows = {label: numbers for label, *numbers in state(Settings()).rows}
    assert rows["Nodes"] == ["33", "33"] and rows["Edges"] == ["88", "88"]
    assert rows["Swaps"] == ["0", "17"] and rows["L2 error"][1] == "0.0170"
    assert len(rows) == 12


@pytest.mark.parametrize("wrong, message", [
    ({"problem": "SR9"}, "function 'SR9' is not known; did you mean 'SR"),
    ({"nodes": "34"}, "node set '34' is not known"),
    ({"criterion": "jmd"}, "criterion 'jmd' is not known; did you mean 'jnd'"),
    ({"norm": 3}, "norm 3 is not known"),
    ({"min_angle": LARGEST_ANGLE_LIMIT + 1}, "give whole degrees from 0 to 30"),
    ({"min_angle": 7.5}, "min_angle is 7.5"),
    ({"fraction": 20}, "fraction is 20; give a number from 0 to 1"),
    ({"refine_by": NO_SWAPS}, "criterion 'none' is not known"),
    ({"mark": "worst"}, "mark 'worst' is not known"),
    ({"split": "centriod"}, "did you mean 'centroid'"),
])
def test_wrong_settings_name_the_remedy(wrong, message):
    with pytest.raises(MeshError, match=re.escape(message)):
        Explorer(**wrong)


# -- controls and view --------------------------------------------------------------------


def array(stage, name, dtype):
    return np.frombuffer(stage[name], dtype)


def test_view_holds_the_state_as_plain_data():
    explorer = Explorer("SR2", "81", fraction=0.2)
    for packed, stage in zip(explorer.view.state["stages"],
                             (explorer.state.start, explorer.state.adapted), strict=True):
        assert np.array_equal(array(packed, "elements", "<u2"), stage.mesh.elements.ravel())
        assert np.array_equal(array(packed, "edges", "<u2"), stage.mesh.edges.ravel())
        assert np.allclose(array(packed, "nodes", "<f4"), stage.mesh.nodes.ravel())
        assert np.allclose(array(packed, "values", "<f4"), stage.interpolant.values, atol=1e-7)
        assert np.allclose(array(packed, "error", "<f4"), np.abs(stage.error).ravel(), atol=1e-7)


@pytest.mark.parametrize("name, value", [
    ("problem", "SR3"), ("nodes", "81"), ("criterion", "dfp"), ("criterion", NO_SWAPS),
    ("norm", "lexicographic"), ("min_angle", 20), ("fraction", 0.5)])
def test_view_follows_each_control(name, value):
    explorer = Explorer()
    before = explorer.view.state
    explorer.controls[name].value = value
    assert explorer.view.state["title"] != before["title"]
    assert explorer.view.state["stages"] != before["stages"]
    assert getattr(explorer.state.settings, name) == value


@pytest.mark.parametrize("name, value", [("refine_by", "jnd"), ("mark", "density"),
                                         ("split", "red-green")])
def test_rules_of_refinement_matter_once_there_is_some(name, value):
    explorer = Explorer("SR2", fraction=0.3)
    before = explorer.view.state
    explorer.controls[name].value = value
    assert explorer.view.state["stages"][1] != before["stages"][1]


def test_controls_without_effect_are_disabled():
    explorer = Explorer(criterion=NO_SWAPS)
    idle = {name for name, control in explorer.controls.items() if control.disabled}
    assert idle == {"norm", "min_angle", "refine_by", "mark", "split"}
    explorer.controls["criterion"].value, explorer.controls["fraction"].value = "jnd", 0.05
    assert not any(control.disabled for control in explorer.controls.values())


def test_every_setting_has_a_labelled_control():
    controls = Explorer().controls
    assert list(controls) == list(Settings.__dataclass_fields__)
    assert all(control.description for control in controls.values())


def test_colours_of_the_view_are_matplotlibs():
    matplotlib = pytest.importorskip("matplotlib")
    script = Explorer().view._esm
    for name in ("viridis", "cividis"):
        listed = re.search(rf"const {name.upper()} = \[(.*?)\]", script, re.S)[1]
        stops = re.findall(r"#\w{6}", listed)
        table = matplotlib.colormaps[name](np.arange(len(stops)) / 10)
        assert stops == [matplotlib.colors.to_hex(colour) for colour in table]


# -- on a page ----------------------------------------------------------------------------


def test_bundle_has_the_live_view_a_picture_and_a_line():
    pytest.importorskip("matplotlib")
    bundle = Explorer()._repr_mimebundle_()
    assert VIEW_MIME in bundle
    assert bundle["text/plain"] == ("Explorer(SR1 on 33 nodes, JND-L2: 88 edges, 17 swaps, "
                                    "L2 error 0.0170)")
    assert base64.b64decode(bundle["image/png"]).startswith(PNG_HEAD)


def test_picture_leaves_no_figure_open():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    before = pyplot.get_fignums()
    Explorer()._repr_mimebundle_()
    assert pyplot.get_fignums() == before


def test_line_of_text_tells_all_settings_in_effect():
    text = repr(Explorer("SR2", "81", "abn", 1, min_angle=5, fraction=0.2, mark="edge"))
    assert text.startswith("Explorer(SR2 on 81 nodes, ABN-L1, angles from 5°, "
                           "then 20% by ABN (edge, centroid): ")
