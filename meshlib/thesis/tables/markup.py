"""Tables and shares in the Markdown of notebooks (MyST)."""

from ...errors import missing_extra


def grid(head, rows):
    """A table in Markdown."""
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def numbered(name, caption, body):
    """A table in Markdown with a number, a caption, and a name to refer to it."""
    return markdown(f"```{{table}} {caption}\n:name: {name}\n:align: center\n\n{body}\n```")


def markdown(text):
    """The text as a notebook shows it."""
    try:
        from IPython.display import Markdown
    except ImportError:
        raise missing_extra("IPython", "widgets") from None
    return Markdown(text)


def percent(share):
    """A share as a percentage, with two decimals where it is nearly, but not, 0 or 1."""
    return f"{100 * share:.2f} %" if 0 < min(share, 1 - share) < 0.01 else f"{100 * share:.0f} %"
