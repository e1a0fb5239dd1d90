"""The hunt for certificates: ``python -m meshlib.thesis.search TABLE [COLUMN]``.

Numbers that depend on the order of the edges, and on rounding noise where the data are
flat, are looked for among random edge orders and perturbations of about 1e-9:

1. from a random start a walk of simulated annealing tends to the printed L2 error;
2. from there a second one tends to the other printed numbers of the column, and refuses
   whatever loses the L2 error.

A step draws anew the places in the order, or the perturbations, within a random disc.

The work is cut into tasks, each with a random generator of its own, [seed, task]; the
first task in order that succeeds gives the certificate, so that the result depends on
the seed alone and not on the number of workers.  What was done is kept in a file, and
the same command goes on from there.
"""
import argparse
import json
import sys
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from .. import Mesh, problems
from ..checks import choice
from ..optima import shared
from ..swapping import prepared
from ..topology import canonical
from . import printed
from .certificates import Certificate
from .experiments import EXPERIMENTS
from .measures import L2, Remembered, l2_error, measured

NOISE = 1e-9  # of nodal values; it changes no L2 error in the printed digits
LARGEST_RADIUS, SMALL_RADII = 0.5, 2  # of the discs of moves: 0.5 r^2 with r uniform in [0, 1]
ORDER_MOVES = 0.5  # share of the moves that change the order rather than the perturbation
STEPS = 6000  # of each of the two walks
SECOND_WALKS = 5  # from one start with the printed L2 error
WARM = 3e-3  # temperature of the first walk, in units of relative distance
HOT, COLD = 3e-3, 1e-5  # first and last temperature of the second
FOLDER = Path("_build") / "search"
TASKS = 100_000


@dataclass(frozen=True)
class Hunt:
    """Where a column is looked for.

    Attributes
    ----------
    noisy : float
        Share of the nodes whose value is perturbed.
    shuffled : bool
        Whether the order is random; else it is the natural one.
    tolerance : float, optional
        As for `meshlib.swapped`.
    """

    noisy: float
    shuffled: bool = True
    tolerance: float = None


HUNTS = {
    "SR2-81-JND-L2": Hunt(noisy=0.1, shuffled=False),
    "SR3-81-JND-L2": Hunt(noisy=0, tolerance=1e-6),
    "SR1-33-ABN-L2": Hunt(noisy=0.3),
    "SR1-33-ABN-L1": Hunt(noisy=0.3),
    "SR2-33-ABN-L1": Hunt(noisy=0.3),
    "DD1-33-refined-ABN-L2": Hunt(noisy=0.3),
    "DD1-33-refined-reordered": Hunt(noisy=0.3),
}


@dataclass(frozen=True)
class Trial:
    """A key for each edge, whose sorting is the order, a perturbation, and what they lead to."""

    keys: np.ndarray
    noise: np.ndarray
    mesh: Mesh
    distance: float

    @property
    def order(self):
        """Edge numbers in the order of inspection."""
        return np.argsort(self.keys, kind="stable")


@dataclass(frozen=True)
class Target:
    """The printed numbers of one column, and what leads from an order to one's own."""

    key: str

    @property
    def experiment(self):
        """The experiment that the column reports."""
        return EXPERIMENTS[self.key]

    @property
    def hunt(self):
        """Where it is looked for."""
        return HUNTS[self.key]

    @cached_property
    def texts(self):
        """(measure, statistic) -> printed text."""
        return {(n.measure, n.statistic): n.text for n in printed.numbers() if n.experiment == self.key}

    @cached_property
    def function(self):
        """The test function u."""
        return Remembered(problems.functions[self.experiment.function])

    @cached_property
    def procedure(self):
        """The procedure on unperturbed values."""
        swap, mesh = self.experiment.operate, problems.mesh(self.experiment.nodes)
        return prepared(mesh, self.function(*mesh.nodes.T), swap.criterion, swap.norm, swap.min_angle, None,
                        self.hunt.tolerance)

    def trial(self, keys, noise, distance, before=None):
        """What edge keys and a perturbation lead to; ``before`` saves measuring the same mesh again."""
        procedure = self.procedure
        if noise.any():
            procedure = replace(procedure, values=procedure.values + noise)
        mesh = Mesh._trusted(procedure.mesh.nodes, procedure.run(np.argsort(keys, kind="stable")).elements)
        same = before is not None and mesh.equals(before.mesh)
        return Trial(keys, noise, mesh, before.distance if same else distance(mesh))

    def first(self, rng):
        """A random start of a walk."""
        keys, noise = self._drawn(rng)
        if not self.hunt.shuffled:
            keys[problems.order(self.experiment.nodes)] = np.arange(len(keys))
        return self.trial(keys, noise, self.off_error)

    def moved(self, trial, rng, distance):
        """The keys, or the perturbation, drawn anew within a random disc."""
        keys, noise = self._drawn(rng)
        centre, radius = rng.random(2), LARGEST_RADIUS * rng.random() ** SMALL_RADII
        if self.hunt.shuffled and (not self.hunt.noisy or rng.random() < ORDER_MOVES):
            near = _within(self._midpoints, centre, radius)
            keys, noise = np.where(near, keys, trial.keys), trial.noise
        else:
            near = _within(self.procedure.mesh.nodes, centre, radius)
            keys, noise = trial.keys, np.where(near, noise, trial.noise)
        return self.trial(keys, noise, distance, trial)

    def _drawn(self, rng):
        mesh = self.procedure.mesh
        noisy = rng.random(mesh.n_nodes) < self.hunt.noisy
        return rng.random(mesh.n_edges), np.where(noisy, NOISE * rng.standard_normal(mesh.n_nodes), 0.0)

    @cached_property
    def _midpoints(self):
        mesh = self.procedure.mesh
        return mesh.nodes[mesh.edges].mean(axis=1)

    def off_error(self, mesh):
        """Relative distance of the L2 error from the printed one; 0 if it is printed so."""
        return _off(l2_error(mesh, self.function), self.texts[L2])

    def off_shape(self, mesh):
        """Sum of the relative distances of all other numbers; infinite if a maximum is another."""
        found = measured(mesh)
        off = {key: _off(found[key], text) for key, text in self.texts.items() if key != L2}
        return sum(np.inf if key[1] == "max" and d else d for key, d in off.items())

    def off_all(self, mesh):
        """The same; infinite also if the L2 error is another."""
        return np.inf if self.off_error(mesh) else self.off_shape(mesh)


