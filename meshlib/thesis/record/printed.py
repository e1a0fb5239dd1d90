"""The 91 numbers that the thesis prints, as data, and when a computed value matches one.

They stand in Tables 5.1 to 5.6, 6.1 and 6.2, and two in the text.  Each is kept as the
text that was printed, because its digits decide what matches.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_FLOOR, ROUND_HALF_UP, Decimal
from functools import cache

GEOMETRY = ("maximum_angle", "skewness", "aspect_ratio")
ROWS = {
    "maximum_angle": "Maximum angle",
    "skewness": "Skewness",
    "aspect_ratio": "Aspect ratio",
    "l2_error": "L2 error",
}
STATISTICS = ("mean", "max")


@dataclass(frozen=True)
class Column:
    """A column of a table: the experiment it reports, and one entry for each row.

    Entries are ``"mean, max"`` for geometry and a single number for the L2 error.
    """

    title: str
    experiment: str
    entries: dict[str, str]


@dataclass(frozen=True)
class Printed:
    """One printed number.

    Attributes
    ----------
    id : str
        Table, column, row and statistic, for example ``"5.3/SR2/skewness/max"``.
    table, row, column : str
        As the thesis heads them.
    experiment, measure, statistic : str
        What it measures of which experiment; the statistic of an L2 error is empty.
    text : str
        The digits as printed.
    """

    id: str
    table: str
    row: str
    column: str
    experiment: str
    measure: str
    statistic: str
    text: str


def _geometry(angle: str, skewness: str, ratio: str, l2: str | None = None) -> dict[str, str]:
    entries = dict(zip(GEOMETRY, (angle, skewness, ratio), strict=True))
    return entries | ({"l2_error": l2} if l2 else {})


TABLES = {
    "5.1": (
        Column("81 pt", "start-81", _geometry("90, 90", "0.3491, 0.3491", "0.8660, 0.8660")),
        Column("33 pt", "start-33", _geometry("103.0, 135.0", "0.5210, 0.8727", "0.6831, 0.8661")),
        Column(
            "Refined 33 pt", "start-33-refined", _geometry("103.0, 135.0", "0.5210, 0.8727", "0.6831, 0.8661")
        ),
    ),
    "5.2": (
        Column("SR1, 81 pt", "SR1-81", {"l2_error": "0.004325"}),
        Column("SR2, 81 pt", "SR2-81", {"l2_error": "0.04384"}),
        Column("SR3, 81 pt", "SR3-81", {"l2_error": "0.05970"}),
        Column("SR1, 33 pt", "SR1-33", {"l2_error": "0.02164"}),
        Column("SR2, 33 pt", "SR2-33", {"l2_error": "0.1131"}),
        Column("DD1, refined 33 pt", "DD1-33-refined", {"l2_error": "0.0508"}),
    ),
    "5.3": (
        Column(
            "SR2", "SR2-81-JND-L2", _geometry("98.4, 135.0", "0.4472, 0.8726", "0.7848, 0.8660", "0.01946")
        ),
        Column(
            "SR3", "SR3-81-JND-L2", _geometry("141.2, 168.7", "0.9448, 1.264", "0.3450, 0.8660", "0.03502")
        ),
    ),
    "5.4": (
        Column(
            "SR1, ABN-L2",
            "SR1-33-ABN-L2",
            _geometry("119.4, 168.7", "0.6970, 1.264", "0.5248, 0.8660", "0.0170"),
        ),
        Column(
            "SR1, ABN-L1",
            "SR1-33-ABN-L1",
            _geometry("124.1, 174.8", "0.7569, 1.335", "0.4745, 0.8660", "0.0124"),
        ),
        Column(
            "SR2, ABN-L1",
            "SR2-33-ABN-L1",
            _geometry("126.0, 168.7", "0.7771, 1.264", "0.4539, 0.9897", "0.09458"),
        ),
    ),
    "5.5": (
        Column(
            "DD1",
            "DD1-33-refined-ABN-L2",
            _geometry("112.0, 175.2", "0.6209, 1.340", "0.5929, 0.9897", "0.03336"),
        ),
    ),
    "5.6": (
        Column("81 pt", "SR1-81-by-edge", {"l2_error": "0.003669"}),
        Column("33 pt", "SR1-33-by-edge", {"l2_error": "0.01935"}),
    ),
    "5.3.2": (Column("33 pt", "SR1-33-by-element", {"l2_error": "0.01916"}),),
    "6.1": (
        Column(
            "SR3", "SR3-81-8-degrees", _geometry("137.7, 153.4", "0.9052, 1.087", "0.3822, 0.8660", "0.05502")
        ),
    ),
    "6.2": (
        Column(
            "Original",
            "DD1-33-refined-ABN-L2",
            _geometry("112.0, 175.2", "0.6209, 1.340", "0.5929, 0.9897", "0.03336"),
        ),
        Column(
            "Reordered",
            "DD1-33-refined-reordered",
            _geometry("112.6, 175.2", "0.6270, 1.340", "0.5893, 0.9897", "0.03100"),
        ),
    ),
    "6.2-text": (Column("33 pt", "SR1-33-density", {"l2_error": "0.02150"}),),
}

IN_TEXT = {"5.3.2": "Section 5.3.2", "6.2-text": "Section 6.2"}

ASPECT_RATIO = (
    "the largest aspect ratio is that of a right isosceles element, sqrt(3)/2 = 0.8660254; "
    "Tables 5.3, 5.4 and 6.1 print the same value as 0.8660"
)
MISPRINTS = {f"5.1/{column}/aspect_ratio/max": ASPECT_RATIO for column in ("33 pt", "Refined 33 pt")}


def heading(table: str) -> str:
    """What the thesis calls a table, or the section that prints a single number."""
    return IN_TEXT.get(table, f"Table {table}")


def numbers() -> list[Printed]:
    """All printed numbers, in the order of the thesis.

    Examples
    --------
    >>> len(numbers())
    91
    >>> numbers()[0].id, numbers()[0].text
    ('5.1/81 pt/maximum_angle/mean', '90')
    """
    return [
        number
        for table, columns in TABLES.items()
        for column in columns
        for number in _entries(table, column)
    ]


@cache
def texts(experiment: str) -> dict[tuple[str, str], str]:
    """The digits that the thesis prints for an experiment: (measure, statistic) -> text.

    Examples
    --------
    >>> texts("SR1-81")
    {('l2_error', ''): '0.004325'}
    """
    return {(n.measure, n.statistic): n.text for n in numbers() if n.experiment == experiment}


def _entries(table: str, column: Column) -> Iterator[Printed]:
    for measure, entry in column.entries.items():
        texts = entry.split(", ")
        for statistic, text in zip(STATISTICS if len(texts) > 1 else ("",), texts, strict=True):
            key = "/".join(filter(None, (table, column.title, measure, statistic)))
            title = ", ".join(filter(None, (column.title, statistic)))
            of = column.experiment, measure, statistic
            yield Printed(key, heading(table), ROWS[measure], title, *of, text)


def matches(value: float, text: str) -> bool:
    """Whether a value, rounded or truncated to the digits of the text, gives the text.

    The thesis does both: it prints 168.690 as 168.7, and 1.26467 as 1.264.

    Examples
    --------
    >>> matches(168.690, "168.7"), matches(1.26467, "1.264"), matches(0.8660254, "0.8661")
    (True, True, False)
    """
    exact, unit = Decimal(repr(float(value))), int(Decimal(text).as_tuple().exponent)
    return any(
        exact.quantize(Decimal(1).scaleb(unit), how) == Decimal(text) for how in (ROUND_HALF_UP, ROUND_FLOOR)
    )


def digits(value: float, text: str, extra: int = 1) -> str:
    """A value with ``extra`` decimals more than the printed text.

    Examples
    --------
    >>> digits(0.86602540378, "0.8661")
    '0.86603'
    """
    places = max(0, -int(Decimal(text).as_tuple().exponent))
    return f"{value:.{places + extra}f}"
