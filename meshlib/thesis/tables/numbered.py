"""The tables of the report as numbered MyST tables, every cell computed.

Each function returns an `IPython.display.Markdown` for a notebook cell with the
metadata ``{"mystnb": {"markdown_format": "myst"}}``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from ... import problems
from .. import scoreboard
from ..record import printed
from .markup import grid, markdown, numbered

if TYPE_CHECKING:
    from IPython.display import Markdown

HEAD = ("Mesh", "Measure", "Printed", "Reproduced", "Verdict")
CAPTIONS = {
    "5.1": "Geometric quality of the start meshes, mean and maximum.",
    "5.2": "$L_2$ error of the interpolants on the start meshes.",
    "5.3": "Edge swapping with JND-$L_2$ on 81 nodes: quality (mean, maximum) and $L_2$ error.",
    "5.4": "Edge swapping with ABN on 33 nodes: quality (mean, maximum) and $L_2$ error.",
    "5.5": "Edge swapping with ABN-$L_2$ on the refined 33-node mesh: quality (mean, maximum) "
    "and $L_2$ error.",
    "5.6": "$L_2$ error after refinement by edge.",
    "6.1": "Edge swapping of SR3 with no new angle below 8°: quality (mean, maximum) and $L_2$ error.",
    "6.2": "Two edge orders, two local optima: quality (mean, maximum) and $L_2$ error.",
}
NODES_PER_COLUMN = 17  # two columns of nodes stand side by side


def table_5_1() -> Markdown:
    """Table 5.1: geometric quality of the start meshes."""
    return _numbered("5.1")


def table_5_2() -> Markdown:
    """Table 5.2: L2 errors on the start meshes."""
    return _numbered("5.2")


def table_5_3() -> Markdown:
    """Table 5.3: edge swapping with JND-L2 on 81 nodes."""
    return _numbered("5.3")


def table_5_4() -> Markdown:
    """Table 5.4: edge swapping with ABN on 33 nodes."""
    return _numbered("5.4")


def table_5_5() -> Markdown:
    """Table 5.5: edge swapping of DD1 on the refined 33-node mesh."""
    return _numbered("5.5")


def table_5_6() -> Markdown:
    """Table 5.6: refinement by edge."""
    return _numbered("5.6")


def table_6_1() -> Markdown:
    """Table 6.1: edge swapping with a limit on the smallest angle."""
    return _numbered("6.1")


def table_6_2() -> Markdown:
    """Table 6.2: two edge orders."""
    return _numbered("6.2")


def in_text(section: str) -> Markdown:
    """A number that the thesis gives in the text of a section, ``"5.3.2"`` or ``"6.2"``."""
    return markdown(grid(HEAD, _rows({"6.2": "6.2-text"}.get(section, section))))


def appendix_a() -> Markdown:
    """The nodes of Appendix A beside those that Franke published."""
    number = np.arange(1, len(problems.nodes("33")) + 1)
    columns = (number, *problems.nodes("33").T, *problems.nodes("33-franke").T)
    rows = [
        f"{n} | {x:.1f} | {y:.1f} | {fx:.2f} | {fy:.2f}" for n, x, y, fx, fy in zip(*columns, strict=True)
    ]
    rows += [" | " * 4] * (2 * NODES_PER_COLUMN - len(rows))
    pairs = zip(rows[:NODES_PER_COLUMN], rows[NODES_PER_COLUMN:], strict=True)
    return markdown(grid(("Node", "$x$", "$y$", "$x$, Franke", "$y$, Franke") * 2, pairs))


def scoreboard_counts() -> Markdown:
    """Number of lines with each verdict, by table."""
    rows = [(printed.heading(table), *_cells(scoreboard.lines(table))) for table in printed.TABLES]
    rows.append(("**All**", *_cells(scoreboard.lines())))
    head = ("", "Printed numbers", *(v.capitalize() for v in scoreboard.VERDICTS))
    return markdown(grid(head, rows))


def _cells(board: list[scoreboard.Line]) -> tuple:
    return len(board), *(n or "·" for n in scoreboard.counts(board).values())


def _numbered(table: str) -> Markdown:
    body = grid(HEAD, _rows(table))
    return numbered(f"tab-{table.replace('.', '-')}", CAPTIONS[table], body)


def _rows(table: str) -> Iterator[tuple]:
    """For each column of the thesis a row for each of its measures, the first with the title."""
    board = iter(scoreboard.lines(table))
    for column in printed.TABLES[table]:
        title = column.title
        for measure, entry in column.entries.items():
            lines = [next(board) for _ in entry.split(", ")]
            yield (title, _title(measure), entry, _found(lines), _verdicts(lines))
            title = ""


def _title(measure: str) -> str:
    return printed.ROWS[measure].replace("L2", "$L_2$")


def _found(lines: Iterable[scoreboard.Line]) -> str:
    return ", ".join(printed.digits(line.reproduced, line.printed) for line in lines)


def _verdicts(lines: Iterable[scoreboard.Line]) -> str:
    """One word if all verdicts agree, else one for each number."""
    verdicts = [line.verdict for line in lines]
    return ", ".join(verdicts if len(set(verdicts)) > 1 else verdicts[:1])
