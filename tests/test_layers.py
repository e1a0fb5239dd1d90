"""The layers of the package: imports lead downwards only, and CONTRIBUTING names every module."""

import ast
import importlib
import re
import types
from functools import cache
from pathlib import Path

import pytest

import meshlib

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "meshlib"
TOP = ("meshlib",)
ENTRY_POINTS = ("__main__",)  # they may use everything


def module_of(path):
    """Dotted name of a file, that of the package for its __init__."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" else parts


@cache
def modules():
    """Syntax tree of each module, by its name as a tuple."""
    return {module_of(path): ast.parse(path.read_text()) for path in sorted(PACKAGE.rglob("*.py"))}


def is_package(name):
    """Whether a module is the __init__ of a folder."""
    return (ROOT.joinpath(*name) / "__init__.py").exists()


def target_of(name, node):
    """Dotted name from which a statement imports, as a tuple."""
    base = name if is_package(name) else name[:-1]
    base = base[: len(base) + 1 - node.level] if node.level else ()
    return base + tuple(node.module.split(".") if node.module else ())


@cache
def imports():
    """Pairs of modules, the importing one first; imports inside functions count."""
    found = set()
    for name, tree in modules().items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                target = target_of(name, node)
                for alias in node.names:
                    inner = (*target, alias.name)
                    found.add((name, inner if inner in modules() else target))
            elif isinstance(node, ast.Import):
                found |= {(name, tuple(alias.name.split("."))) for alias in node.names}
    return {(a, b) for a, b in found if b in modules() and a != b}


@cache
def layers():
    """Layer of each room of the table in CONTRIBUTING.md, by its name."""
    found = {}
    for line in (ROOT / "CONTRIBUTING.md").read_text().splitlines():
        row = re.match(r"\| (\d+) \| ([^|]*)\|", line)
        for name in re.findall(r"`([\w./]+)`", row[2]) if row else ():
            found[name.rstrip("/")] = int(row[1])
    return found


def room_of(name):
    """Entry of the table under which a module stands: its file or folder at the top, in thesis one deeper."""
    deep = 3 if name[1:2] == ("thesis",) else 2
    return "/".join(name[1:deep]) or "meshlib"


def has_room(name):
    """Whether a module stands in the table: not the packages that only hold others, nor entry points."""
    return room_of(name) not in ("meshlib", "thesis") and name[-1] not in ENTRY_POINTS


def test_every_module_has_a_room_and_every_room_is_there():
    rooms = {room_of(name) for name in modules() if has_room(name)}
    assert rooms == {name for name in layers() if name not in ("notebooks", "benchmarks", "book")}


def test_imports_lead_downwards():
    upward = {
        (".".join(a), ".".join(b))
        for a, b in imports()
        if room_of(a) != room_of(b)
        and has_room(a)
        and has_room(b)
        and layers()[room_of(a)] <= layers()[room_of(b)]
    }
    assert upward == set()


def test_the_package_itself_is_imported_only_by_the_thesis():
    assert {room_of(a).partition("/")[0] for a, b in imports() if b == TOP} <= {"thesis"}


def circles(pairs):
    """Names that are left when those that import nothing are taken away again and again."""
    left = {name for pair in pairs for name in pair}
    while True:
        ends = {name for name in left if not any(a == name and b in left for a, b in pairs)}
        if not ends:
            return left
        left -= ends


def test_no_circle_of_modules():
    below = {(a, b) for a, b in imports() if b != TOP}
    assert circles({(a, b) for a, b in below if a[: len(b)] != b or not is_package(b)}) == set()


def test_no_circle_of_folders():
    between = {(room_of(a), room_of(b)) for a, b in imports() if room_of(a) != room_of(b)}
    assert (
        circles({(a, b) for a, b in between if "meshlib" not in (a, b) and "thesis" not in (a, b)}) == set()
    )


def test_a_circle_and_an_upward_arrow_would_be_found():
    assert circles({("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")}) == {"a", "b", "c", "d"}
    assert circles({("a", "b"), ("b", "c")}) == set()


@pytest.mark.parametrize("name", sorted(".".join(n) for n in modules() if is_package(n)))
def test_no_name_hides_a_module(name):
    package = importlib.import_module(name)
    for path in ROOT.joinpath(*name.split(".")).glob("*.py"):
        if path.stem not in ("__init__", "__main__"):
            importlib.import_module(f"{name}.{path.stem}")
            assert isinstance(getattr(package, path.stem), types.ModuleType), f"{name}.{path.stem}"


def test_a_file_at_the_top_is_public_or_says_that_it_is_not():
    """`errors` is public by its classes; `checks` belongs to no package since all of them use it."""
    files = {path.stem for path in PACKAGE.glob("*.py")}
    assert {name for name in files if not name.startswith("_")} - set(meshlib.__all__) == {"checks", "errors"}
    kinds = {name for name in vars(meshlib.errors) if name.endswith("Error") or name == "Interrupted"}
    assert kinds <= set(meshlib.__all__)


def test_the_top_of_the_package_is_small():
    entries = [
        path.name for path in PACKAGE.iterdir() if not path.name.startswith("_") and path.name != "data"
    ]
    assert len(entries) <= 22
