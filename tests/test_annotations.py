"""Every signature that users see has types, and an installed package tells type checkers so."""

import importlib
import inspect
import tomllib
from functools import cached_property
from pathlib import Path
from types import FunctionType, ModuleType

import meshlib

MODULES = "criteria", "problems", "curves", "io", "plotting", "explorer"
CALLS = "__init__", "__call__"  # the special methods whose arguments users give
ROOT = Path(__file__).parents[1]


def public(module):
    """Names and values that a module offers: its __all__, or what it defines without an underscore."""
    own = (n for n, v in vars(module).items() if getattr(v, "__module__", None) == module.__name__)
    names = getattr(module, "__all__", None) or [n for n in own if not n.startswith("_")]
    return {f"{module.__name__}.{name}": getattr(module, name) for name in names}


def offered():
    """All public functions and classes of the package, those of its modules included."""
    found = public(meshlib)
    for name in MODULES:
        found |= public(importlib.import_module(f"meshlib.{name}"))
    return {name: value for name, value in found.items() if not isinstance(value, ModuleType)}


def function_of(member):
    """The function behind a method or a property, or None."""
    if isinstance(member, property):
        return member.fget
    if isinstance(member, cached_property):
        return member.func
    member = inspect.unwrap(getattr(member, "__func__", member))  # of class methods and decorated functions
    return member if isinstance(member, FunctionType) else None


def functions(name, value):
    """(name, function) of a function, or of all that a class of the package lets users call and read."""
    if not inspect.isclass(value):
        return [(name, function_of(value))]
    bases = [base for base in value.__mro__ if base.__module__.startswith("meshlib")]
    members = {n: m for base in reversed(bases) for n, m in vars(base).items()}
    return [
        (f"{name}.{n}", function_of(m)) for n, m in members.items() if not n.startswith("_") or n in CALLS
    ]


def missing(function):
    """Parameters of a function that have no type, and "return" if what it returns has none."""
    parameters = [p for p in inspect.signature(function).parameters if p not in ("self", "cls")]
    return [name for name in [*parameters, "return"] if name not in function.__annotations__]


def untyped():
    """One line for each public function without all of its types."""
    found = [pair for name, value in offered().items() for pair in functions(name, value) if pair[1]]
    lines = [f"{name}: {', '.join(missing(function))}" for name, function in found if missing(function)]
    return sorted(lines)


def test_every_public_signature_has_types():
    assert not untyped(), "without types:\n" + "\n".join(untyped())


def test_what_is_walked_includes_functions_methods_and_properties():
    names = {pair[0] for name, value in offered().items() for pair in functions(name, value) if pair[1]}
    assert {
        "meshlib.swapped",
        "meshlib.Mesh.validate",
        "meshlib.Mesh.from_arrays",
        "meshlib.Mesh.edges",
    } <= names
    assert {"meshlib.io.read", "meshlib.curves.domain_mesh", "meshlib.MeshError.__init__"} <= names


def test_a_signature_without_types_is_noticed():
    class Half:
        def method(self, x: int, y, *rest, z=1) -> None: ...

        @property
        def value(self): ...

        @cached_property
        def other(self) -> int: ...

        def _private(self, x): ...

    Half.__module__ = "meshlib.half"
    assert [(n, missing(f)) for n, f in functions("Half", Half)] == [
        ("Half.method", ["y", "rest", "z"]),
        ("Half.value", ["return"]),
        ("Half.other", []),
    ]


def test_type_checkers_find_the_types_of_the_installed_package():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    assert (ROOT / "meshlib" / "py.typed").exists()
    assert "py.typed" in settings["tool"]["setuptools"]["package-data"]["*"]
