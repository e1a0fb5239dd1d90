"""ES modules become one script: what is understood, and what is refused by file and line."""

import json
import re
from pathlib import Path

import pytest

from meshlib.explorer import scripts
from meshlib.explorer.joining import NAME, Module, ScriptError, constant, joined

ROOT = Path(__file__).parents[1]
FILES = sorted((scripts.HERE / "js").glob("*.js"))


@pytest.fixture
def write(tmp_path):
    """Writes modules into a folder and returns the first of them."""

    def written(**sources):
        for name, source in sources.items():
            (tmp_path / f"{name}.js").write_text(source, encoding="utf-8")
        return tmp_path / f"{next(iter(sources))}.js"

    return written


def test_a_module_stands_behind_those_that_it_imports_from(write):
    entry = write(
        entry='import { area, side } from "./shape.js";\nexport const twice = 2 * area(side);\n',
        shape="const unit = 1;\nexport const side = 3 * unit;\nexport function area(a) { return a * a; }\n",
    )
    assert joined(entry) == (
        "const $shape = (() => {\n"
        "const unit = 1;\nconst side = 3 * unit;\nfunction area(a) { return a * a; }\n"
        "return { side, area };\n})();\n\n"
        "const $entry = (() => {\n"
        "const { area, side } = $shape;\nconst twice = 2 * area(side);\n"
        "return { twice };\n})();\n"
    )


def test_a_module_that_two_others_import_is_there_once(write):
    entry = write(
        entry='import { a } from "./first.js";\nimport { b } from "./second.js";\n',
        first='import { c } from "./base.js";\nexport const a = c;\n',
        second='import { c } from "./base.js";\nexport const b = c;\n',
        base="export const c = 1;\n",
    )
    assert re.findall(r"^const (\S+) = \(\(\)", joined(entry), re.MULTILINE) == [
        "$base",
        "$first",
        "$second",
        "$entry",
    ]


def test_names_may_stand_on_lines_of_their_own(write):
    entry = write(
        entry='import {\n  a,\n  b,\n} from "./base.js";\n',
        base="export class a {}\nexport async function b() {}\n",
    )
    assert "const {\n  a,\n  b,\n} = $base;\n" in joined(entry)


@pytest.mark.parametrize(
    "statement",
    [
        'import a from "./base.js";',
        'import * as base from "./base.js";',
        'import "./base.js";',
        'import { a } from "base";',
        'import { a } from "../base.js";',
        '  import { a } from "./base.js";',
        'const base = await import("./base.js");',
        "const here = import.meta.url;",
        "export default 1;",
        "export { a };",
        'export { a } from "./base.js";',
        'export * from "./base.js";',
        "export let a = 1;",
        "export const [a, b] = [1, 2];",
        "export const { a } = { a: 1 };",
    ],
)
def test_other_statements_are_refused(write, statement):
    entry = write(entry=f"// A comment.\n{statement}\n", base="export const a = 1;\n")
    with pytest.raises(ScriptError) as raised:
        joined(entry)
    shown = statement[statement.index("import") :] if "const" in statement[:6] else statement.strip()
    assert str(raised.value) == f"entry.js:2: this is not understood: {shown}"


def test_every_fault_of_every_module_is_told(write):
    entry = write(
        entry='import { a, b as c } from "./base.js";\n\nimport { d, e } from "./base.js";\n',
        base="export const a = 1, d = 2;\nexport default a;\n",
    )
    with pytest.raises(ScriptError) as raised:
        joined(entry)
    assert str(raised.value).splitlines() == [
        "base.js:2: this is not understood: export default a;",
        "entry.js:1: this is not the name of an export: b as c",
        "entry.js:3: base.js does not export d",
        "entry.js:3: base.js does not export e",
    ]


def test_a_missing_file_is_told(write):
    with pytest.raises(ScriptError, match=r"^entry\.js:2: there is no bass\.js to import from$"):
        joined(write(entry='\nimport { a } from "./bass.js";\n'))


def test_a_circle_is_told_with_all_its_files(write):
    entry = write(
        entry='import { a } from "./first.js";\n',
        first='\nimport { b } from "./second.js";\nexport const a = b;\n',
        second='import { a } from "./first.js";\nexport const b = a;\n',
    )
    with pytest.raises(ScriptError) as raised:
        joined(entry)
    assert str(raised.value) == (
        "second.js:1: imports in a circle: entry.js -> first.js -> second.js -> first.js"
    )


# -- the scripts of the explorer -------------------------------------------------------------------


def test_every_script_is_in_the_widget_or_on_a_page():
    texts = scripts.module(), scripts.classic()
    constants = {constant(file) for file in FILES}
    assert constants == set(re.findall(r"^const (\$\w+) = \(\(\)", "".join(texts), re.MULTILINE))


def test_every_export_is_used():
    modules = list(map(Module, FILES))
    used = {(place[2], name) for m in modules for place in m.imports for name in NAME.findall(place[1])}
    entries = {(file.name, name) for file in (scripts.WIDGET, scripts.PAGE) for name in Module(file).exports}
    assert {(m.path.name, name) for m in modules for name in m.exports} - entries == used


def test_the_widget_has_its_hook_as_default_export():
    assert scripts.module().endswith("return { render };\n})();\nexport default $widget;\n")


# -- the tools that check them -----------------------------------------------------------------------


def test_the_lock_file_of_the_tools_names_no_host_and_every_hash():
    packages = json.loads((ROOT / "package-lock.json").read_text())["packages"]
    installed = {name: package for name, package in packages.items() if name}
    assert not [name for name, package in installed.items() if "resolved" in package]
    assert not [name for name, package in installed.items() if "integrity" not in package]


def test_the_tools_are_pinned():
    wanted = json.loads((ROOT / "package.json").read_text())["devDependencies"]
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in wanted.values())
