"""The explorer: its scenes give the library's numbers, and atlas and view hold its scenes."""

import base64
import json
import re

import numpy as np
import pytest

from meshlib import Interpolant, MeshError, approximate, problems, quality, refined, smoothed, swapped
from meshlib.explorer import Explorer, atlas, scripts
from meshlib.explorer.scene import GRID
from meshlib.thesis import explorers

ANYWIDGET = pytest.importorskip("anywidget")
VIEW_MIME = "application/vnd.jupyter.widget-view+json"
PNG_HEAD = b"\x89PNG\r\n"
KINDS = {"f8": "<f8", "f4": "<f4", "u1": "<u1", "u2": "<u2", "u4": "<u4"}


class Reader:
    """Reads an atlas as a browser does."""

    def __init__(self, data):
        start = 4 + int.from_bytes(data[:4], "little")
        self.header, self.data, self.start = json.loads(data[4:start]), data, start

    def __getitem__(self, name):
        kind, offset, size = self.header["arrays"][name]
        return np.frombuffer(self.data, KINDS[kind], size, self.start + offset)

    def members(self, mesh):
        """Numbers of the elements of a mesh."""
        steps = self["members"][slice(*self["meshes"][mesh : mesh + 2])].astype(int)
        return np.where(steps % 2, -(steps + 1) // 2, steps // 2).cumsum()

    def elements(self, mesh):
        """Sorted triples of node coordinates."""
        corners = self["elements"].reshape(-1, 3)[self.members(mesh)]
        places = np.column_stack([self["x"], self["y"]])[corners]
        return sorted(sorted(map(tuple, element)) for element in places.round(9).tolist())

    def films(self, scene):
        """Elements of the start mesh and of each mesh of the film."""
        first, last = self["films"][scene : scene + 2]
        return [self.elements(mesh) for mesh in (self["start"][scene], *self["film"][first:last])]


def elements_of(mesh):
    return sorted(sorted(map(tuple, element)) for element in mesh.corners.round(9).tolist())


# -- scenes -------------------------------------------------------------------------------


def swapping(function, nodes, criterion="jnd", norm=2, **options):
    options.setdefault("order", problems.order(nodes))
    return swapped(problems.mesh(nodes), problems.functions[function], criterion, norm=norm, **options).mesh


def rounds(mesh, u, count, *rule):
    for _ in range(count):
        mesh = refined(mesh, u, rule[0], fraction=rule[1], mark=rule[2], split=rule[3]).mesh
    return mesh


SR1, SR3, FRANKE = (problems.functions[name] for name in ("SR1", "SR3", "franke"))
CASES = {
    "swaps": (
        {"function": "DD1", "nodes": "81", "criterion": "dlp", "norm": "max"},
        lambda: swapping("DD1", "81", "dlp", "max"),
    ),
    "refinement": (
        {"percentage": 10, "mark": "element", "split": "red-green"},
        lambda: rounds(problems.mesh("33"), SR1, 3, "abn", 0.1, "element", "red-green"),
    ),
    "limits": ({"criterion": "jnd", "min_angle": 12}, lambda: swapping("SR3", "81", min_angle=12)),
    "orders": (
        {"order": 7},
        lambda: swapping("DD1", "33-refined", "abn", order=np.random.default_rng(7).permutation(344)),
    ),
    "movement": (
        {"function": "SR1"},
        lambda: smoothed(problems.mesh("33"), max_sweeps=explorers.MOST_SWEEPS).mesh,
    ),
    "approximation": ({"nodes": 20}, lambda: approximate(FRANKE, nodes=20).mesh),
}


@pytest.mark.parametrize("name", explorers.ALL)
def test_scenes_are_what_library_calls_give(name):
    settings, by_hand = CASES[name]
    exploration = explorers.ALL[name]
    scene, mesh = exploration.computed(exploration.checked(settings)), by_hand()
    assert elements_of(scene.film[-1]) == elements_of(mesh)
    assert scene.after.l2_error == pytest.approx(
        Interpolant(mesh, scene.function).l2_error(scene.function, rule="trapezium"), rel=1e-9
    )
    assert scene.after.quality.mean == pytest.approx(quality(mesh).mean)


def test_refinement_that_marks_nothing_leaves_the_start_mesh():
    scene = Explorer(explorers.REFINEMENT, percentage=0).scene
    assert scene.film == (scene.start,) and scene.frames == 2


def test_rows_name_every_number_once_before_and_after():
    rows = {label: numbers for label, *numbers in Explorer(explorers.SWAPS).scene.rows}
    assert rows["Nodes"] == ["33", "33"] and rows["Edges"] == ["88", "88"]
    assert rows["Swaps"] == ["0", "17"] and rows["L2 error"] == ["0.0216", "0.0170"]
    assert len(rows) == 12


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"function": "SR9"}, "function 'SR9' is not known; did you mean 'SR"),
        ({"nodes": "34"}, "nodes '34' is not known"),
        ({"criterion": "jmd"}, "criterion 'jmd' is not known; did you mean 'jnd'"),
        ({"norm": 3}, "norm 3 is not known"),
        ({"functions": "SR1"}, "setting 'functions' is not known; did you mean 'function'"),
    ],
)
def test_wrong_settings_name_the_remedy(wrong, message):
    with pytest.raises(MeshError, match=re.escape(message)):
        Explorer(explorers.SWAPS, **wrong)


# -- atlases ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pages():
    """The atlases of two explorations, small enough for a test."""
    return {name: Reader(atlas.pages(explorers.ALL[name])) for name in ("swaps", "movement")}


