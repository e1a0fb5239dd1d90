"""The search for certificates: ``python -m meshlib.thesis.search TABLE [COLUMN]``.

Numbers that depend on the order of the edges, and on rounding noise where the data are
flat, are looked for among random edge orders and perturbations of about 1e-9:

1. from a random start, a walk by simulated annealing approaches the printed L2 error;
2. from there, further walks approach the other printed numbers of the column, and refuse
   every step that loses the L2 error.

The work is cut into tasks, each with its own random generator, seeded by [seed, task].  The
first task in order that succeeds gives the certificate, so that the result depends on the
seed and not on the number of workers.  Progress is kept in a file; after an interruption
the same command goes on from there.
"""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path

from ...checks import choice, whole
from ...checks import workers as checked_workers
from ...errors import InvalidInputError, MeshError
from ...optima.many_orders import shared
from ..record import printed
from .walk import HUNTS, Target, as_certificate, task, way

FOLDER = Path("_build") / "search"
TASKS = 1000  # tasks before the search gives up
INTERRUPTED = 130  # exit status after Ctrl-C


def search(
    key: str,
    command: str,
    seed: int = 1,
    workers: int = -1,
    folder: Path = FOLDER,
    tasks: int = TASKS,
    progress: bool = True,
) -> Path | None:
    """Look for the certificate of an experiment, from where an earlier search stopped.

    Parameters
    ----------
    key : str
        Key of the experiment.
    command : str
        The command that repeats the search, for the certificate to name.
    seed, workers, folder, tasks, progress
        Seed, number of processes (-1 for one a core), where files go, number of tasks before
        the search gives up, and whether to show a progress bar.

    Returns
    -------
    Path or None
        The file of the certificate; None if no task has found one.
    """
    log = Log(folder, key, seed)
    parts = [(key, seed, number) for number in range(log.done, tasks)]
    results = shared(task, parts, workers, progress, "task", len(parts))
    for (*_, number), trial in zip(parts, results, strict=True):
        if trial and trial.distance == 0:
            certificate = as_certificate(Target(key), trial, f"{command} (task {number})")
            if not certificate.faults():  # a certificate with faults depends on rounding
                log.path.unlink(missing_ok=True)
                return _written(folder / f"{key}.json", certificate.to_json())
        log.add(number, trial.distance if trial else None)
    return None


class Log:
    """The number of finished tasks, kept in a file for one column, one seed and one set of settings."""

    def __init__(self, folder: Path, key: str, seed: int) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.path = folder / f"{key}.seed-{seed}.search.json"
        self._way = way(key)
        known = json.loads(self.path.read_text()) if self.path.is_file() else {}
        same = known.get("way") == self._way
        self.done: int = known["done"] if same else 0
        self.nearest: float | None = known["nearest"] if same else None

    def add(self, number: int, distance: float | None) -> None:
        """Note that a task is done, and its distance from the print if it reached the L2 error."""
        known = [d for d in (self.nearest, distance) if d is not None]
        self.done, self.nearest = number + 1, min(known, default=None)
        _written(self.path, json.dumps({"way": self._way, "done": self.done, "nearest": self.nearest}))


def _written(path: Path, text: str) -> Path:
    """Write a file whole or not at all; returns its path."""
    part = path.with_suffix(".part")
    part.write_text(text)
    return part.replace(path)


def key_of(table: str, column: str | None = None) -> str:
    """Key of the experiment behind a table column that needs a certificate.

    Examples
    --------
    >>> key_of("6.2", "Reordered")
    'DD1-33-refined-reordered'
    """
    columns = {
        c.title: c.experiment
        for c in printed.TABLES[choice(table, tuple(TABLES), "table")]
        if c.experiment in HUNTS
    }
    if column is None and len(columns) == 1:
        return next(iter(columns.values()))
    if column is None:
        raise InvalidInputError(
            "column", f"table {table} has several; name one of {', '.join(map(repr, columns))}"
        )
    return columns[choice(column, tuple(columns), "column")]


TABLES = tuple(t for t, columns in printed.TABLES.items() if any(c.experiment in HUNTS for c in columns))


def main(arguments: Sequence[str] | None = None) -> int:
    """Search from the command line; the exit status is 1 if nothing is found."""
    parser = _parser()
    chosen = parser.parse_args(arguments)
    try:
        found = _search(parser.prog, chosen)
    except (MeshError, OSError) as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        print("stopped; the same command goes on from here")
        return INTERRUPTED
    print(found or "nothing found; raise --tasks to go on")
    return 0 if found else 1


def _search(program: str, chosen: argparse.Namespace) -> Path | None:
    whole(chosen.seed, 0, "seed")
    whole(chosen.tasks, 1, "tasks")
    checked_workers(chosen.workers)
    column = [f'"{chosen.column}"'] if chosen.column else []
    command = " ".join([program, chosen.table, *column, f"--seed {chosen.seed}"])
    key = key_of(chosen.table, chosen.column)
    return search(key, command, chosen.seed, chosen.workers, chosen.folder, chosen.tasks)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m meshlib.thesis.search",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("table", help="5.3, 5.4, 5.5 or 6.2")
    parser.add_argument("column", nargs="?", help='as in the table, for example "SR1, ABN-L2"')
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=-1, help="processes; all cores by default")
    parser.add_argument("--folder", type=Path, default=FOLDER, help=f"where files go, {FOLDER} by default")
    parser.add_argument("--tasks", type=int, default=TASKS, help="number of tasks before it gives up")
    return parser
