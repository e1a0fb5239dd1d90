"""The hunt for certificates: ``python -m meshlib.thesis.search TABLE [COLUMN]``.

Numbers that depend on the order of the edges, and on rounding noise where the data are
flat, are looked for among random edge orders and perturbations of about 1e-9:

1. from a random start a walk of simulated annealing tends to the printed L2 error;
2. from there a second one tends to the other printed numbers of the column, and refuses
   whatever loses the L2 error.

The work is cut into tasks, each with a random generator of its own, [seed, task]; the
first task in order that succeeds gives the certificate, so that the result depends on
the seed alone and not on the number of workers.  What was done is kept in a file, and
the same command goes on from there.
"""

import argparse
import json
from pathlib import Path

from ...checks import choice, whole
from ...checks import workers as checked_workers
from ...errors import InvalidInputError, MeshError
from ...optima.many_orders import shared
from ..record import printed
from .walk import HUNTS, Target, as_certificate, task, way

FOLDER = Path("_build") / "search"
TASKS = 1000
INTERRUPTED = 130  # exit status after Ctrl-C


def search(key, command, seed=1, workers=-1, folder=FOLDER, tasks=TASKS, progress=True):
    """Look for the certificate of an experiment, from where an earlier search stopped.

    Returns
    -------
    Path or None
        The file of the certificate; None if none was found in so many tasks.
    """
    log = Log(folder, key, seed)
    parts = [(key, seed, number) for number in range(log.done, tasks)]
    results = shared(task, parts, workers, progress, "task", len(parts))
    for (*_, number), trial in zip(parts, results, strict=True):
        if trial and trial.distance == 0:
            certificate = as_certificate(Target(key), trial, f"{command} (task {number})")
            if not certificate.faults():  # else it hangs on rounding
                log.path.unlink(missing_ok=True)
                return _written(folder / f"{key}.json", certificate.to_json())
        log.add(number, trial.distance if trial else None)
    return None


class Log:
    """How many tasks of a search are done, kept in a file; it holds for one seed and one way to search."""

    def __init__(self, folder, key, seed):
        folder.mkdir(parents=True, exist_ok=True)
        self.path = folder / f"{key}.seed-{seed}.search.json"
        self._way = way(key)
        known = json.loads(self.path.read_text()) if self.path.is_file() else {}
        same = known.get("way") == self._way
        self.done, self.nearest = (known["done"], known["nearest"]) if same else (0, None)

    def add(self, number, distance):
        """Note that a task is done, and how near it came to the print, if it got so far."""
        known = [d for d in (self.nearest, distance) if d is not None]
        self.done, self.nearest = number + 1, min(known, default=None)
        _written(self.path, json.dumps({"way": self._way, "done": self.done, "nearest": self.nearest}))


def _written(path, text):
    """Write a file at once or not at all; returns its path."""
    part = path.with_suffix(".part")
    part.write_text(text)
    return part.replace(path)


def key_of(table, column=None):
    """The experiment behind a column of a table whose numbers are reachable.

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


def main(arguments=None):
    """Search from the command line."""
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
    parser.add_argument("--tasks", type=int, default=TASKS, help="how many tasks before it gives up")
    chosen = parser.parse_args(arguments)
    column = [f'"{chosen.column}"'] if chosen.column else []
    command = " ".join([parser.prog, chosen.table, *column, f"--seed {chosen.seed}"])
    try:
        whole(chosen.seed, 0, "seed"), whole(chosen.tasks, 1, "tasks"), checked_workers(chosen.workers)
        found = search(
            key_of(chosen.table, chosen.column),
            command,
            chosen.seed,
            chosen.workers,
            chosen.folder,
            chosen.tasks,
        )
    except (MeshError, OSError) as error:
        parser.error(str(error))
    except KeyboardInterrupt:
        print("stopped; the same command goes on from here")
        return INTERRUPTED
    print(found or "nothing found; raise --tasks to go on")
    return 0 if found else 1
