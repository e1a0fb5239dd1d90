"""The tables of the report, a module for each section that has some."""

from .numbered import (
    appendix_a,
    in_text,
    scoreboard_counts,
    table_5_1,
    table_5_2,
    table_5_3,
    table_5_4,
    table_5_5,
    table_5_6,
    table_6_1,
    table_6_2,
)

__all__ = [
    "appendix_a",
    "in_text",
    "scoreboard_counts",
    "table_5_1",
    "table_5_2",
    "table_5_3",
    "table_5_4",
    "table_5_5",
    "table_5_6",
    "table_6_1",
    "table_6_2",
]
