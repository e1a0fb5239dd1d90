"""The scoreboard on the command line: ``python -m meshlib.thesis [--json] [--check]``."""

import argparse
import json
import sys
from collections.abc import Sequence

from . import scoreboard


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the board; the exit status is 1 if the check finds a fault."""
    chosen = _parser().parse_args(arguments)
    board = scoreboard.lines()
    faults = scoreboard.faults(board) if chosen.check else []
    if chosen.record and not faults:
        scoreboard.record(board)
    print(json.dumps(scoreboard.as_json(board), indent=1) if chosen.json else scoreboard.as_text(board))
    print(*faults, sep="\n", end="\n" if faults else "", file=sys.stderr)
    return 1 if faults else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m meshlib.thesis", description=scoreboard.__doc__)
    parser.add_argument("--json", action="store_true", help="print a JSON list instead of a table")
    parser.add_argument(
        "--check",
        action="store_true",
        help="verify every certificate twice; fail if a verdict is worse than on record",
    )
    parser.add_argument("--record", action="store_true", help="put these verdicts on record")
    return parser


if __name__ == "__main__":
    sys.exit(main())
