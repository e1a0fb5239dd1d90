"""Every printed number beside the one computed today, with a verdict."""

import json
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from .record import certificates, printed
from .studies import experiments

RECORD = Path(__file__).parent / "record" / "verdicts.json"
VERDICTS = ("exact", "reachable", "misprint", "open")


@dataclass(frozen=True)
class Line:
    """A printed number, the one computed today, and the verdict."""

    id: str
    table: str
    row: str
    column: str
    printed: str
    reproduced: float
    verdict: str
    recipe: str


def verdict(number: printed.Printed, value: float, kind: str) -> str:
    """How far a computed value accounts for a printed number.

    ``"exact"``: a deterministic recipe gives all printed digits; ``"reachable"``: a
    certificate does; ``"misprint"``: the value differs by at most one unit of the last
    digit and the evidence against the print is on record; ``"open"``: not reached.

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


def line(number: printed.Printed) -> Line:
    """Recompute a printed number, with the better verdict of certificate and natural order."""
    found = [_judged(number, result) for result in _results(number.experiment)]
    return min(found, key=lambda entry: VERDICTS.index(entry.verdict))


def _results(key: str) -> list[experiments.Result]:
    """The results of an experiment: by its certificate if it has one, and in natural order."""
    return [result for result in (experiments.run(key), experiments.natural(key)) if result]


def _judged(number: printed.Printed, result: experiments.Result) -> Line:
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


def lines(table: str | None = None) -> list[Line]:
    """Recompute all printed numbers, or those of one table.

    Examples
    --------
    >>> [(line.printed, line.verdict) for line in lines("5.6")]
    [('0.003669', 'exact'), ('0.01935', 'exact')]
    """
    return [line(n) for n in printed.numbers() if table is None or n.table == printed.heading(table)]


def counts(board: Iterable[Line]) -> dict[str, int]:
    """Number of lines with each verdict, in the order exact, reachable, misprint, open."""
    found = Counter(entry.verdict for entry in board)
    return {verdict: found[verdict] for verdict in VERDICTS}


def summary(board: Collection[Line]) -> str:
    """The counts in one sentence."""
    listed = ", ".join(f"{n} {verdict}" for verdict, n in counts(board).items())
    return f"{len(board)} printed numbers: {listed}"


def as_json(board: Iterable[Line]) -> list[dict]:
    """The lines as a list of dictionaries."""
    return [asdict(entry) for entry in board]


def as_text(board: Collection[Line]) -> str:
    """The lines as a table of plain text, with the counts below it."""
    rows = [f"{'id':<40} {'printed':>8} {'reproduced':>10}  {'verdict':<9}  recipe"]
    rows += [
        f"{e.id:<40} {e.printed:>8} {printed.digits(e.reproduced, e.printed, 2):>10}  "
        f"{e.verdict:<9}  {e.recipe}"
        for e in board
    ]
    return "\n".join([*rows, "", summary(board)])


# -- against the record -----------------------------------------------------------------


def recorded() -> dict[str, str]:
    """The verdicts on record: id of a printed number -> verdict."""
    return json.loads(RECORD.read_text())


def record(board: Iterable[Line]) -> None:
    """Put the verdicts on record."""
    RECORD.write_text(json.dumps({entry.id: entry.verdict for entry in board}, indent=1) + "\n")


def faults(board: Collection[Line]) -> list[str]:
    """Verdicts that are worse than on record, and certificates that do not hold.

    Parameters
    ----------
    board : collection of Line

    Returns
    -------
    list of str
        A sentence for each fault.
    """
    return [*_worse(board), *_wrong_certificates()]


def _worse(board: Collection[Line]) -> Iterator[str]:
    known = recorded()
    for entry in board:
        if VERDICTS.index(entry.verdict) > VERDICTS.index(known.get(entry.id, VERDICTS[0])):
            yield f"{entry.id} is {entry.verdict}, on record is {known.get(entry.id, 'nothing')}"
    for key in sorted(known.keys() - {entry.id for entry in board}):
        yield f"{key} is on record and was not computed"


def _wrong_certificates() -> Iterator[str]:
    for name in certificates.names():
        certificate = certificates.load(name)
        for fault in (*_not_as_captioned(name, certificate), *certificate.faults()):
            yield f"certificate {name}: {fault}"


def _not_as_captioned(name: str, certificate: certificates.Certificate) -> list[str]:
    """Where a certificate differs from the caption of its column."""
    experiment = experiments.EXPERIMENTS.get(name)
    if experiment is None:
        return ["no experiment has this name"]
    swap = experiment.operate
    start, function, criterion, norm = experiment.nodes, experiment.function, swap.criterion, swap.norm
    caption = {"start": start, "function": function, "criterion": criterion, "norm": norm}
    return [
        f"{what} is {getattr(certificate, what)!r}, by the caption {expected!r}"
        for what, expected in caption.items()
        if getattr(certificate, what) != expected
    ]
