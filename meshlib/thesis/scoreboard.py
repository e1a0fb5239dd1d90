"""Every printed number against ours: the verdicts, counted from computed values."""
from collections import Counter
from dataclasses import asdict, dataclass

from . import experiments, printed

VERDICTS = ("exact", "reachable", "misprint", "open")


@dataclass(frozen=True)
class Line:
    """A printed number, ours, and the verdict."""

    id: str
    table: str
    row: str
    column: str
    printed: str
    reproduced: float
    verdict: str
    recipe: str


def verdict(number, value, kind):
    """How far a printed number is accounted for.

    ``"exact"``: a deterministic recipe gives all printed digits; ``"reachable"``: a
    certificate does; ``"misprint"``: ours differs by one unit of the last digit and
    the evidence is on record; ``"open"``: not reached.

    Examples
    --------
    >>> first = printed.numbers()[0]
    >>> verdict(first, 90.0, "deterministic"), verdict(first, 91.0, "deterministic")
    ('exact', 'open')
    """
    if printed.matches(value, number.text):
        return {experiments.DETERMINISTIC: "exact", experiments.CERTIFIED: "reachable"}.get(kind, "open")
    unit = 10.0 ** -len(number.text.partition(".")[2])
    if number.id in printed.MISPRINTS and abs(value - float(number.text)) <= unit:
        return "misprint"
    return "open"


def line(number):
    """Recompute one printed number."""
    result = experiments.run(number.experiment)
    value = result.measures[number.measure, number.statistic]
    return Line(number.id, number.table, number.row, number.column, number.text, value,
                verdict(number, value, result.kind), result.experiment.recipe)


def lines(table=None):
    """Recompute all printed numbers, or those of one table.

    Examples
    --------
    >>> [(line.printed, line.verdict) for line in lines("5.6")]
    [('0.003669', 'exact'), ('0.01935', 'exact')]
    """
    return [line(n) for n in printed.numbers() if table is None or n.table == printed.heading(table)]


def counts(board):
    """Number of lines by verdict, in the order exact, reachable, misprint, open."""
    found = Counter(entry.verdict for entry in board)
    return {verdict: found[verdict] for verdict in VERDICTS}


def summary(board):
    """The counts in one sentence."""
    listed = ", ".join(f"{n} {verdict}" for verdict, n in counts(board).items())
    return f"{len(board)} printed numbers: {listed}"


def as_json(board):
    """The lines as a list of dictionaries."""
    return [asdict(entry) for entry in board]


def as_text(board):
    """The lines as a table of plain text, closed by the counts."""
    rows = [f"{'id':<44} {'printed':>9} {'reproduced':>12}  verdict"]
    rows += [f"{e.id:<44} {e.printed:>9} {printed.digits(e.reproduced, e.printed, 2):>12}  {e.verdict}"
             for e in board]
    return "\n".join([*rows, "", summary(board)])
