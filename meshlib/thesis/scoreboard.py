"""Every printed number against ours: the verdicts, counted from computed values."""

import json
from collections import Counter
from dataclasses import asdict, dataclass
from importlib.resources import files

from .record import certificates, printed
from .studies import experiments

RECORD = files(__package__) / "record" / "verdicts.json"
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
    """Recompute one printed number, without a certificate if that gives it."""
    found = [_judged(number, result) for result in _results(number.experiment)]
    return min(found, key=lambda entry: VERDICTS.index(entry.verdict))


def _results(key):
    """What is computed for an experiment: by its certificate, and in natural order."""
    return [result for result in (experiments.run(key), experiments.natural(key)) if result]


def _judged(number, result):
    value = result.measures[number.measure, number.statistic]
    return Line(
        number.id,
        number.table,
        number.row,
        number.column,
        number.text,
        value,
        verdict(number, value, result.kind),
        result.experiment.recipe,
    )


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
    rows = [f"{'id':<40} {'printed':>8} {'reproduced':>10}  {'verdict':<9}  recipe"]
    rows += [
        f"{e.id:<40} {e.printed:>8} {printed.digits(e.reproduced, e.printed, 2):>10}  "
        f"{e.verdict:<9}  {e.recipe}"
        for e in board
    ]
    return "\n".join([*rows, "", summary(board)])


# -- against the record -----------------------------------------------------------------


def recorded():
    """The verdicts on record: id -> verdict."""
    return json.loads(RECORD.read_text())


def record(board):
    """Put the verdicts on record."""
    RECORD.write_text(json.dumps({entry.id: entry.verdict for entry in board}, indent=1) + "\n")


def faults(board):
    """What is worse than the record, and what is wrong with a certificate, a sentence for each.

    Parameters
    ----------
    board : list of Line

    Returns
    -------
    list of str
    """
    known = recorded()
    found = [
        f"{e.id} is {e.verdict}, on record is {known.get(e.id, 'nothing')}"
        for e in board
        if VERDICTS.index(e.verdict) > VERDICTS.index(known.get(e.id, VERDICTS[0]))
    ]
    found += [f"{key} is on record and was not computed" for key in known.keys() - {e.id for e in board}]
    for name in certificates.names():
        certificate = certificates.load(name)
        wrong = [*_off(name, certificate), *certificate.faults()]
        found += [f"certificate {name}: {fault}" for fault in wrong]
    return found


def _off(name, certificate):
    """What of a certificate is not as in the caption of its column."""
    experiment = experiments.EXPERIMENTS.get(name)
    if experiment is None:
        return ["no experiment has this name"]
    swap = experiment.operate
    caption = {
        "start": experiment.nodes,
        "function": experiment.function,
        "criterion": swap.criterion,
        "norm": swap.norm,
    }
    return [
        f"{what} is {getattr(certificate, what)!r}, by the caption {expected!r}"
        for what, expected in caption.items()
        if getattr(certificate, what) != expected
    ]
