"""The scoreboard on the command line: ``python -m meshlib.thesis [--json]``."""
import argparse
import json

from . import scoreboard


def main(arguments=None):
    """Print every printed number beside ours, as a table or as JSON."""
    parser = argparse.ArgumentParser(prog="python -m meshlib.thesis", description=scoreboard.__doc__)
    parser.add_argument("--json", action="store_true", help="print a JSON list instead of a table")
    chosen = parser.parse_args(arguments)
    board = scoreboard.lines()
    print(json.dumps(scoreboard.as_json(board), indent=1) if chosen.json else scoreboard.as_text(board))


if __name__ == "__main__":
    main()
