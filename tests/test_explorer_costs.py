"""Explorers of user-defined criteria: in menus once registered, and with their costs in the atlas."""

import re
from dataclasses import replace

import numpy as np
import pytest
from test_explorer import Reader, elements_of
from user_criteria import NAMES, kink, registered

from meshlib import criteria, problems
from meshlib.criteria import Criterion, min_error
from meshlib.explorer import Explorer, atlas, scripts
from meshlib.explorer.cost_changes import has_formula
from meshlib.thesis import explorers

NORMS = (1, 2, "max", "lexicographic")
EVERY = (*NAMES, "gradient-spread")
EXTRA = {"changes", "stage", "p", "q", "r", "cost", "tries", "old", "new"}
CORNERS = {"edge": 2, "element": 3, "node": 1}
PAGES = {
    "swaps": 192,
    "refinement": 2016,
    "limits": 1488,
    "orders": 1008,
    "movement": 16,
    "approximation": 33,
}


@pytest.fixture(autouse=True, scope="module")
def user_defined():
    """Criteria of every kind, registered long after the explorers were imported."""
    with registered():
        yield


@pytest.fixture
def swaps():
    """Scenes of single swaps, by criterion and norm."""

    def scene(criterion, norm=2):
        return explorers.SWAPS.computed(explorers.SWAPS.initial | {"criterion": criterion, "norm": norm})

    return scene


def read(scene):
    return Reader(atlas.packed(explorers.SWAPS, [scene]))


def costs_told(page, scene):
    """The costs in an atlas of each mesh of a scene, by the places of nodes."""
    places = list(zip(page["x"].tolist(), page["y"].tolist(), strict=True))
    known = [{} for _ in scene.meshes]
    for stage, *part, cost in zip(
        *(page[name].tolist() for name in ("stage", "p", "q", "r", "cost")), strict=True
    ):
        for mesh in known[stage:]:
            mesh[frozenset(places[n] for n in part)] = cost
    return known


def costs_by_hand(scene, mesh):
    """The same from the library."""
    criterion = criteria.get(scene.cost)
    rows = {"edge": mesh.edges, "element": mesh.elements, "node": np.arange(mesh.n_nodes)[:, None]}[
        criterion.on
    ]
    parts = (frozenset(map(tuple, corners)) for corners in mesh.nodes[rows].tolist())
    return dict(zip(parts, criterion.costs(mesh, scene.function).tolist(), strict=True))


# -- costs in the atlas -------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EVERY)
def test_an_atlas_has_the_costs_of_every_mesh_of_a_trace(swaps, name):
    scene = swaps(name)
    found, meshes = costs_told(read(scene), scene), scene.meshes
    assert len(meshes) == scene.swaps + 1
    for told, mesh in zip(found, meshes, strict=True):
        by_hand = costs_by_hand(scene, mesh)
        assert {part: told.get(part, 0.0) for part in by_hand} == by_hand


@pytest.mark.parametrize("name", NAMES)
def test_an_atlas_has_the_costs_of_every_mesh_of_a_film(name):
    settings = explorers.REFINEMENT.checked({"refine_by": name})
    scene = explorers.REFINEMENT.computed(settings)
    found = costs_told(Reader(atlas.packed(explorers.REFINEMENT, [scene])), scene)
    assert len(found) == explorers.PASSES + 1
    for told, mesh in zip(found, (scene.start, *scene.film), strict=True):
        by_hand = costs_by_hand(scene, mesh)
        assert {part: told.get(part, 0.0) for part in by_hand} == by_hand


@pytest.mark.parametrize("norm", NORMS)
@pytest.mark.parametrize("name", EVERY)
def test_an_atlas_has_the_local_costs_that_the_norm_compared(swaps, name, norm):
    scene = swaps(name, norm)
    page = read(scene)
    assert page["old"].tolist() == scene.trace["old"].tolist()
    assert page["new"].tolist() == scene.trace["new"].tolist()
    assert len(page["old"]) == scene.frames - 1 > 0
    assert page.header["scenes"][0] == {
        "title": scene.title, "cost": name, "on": criteria.get(name).on, "norm": str(norm), "given": True
    }  # fmt: skip


@pytest.mark.parametrize("name", [name for name in criteria.names() if name not in EVERY])
def test_built_in_criteria_need_no_costs_in_the_atlas(swaps, name):
    page = read(swaps(name))
    assert not EXTRA & set(page.header["arrays"])
    assert set(page.header["scenes"][0]) == {"title", "cost", "on", "norm"}


def test_scenes_of_both_kinds_share_an_atlas(swaps):
    scenes = [swaps("jnd"), swaps("kink"), swaps("valence", 1), swaps("abn")]
    page = Reader(atlas.packed(explorers.SWAPS, scenes))
    rows, tries = np.diff(page["changes"]), np.diff(page["tries"])
    assert (rows > 0).tolist() == [False, True, True, False]
    assert tries.tolist() == [0, len(scenes[1].trace), len(scenes[2].trace), 0]
    alone = read(scenes[2])
    assert page["cost"][page["changes"][2] : page["changes"][3]].tolist() == alone["cost"].tolist()


