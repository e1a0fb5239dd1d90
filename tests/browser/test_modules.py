"""The scripts of the explorer in a browser: as ES modules one by one, and joined."""

import pytest
from test_joining import FILES
from visiting import served

from meshlib.explorer import scripts
from meshlib.explorer.joining import Module, constant, joined


@pytest.fixture(scope="module")
def page(chromium):
    """A page, with the folder of the modules on a server."""
    with served(scripts.HERE / "js") as address, chromium.new_page() as opened:
        opened.goto(f"{address}/types.d.ts")
        yield opened


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_a_browser_loads_each_module_and_finds_its_exports(page, file):
    found = page.evaluate("async (name) => Object.keys(await import(`./${name}`))", file.name)
    assert found == sorted(Module(file).exports)


@pytest.mark.parametrize("entry", [scripts.WIDGET, scripts.PAGE], ids=lambda file: file.name)
def test_the_joined_modules_have_the_same_exports(page, entry):
    found = page.evaluate(f"() => {{ {joined(entry)}; return Object.keys({constant(entry)}); }}")
    assert sorted(found) == sorted(Module(entry).exports)


def test_the_widget_is_a_module_with_one_hook(page):
    hooks = page.evaluate(
        """async (text) => {
            const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
            return Object.keys((await import(address)).default); }""",
        scripts.module(),
    )
    assert hooks == ["render"]


def test_the_script_of_a_page_runs_and_waits_for_atlases(page):
    page.evaluate(scripts.classic())
    assert page.evaluate("typeof window.meshExplorers.push") == "function"
    assert page.evaluate("typeof $view") == "undefined"  # nothing else is left on the page


def test_modules_may_have_equal_names_of_their_own(page, tmp_path):
    (tmp_path / "base.js").write_text("const size = 2;\nexport const twice = (x) => size * x;\n")
    (tmp_path / "entry.js").write_text(
        'import { twice } from "./base.js";\nconst size = 3;\nexport const six = twice(size);\n'
    )
    assert page.evaluate(f"() => {{ {joined(tmp_path / 'entry.js')}; return $entry.six; }}") == 6
