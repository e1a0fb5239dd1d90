"""The scripts of the explorer joined: a widget has a single file, and so has a page."""

from pathlib import Path

HERE = Path(__file__).parent
SHARED = (
    "atlas.js",
    "measures.js",
    "pens.js",
    "drawing.js",
    "inspection.js",
    "saving.js",
    "panels.js",
    "view.js",
)


def module():
    """The ECMAScript module of the widget."""
    return _joined(*SHARED, "widget.js")


def classic():
    """The script of a page, which unlike a module a browser also loads from a file."""
    return f"(() => {{\n{_joined(*SHARED, 'controls.js', 'page.js')}}})();\n"


def styles():
    """The style sheet of both."""
    return (HERE / "view.css").read_text(encoding="utf-8")


def _joined(*names):
    return "\n".join((HERE / name).read_text(encoding="utf-8") for name in names)