def test_only_costs_that_change_are_listed(swaps):
    scene = swaps("kink")
    counts = np.bincount(read(scene)["stage"])
    assert counts[0] <= scene.start.n_edges - scene.start.boundary.sum()
    assert counts[1:].max() <= 5  # edges of a quadrilateral


def test_the_meshes_of_a_trace_lead_to_the_swapped_mesh(swaps):
    scene = swaps("kink")
    assert elements_of(scene.meshes[-1]) == elements_of(scene.film[-1])
    for before, after in zip(scene.meshes[:-1], scene.meshes[1:], strict=True):
        assert len(set(map(tuple, before.edges.tolist())) - set(map(tuple, after.edges.tolist()))) == 1
        assert after.validate() is not None


def test_scripts_have_a_formula_where_python_says_so():
    script = (scripts.HERE / "js" / "costs.js").read_text(encoding="utf-8")
    tables = re.findall(r"^const (?:EDGE|ELEMENT)_COSTS = \{(.*?)^\};", script, re.MULTILINE | re.DOTALL)
    names = re.findall(r'^  "?([\w-]+)"?[:(]', "".join(tables), re.MULTILINE)
    assert names == [name for name in criteria.names() if has_formula(criteria.get(name))]


def test_a_user_defined_criterion_may_have_the_name_of_a_built_in_one(swaps):
    mine = Criterion("jnd", "edge", kink)
    scene = replace(swaps("kink"), cost=mine)
    assert costs_told(read(scene), scene)[0] == costs_told(read(swaps("kink")), scene)[0]


# -- menus -------------------------------------------------------------------------------------------


def options(exploration, name):
    (control,) = (control for control in exploration.controls if control.name == name)
    return control.options


@pytest.mark.parametrize("exploration, menu", [
    (explorers.SWAPS, "criterion"), (explorers.REFINEMENT, "swap"), (explorers.REFINEMENT, "refine_by"),
    (explorers.LIMITS, "criterion"), (explorers.ORDERS, "criterion"),
])  # fmt: skip
def test_a_criterion_is_in_every_menu_while_it_is_registered(exploration, menu):
    before = options(exploration, menu)
    with registered(Criterion("late", "edge", kink, "late criterion")):
        assert options(exploration, menu) == (*before, "late")
        assert Explorer(exploration, **{menu: "late"}).controls[menu].value == "late"
    assert options(exploration, menu) == before
    assert set(EVERY) < set(before)


def test_menus_have_names_in_capitals_in_front_of_titles():
    control = Explorer(explorers.SWAPS).controls["criterion"]
    texts = {value: text for text, value in control.options}
    assert texts["jnd"] == "JND: jump in normal derivatives"
    assert texts["kink"] == "KINK: jump along x"
    assert texts["slope"] == "slope"


@pytest.mark.parametrize("name", NAMES)
def test_an_explorer_follows_to_a_user_defined_criterion(name):
    explorer = Explorer(explorers.SWAPS)
    explorer.controls["criterion"].value = name
    assert explorer.scene.title == f"SR1 on 33 nodes, {name.upper()}-L2"
    assert Reader(explorer.view.atlas).header["scenes"][0]["given"]


def test_the_error_of_a_known_function_can_be_registered():
    with registered(min_error(problems.SR1)):
        explorer = Explorer(explorers.SWAPS, criterion="min-error")
    assert explorer.scene.after.l2_error < 0.02 < explorer.scene.before.l2_error
    assert Reader(explorer.view.atlas).header["scenes"][0]["on"] == "element"


# -- pages -------------------------------------------------------------------------------------------


def test_pages_have_the_settings_of_built_in_criteria():
    """Criteria of edges and elements join the pages of two explorers if they are registered."""
    found = {name: len(exploration.pages()) for name, exploration in explorers.ALL.items()}
    joined = sum(criteria.get(name).on != "node" for name in NAMES)
    assert found == PAGES | {"swaps": 192 // 6 * (6 + joined), "limits": 1488 // 6 * (6 + joined)}


def test_names_that_differ_in_capitals_have_scenes_of_their_own():
    names = ("kink", "Kink")
    controls = [replace(c, given_on_page=[explorers.SWAPS.initial[c.name]]) for c in explorers.SWAPS.controls]
    controls[2] = replace(controls[2], given_on_page=names)
    with registered(Criterion("Kink", "edge", kink)):
        page = Reader(atlas.pages(replace(explorers.SWAPS, controls=tuple(controls))))
    assert [scene["cost"] for scene in page.header["scenes"]] == ["kink", "Kink"]
    assert page["index"].tolist() == [0, 1]