@pytest.mark.parametrize("name", ["swaps", "movement"])
def test_an_atlas_holds_the_scene_of_every_setting(pages, name):
    exploration, page = explorers.ALL[name], pages[name]
    settings = exploration.pages()
    assert len(page["index"]) == len(settings)
    for k in range(0, len(settings), 17):
        scene, number = exploration.computed(settings[k]), page["index"][k]
        assert page.header["scenes"][number]["title"] == scene.title
        assert page.films(number) == [elements_of(mesh) for mesh in (scene.start, *scene.film)]
        assert page["swaps"][number] == scene.swaps


def test_an_atlas_has_values_and_the_grid_of_the_function(pages):
    page = pages["movement"]
    k = next(k for k, caption in enumerate(page.header["scenes"]) if caption["title"].startswith("SR3 on 33"))
    grid = page["grids"].reshape(-1, GRID, GRID)[page["truth"][k]]
    x = np.linspace(0, 1, GRID)
    assert np.abs(grid - SR3(x[None, :], x[:, None])).max() < 1e-6
    nodes = np.unique(page["elements"].reshape(-1, 3)[page.members(page["start"][k])])
    assert np.abs(page["u"][nodes] - SR3(page["x"][nodes], page["y"][nodes])).max() < 1e-11


def test_a_trace_leads_from_the_start_to_the_adapted_mesh(pages):
    page = pages["swaps"]
    k = page["index"][5]
    tried = slice(*page["traces"][k : k + 2])
    pairs = {
        name: np.column_stack([page[first][tried], page[second][tried]])
        for name, first, second in (("old", "a", "b"), ("new", "c", "d"))
    }
    edges = set(map(frozenset, problems.mesh("33").edges.tolist()))
    number = {(x, y): n for n, (x, y) in enumerate(problems.nodes("33").tolist())}
    name = [number.get((x, y)) for x, y in zip(page["x"].tolist(), page["y"].tolist(), strict=True)]
    for old, new, accepted in zip(pairs["old"], pairs["new"], page["accepted"][tried], strict=True):
        if accepted:
            edges.remove(frozenset(name[n] for n in old))
            edges.add(frozenset(name[n] for n in new))
    found = explorers.SWAPS.computed(explorers.SWAPS.pages()[5]).film[-1]
    assert edges == set(map(frozenset, found.edges.tolist()))


def test_settings_without_effect_share_a_scene():
    exploration = explorers.REFINEMENT
    titles = {
        exploration.computed(exploration.checked({"percentage": 0, "mark": mark})).title
        for mark in ("edge", "density")
    }
    assert titles == {"SR1 on 33 nodes"}


# -- controls and view --------------------------------------------------------------------


@pytest.mark.parametrize(
    "name, value", [("function", "SR3"), ("nodes", "81"), ("criterion", "dfp"), ("norm", "lexicographic")]
)
def test_view_follows_each_control(name, value):
    explorer = Explorer(explorers.SWAPS)
    before = explorer.view.atlas
    explorer.controls[name].value = value
    assert explorer.view.atlas != before
    page = Reader(explorer.view.atlas)
    assert page.films(0)[1] == elements_of(explorer.scene.film[0])
    assert page.header["scenes"][0]["title"] == explorer.scene.title


def test_every_control_has_a_label_and_the_initial_value():
    for exploration in explorers.ALL.values():
        explorer = Explorer(exploration)
        assert list(explorer.controls) == list(exploration.initial)
        for name, control in explorer.controls.items():
            assert control.description and control.value == exploration.initial[name]


def test_initial_values_are_on_the_page():
    for exploration in explorers.ALL.values():
        for control in exploration.controls:
            assert exploration.initial[control.name] in control.paged
            assert set(control.paged) <= set(control.options)


def test_an_adapted_mesh_stays_one_and_another_frame_stays():
    explorer = Explorer(explorers.SWAPS)
    assert explorer.view.frame == explorer.scene.frames - 1
    explorer.controls["nodes"].value = "81"
    assert explorer.view.frame == explorer.scene.frames - 1
    explorer.frames.value = 12
    explorer.controls["norm"].value = 1
    assert explorer.view.frame == 12


def test_colours_of_the_view_are_matplotlibs():
    matplotlib = pytest.importorskip("matplotlib")
    for name in ("viridis", "cividis"):
        listed = re.search(rf"const {name.upper()} = \[(.*?)\]", scripts.module(), re.DOTALL)[1]
        stops = re.findall(r"#\w{6}", listed)
        table = matplotlib.colormaps[name](np.arange(len(stops)) / 10)
        assert stops == [matplotlib.colors.to_hex(colour) for colour in table]


def test_python_and_scripts_measure_errors_on_the_same_grid():
    assert f"const GRID = {GRID};" in scripts.module()


# -- on a page ----------------------------------------------------------------------------


def test_bundle_has_the_live_view_a_picture_and_a_line():
    pytest.importorskip("matplotlib")
    bundle = explorers.swaps()._repr_mimebundle_()
    assert VIEW_MIME in bundle
    assert bundle["text/plain"] == ("Explorer(SR1 on 33 nodes, JND-L2: 88 edges, 17 swaps, L2 error 0.0170)")
    assert base64.b64decode(bundle["image/png"]).startswith(PNG_HEAD)


def test_picture_leaves_no_figure_open():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    before = pyplot.get_fignums()
    explorers.swaps()._repr_mimebundle_()
    assert pyplot.get_fignums() == before
