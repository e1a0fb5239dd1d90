"""Tables and shares in the Markdown of notebooks (MyST)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from ...errors import missing_extra

if TYPE_CHECKING:
    from IPython.display import Markdown

NEARLY = 0.01  # distance from 0 or 1 within which a share has two decimals of a per cent


def grid(head: Sequence[Any], rows: Iterable[Iterable[Any]]) -> str:
    """A table in Markdown."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def numbered(name: str, caption: str, body: str) -> Markdown:
    """A table in Markdown with a number, a caption, and a name by which pages refer to it."""
    return markdown(f"```{{table}} {caption}\n:name: {name}\n:align: center\n\n{body}\n```")


def markdown(text: str) -> Markdown:
    """An object that a notebook shows as this text."""
    try:
        from IPython.display import Markdown
    except ImportError:
        raise missing_extra("IPython", "widgets") from None
    return Markdown(text)


def percent(share: float) -> str:
    """A share as a percentage, with two decimals where it is nearly, but not exactly, 0 or 1."""
    return f"{100 * share:.2f} %" if 0 < min(share, 1 - share) < NEARLY else f"{100 * share:.0f} %"
