"""Where certificates are looked for, and one walk towards the printed numbers of a column.

A step draws anew the places in the edge order, or the perturbations, within a random disc.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ... import Mesh, problems
from ...mesh.topology import canonical
from ..record import printed
from ..record.certificates import Certificate
from ..studies.experiments import EXPERIMENTS
from ..studies.measures import L2, Remembered, l2_error, measured

NOISE = 1e-9  # of nodal values; it changes no L2 error in the printed digits
LARGEST_RADIUS, SMALL_RADII = 0.5, 2  # of the discs of moves: 0.5 r^2 with r uniform in [0, 1]
ORDER_MOVES = 0.5  # share of the moves that change the order rather than the perturbation
STEPS = 6000  # of each of the two walks
SECOND_WALKS = 5  # from one start with the printed L2 error
WARM = 3e-3  # temperature of the first walk, in units of relative distance
HOT, COLD = 3e-3, 1e-5  # first and last temperature of the second


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
        return _order(self.keys)


def _order(keys):
    return np.argsort(keys, kind="stable")


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

    @property
    def texts(self):
        """(measure, statistic) -> printed text."""
        return printed.texts(self.key)

    @cached_property
    def function(self):
        """The test function u."""
        return Remembered(problems.functions[self.experiment.function])

    @cached_property
    def procedure(self):
        """The procedure on unperturbed values."""
        mesh = problems.mesh(self.experiment.nodes)
        return self.experiment.operate.prepared(mesh, self.function(*mesh.nodes.T), self.hunt.tolerance)

    def trial(self, keys, noise, distance, before=None):
        """What edge keys and a perturbation lead to; ``before`` saves measuring the same mesh again."""
        procedure = self.procedure
        if noise.any():
            procedure = replace(procedure, values=procedure.values + noise)
        mesh = procedure.swapped(_order(keys))
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


def way(key):
    """All settings that a walk depends on, as text."""
    return repr(
        (HUNTS[key], NOISE, LARGEST_RADIUS, SMALL_RADII, ORDER_MOVES, STEPS, SECOND_WALKS, WARM, HOT, COLD)
    )


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
        trial = min(
            trial,
            walk(target, trial, rng, target.off_all, np.geomspace(HOT, COLD, STEPS)),
            key=lambda t: t.distance,
        )
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
    return Certificate(
        found_by,
        target.experiment.nodes,
        target.experiment.function,
        swap.criterion,
        swap.norm,
        procedure.tolerance[1],
        dict(zip(noisy.tolist(), trial.noise[noisy].tolist(), strict=True)),
        procedure.mesh.nodes,
        procedure.mesh.elements,
        procedure.mesh.edges[trial.order],
        canonical(trial.mesh.elements),
    )
