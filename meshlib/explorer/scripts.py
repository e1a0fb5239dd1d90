"""The scripts of the explorer, each joined from its modules: one for a widget, one for a page."""

from pathlib import Path

from .joining import constant, joined

HERE = Path(__file__).parent
WIDGET, PAGE = (HERE / "js" / name for name in ("widget.js", "page.js"))


def module() -> str:
    """The ES module of the widget, whose hooks anywidget expects as the default export."""
    return f"{joined(WIDGET)}export default {constant(WIDGET)};\n"


def classic() -> str:
    """The script of a page, which unlike a module a browser also loads from a file."""
    return f'(() => {{\n"use strict";\n{joined(PAGE)}}})();\n'


def styles() -> str:
    """The style sheet of both."""
    return (HERE / "view.css").read_text(encoding="utf-8")