def _off(value, text):
    return 0.0 if printed.matches(value, text) else abs(np.log(value / float(text)))


def _within(points, centre, radius):
    return np.hypot(*(points - centre).T) < radius


def task(key, seed, number):
    """Walk once from a random start: the nearest trial that has the printed L2 error, or None."""
    target, rng = Target(key), np.random.default_rng([seed, number])
    trial = walk(target, target.first(rng), rng, target.off_error, np.full(STEPS, WARM))
    if trial.distance > 0:
        return None
    trial = replace(trial, distance=target.off_shape(trial.mesh))
    if not np.isfinite(trial.distance):
        return None
    for _ in range(SECOND_WALKS):
        trial = min(trial, walk(target, trial, rng, target.off_all, np.geomspace(HOT, COLD, STEPS)),
                    key=lambda t: t.distance)
    return trial


def walk(target, trial, rng, distance, temperatures):
    """The nearest trial of an annealing walk, which ends at distance 0."""
    nearest = trial
    for temperature in temperatures:
        if nearest.distance == 0:
            break
        found = target.moved(trial, rng, distance)
        if found.distance - trial.distance <= temperature * rng.exponential():
            trial = found
        nearest = min(nearest, trial, key=lambda t: t.distance)
    return nearest


def as_certificate(target, trial, found_by):
    """The trial as data."""
    swap, procedure = target.experiment.operate, target.procedure
    noisy = np.flatnonzero(trial.noise)
    return Certificate(found_by, target.experiment.nodes, target.experiment.function, swap.criterion,
                       swap.norm, procedure.tolerance[1],
                       dict(zip(noisy.tolist(), trial.noise[noisy].tolist(), strict=True)),
                       procedure.mesh.nodes, procedure.mesh.elements, procedure.mesh.edges[trial.order],
                       canonical(trial.mesh.elements))


def search(key, command, seed=1, workers=-1, folder=FOLDER, tasks=TASKS, progress=True):
    """Look for the certificate of an experiment, from where an earlier search stopped.

    Returns
    -------
    Path or None
        The file of the certificate; None if none was found in so many tasks.
    """
    folder.mkdir(parents=True, exist_ok=True)
    log = folder / f"{key}.search.json"
    done, nearest = _resumed(log, seed)
    parts = [(key, seed, number) for number in range(done, tasks)]
    for (*_, number), trial in zip(parts, shared(task, parts, workers, progress, "task"), strict=True):
        if trial and trial.distance == 0:
            certificate = as_certificate(Target(key), trial, f"{command} (task {number})")
            if not certificate.faults():
                (folder / f"{key}.json").write_text(certificate.to_json())
                return folder / f"{key}.json"
        nearest = min(nearest, trial.distance if trial else np.inf)
        log.write_text(json.dumps({"seed": seed, "done": number + 1, "nearest": nearest}))
    return None


def _resumed(log, seed):
    """How many tasks are done with this seed, and the least distance so far."""
    state = json.loads(log.read_text()) if log.is_file() else {}
    return (state["done"], state["nearest"]) if state.get("seed") == seed else (0, np.inf)


def key_of(table, column=None):
    """The experiment behind a column of a table whose numbers are reachable.

    Examples
    --------
    >>> key_of("6.2", "Reordered")
    'DD1-33-refined-reordered'
    """
    columns = {c.title: c.experiment for c in printed.TABLES[choice(table, tuple(TABLES), "table")]
               if c.experiment in HUNTS}
    if column is None and len(columns) == 1:
        return next(iter(columns.values()))
    return columns[choice(column, tuple(columns), "column")]


TABLES = tuple(t for t, columns in printed.TABLES.items() if any(c.experiment in HUNTS for c in columns))


def main(arguments=None):
    """Search from the command line."""
    parser = argparse.ArgumentParser(prog="python -m meshlib.thesis.search", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", help="5.3, 5.4, 5.5 or 6.2")
    parser.add_argument("column", nargs="?", help='as in the table, for example "SR1, ABN-L2"')
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=-1, help="processes; all cores by default")
    parser.add_argument("--folder", type=Path, default=FOLDER, help=f"where files go, {FOLDER} by default")
    parser.add_argument("--tasks", type=int, default=TASKS, help="how many tasks before it gives up")
    chosen = parser.parse_args(arguments)
    column = [f'"{chosen.column}"'] if chosen.column else []
    command = " ".join([parser.prog, chosen.table, *column, f"--seed {chosen.seed}"])
    found = search(key_of(chosen.table, chosen.column), command, chosen.seed, chosen.workers, chosen.folder,
                   chosen.tasks)
    print(found or "nothing found; raise --tasks to go on")
    return 0 if found else 1


if __name__ == "__main__":
    from meshlib.thesis import search as importable  # what workers can unpickle
    sys.exit(importable.main())
