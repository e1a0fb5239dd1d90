"""ES modules joined into one script, for a browser that may load only one.

Each module becomes a function, so that its names stay its own, and stands behind those
that it imports from::

    const $mesh = (() => {              const $costs = (() => {
    ...                                 const { gradient } = $mesh;
    return { gradient };                ...
    })();                               return { edgeCost };
                                        })();

Two statements are understood, each at the start of a line: ``import { name, ... } from
"./file.js";``, and ``export`` in front of a function, a class or a constant.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

IMPORT = re.compile(r'^import \{([^{}]*)\} from "\./([\w-]+\.js)";$', re.MULTILINE)
EXPORT = re.compile(r"^export (?=(?:(?:async )?function|class|const) ([A-Za-z_$][\w$]*)\b)", re.MULTILINE)
OTHER = re.compile(r"^[ \t]*(?:import|export)\b.*|\bimport *[(.].*", re.MULTILINE)
NAME = re.compile(r"[A-Za-z_$][\w$]*")


class ScriptError(ValueError):
    """Modules that cannot be joined; the message has a line for each fault, with its file and line."""


def joined(entry: Path) -> str:
    """A module and all that it imports, directly or through others, as one script.

    Parameters
    ----------
    entry : Path

    Returns
    -------
    str
        Defines a constant for each module, `constant` of its file, with its exports.

    Raises
    ------
    ScriptError
        If a statement is not understood, modules import each other in a circle, or a
        file or export that is imported does not exist.
    """
    modules: dict[str, Module] = {}
    _collect(Module(Path(entry)), modules, ())
    faults = [fault for module in modules.values() for fault in module.faults(modules)]
    if faults:
        raise ScriptError("\n".join(faults))
    return "\n".join(module.as_function() for module in modules.values())


def constant(file: Path | str) -> str:
    """Name of the constant with the exports of a module: ``"$view"`` for ``view.js``."""
    return "$" + Path(file).stem.replace("-", "_")


def _collect(module: "Module", modules: dict[str, "Module"], importing: tuple[str, ...]) -> None:
    """Add a module to those by file name, after all that it imports."""
    for place in module.imports:
        file = module.path.with_name(place[2])
        if file.name in (*importing, module.path.name):
            circle = (*importing, module.path.name, file.name)
            raise ScriptError(module.at(place.start()) + "imports in a circle: " + " -> ".join(circle))
        if not file.exists():
            raise ScriptError(f"{module.at(place.start())}there is no {file.name} to import from")
        if file.name not in modules:
            _collect(Module(file), modules, (*importing, module.path.name))
    modules[module.path.name] = module


@dataclass(frozen=True)
class Module:
    """A file, what it imports, and what it exports."""

    path: Path

    @cached_property
    def text(self) -> str:
        """The source."""
        return self.path.read_text(encoding="utf-8")

    @cached_property
    def imports(self) -> list[re.Match[str]]:
        """Matches of the imports: names in group 1, the file in group 2."""
        return list(IMPORT.finditer(self.text))

    @cached_property
    def exports(self) -> list[str]:
        """Names of the exports."""
        return EXPORT.findall(self.text)

    def at(self, position: int) -> str:
        """File and line of a position in the text, as the start of a message."""
        line = 1 + self.text[:position].count("\n")
        return f"{self.path.name}:{line}: "

    def faults(self, modules: dict[str, "Module"]) -> Iterator[str]:
        """What keeps the module from being joined with these others, as messages."""
        known = {place.start() for pattern in (IMPORT, EXPORT) for place in pattern.finditer(self.text)}
        for place in OTHER.finditer(self.text):
            if place.start() not in known:
                yield f"{self.at(place.start())}this is not understood: {place[0].strip()}"
        for place in self.imports:
            for name in _names(place):
                if not NAME.fullmatch(name):
                    yield f"{self.at(place.start())}this is not the name of an export: {name}"
                elif name not in modules[place[2]].exports:
                    yield f"{self.at(place.start())}{place[2]} does not export {name}"

    def as_function(self) -> str:
        """The module as a constant with its exports."""
        text = IMPORT.sub(lambda place: f"const {{{place[1]}}} = {constant(place[2])};", self.text)
        text, exports = EXPORT.sub("", text), ", ".join(self.exports)
        return f"const {constant(self.path)} = (() => {{\n{text}return {{ {exports} }};\n}})();\n"


def _names(place: re.Match[str]) -> list[str]:
    """The names that an import lists; a comma may stand behind the last one."""
    return [name.strip() for name in place[1].strip().removesuffix(",").split(",")]
