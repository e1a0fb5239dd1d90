"""Where certificates are looked for, and the walk towards the printed numbers of a column.

A step of the walk takes a random disc in the domain and draws either new places in the order for
all edges inside, or new perturbations for all nodes inside.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ... import Mesh, problems
from ...mesh.topology import canonical
from ...swapping.procedure import Procedure
from ..record import printed
from ..record.certificates import Certificate
from ..studies.experiments import EXPERIMENTS, Experiment
from ..studies.measures import L2, Function, Remembered, l2_error, measured

Distance = Callable[[Mesh], float]

NOISE = 1e-9  # standard deviation of a perturbation; it changes no L2 error in the printed digits
LARGEST_RADIUS, SMALL_RADII = 0.5, 2  # a disc has the radius 0.5 r^2 with r uniform in [0, 1]
ORDER_MOVES = 0.5  # share of the steps that change the order rather than the perturbation
STEPS = 6000  # steps of a walk
SECOND_WALKS = 5  # walks towards the other numbers from one mesh with the printed L2 error
WARM = 3e-3  # temperature of the first walk, a relative distance from the print
HOT, COLD = 3e-3, 1e-5  # first and last temperature of a second walk


@dataclass(frozen=True)
class Hunt:
    """Among which orders and perturbations a column is looked for.

    Attributes
    ----------
    noisy : float
        Share of the nodes whose value is perturbed.
    shuffled : bool
        Whether the order is random; if not, it is the natural one.
    tolerance : float, optional
        Gain below which no swap is made; by default that of `meshlib.swapped`.
    """

    noisy: float
    shuffled: bool = True
    tolerance: float | None = None


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
    """An edge order and a perturbation, the mesh they lead to, and how far it is from the print.

    Attributes
    ----------
    keys : (E,) ndarray of float64
        A sort key for each edge; in increasing order they give the order of the edges.
    noise : (N,) ndarray of float64
        What is added to the nodal values.
    mesh : Mesh
    distance : float
        Distance from the printed numbers; 0 if they match.
    """

    keys: np.ndarray
    noise: np.ndarray
    mesh: Mesh
    distance: float

    @property
    def order(self) -> np.ndarray:
        """Edge numbers in the order of inspection."""
        return _order(self.keys)


def _order(keys: np.ndarray) -> np.ndarray:
    return np.argsort(keys, kind="stable")


@dataclass(frozen=True)
class Target:
    """The printed numbers of one column, and the procedure that should give them."""

    key: str

    @property
    def experiment(self) -> Experiment:
        """The experiment that the column reports."""
        return EXPERIMENTS[self.key]

    @property
    def hunt(self) -> Hunt:
        """Where the column is looked for."""
        return HUNTS[self.key]

    @property
    def texts(self) -> dict[tuple[str, str], str]:
        """(measure, statistic) -> printed text."""
        return printed.texts(self.key)

    @cached_property
    def function(self) -> Function:
        """The test function u."""
        return Remembered(problems.functions[self.experiment.function])

    @cached_property
    def procedure(self) -> Procedure:
        """The local optimisation procedure on unperturbed values."""
        mesh = problems.mesh(self.experiment.nodes)
        return self.experiment.operate.prepared(mesh, self.function(*mesh.nodes.T), self.hunt.tolerance)

    def trial(
        self, keys: np.ndarray, noise: np.ndarray, distance: Distance, before: Trial | None = None
    ) -> Trial:
        """What keys and a perturbation lead to; the mesh of the trial ``before`` is not measured again."""
        procedure = self.procedure
        if noise.any():
            procedure = replace(procedure, values=procedure.values + noise)
        mesh = procedure.swapped(_order(keys))
        if before is not None and mesh.equals(before.mesh):
            return Trial(keys, noise, mesh, before.distance)
        return Trial(keys, noise, mesh, distance(mesh))

    def first(self, rng: np.random.Generator) -> Trial:
        """A random start of a walk."""
        keys, noise = self._drawn(rng)
        if not self.hunt.shuffled:
            keys[problems.order(self.experiment.nodes)] = np.arange(len(keys))
        return self.trial(keys, noise, self.off_error)

    def moved(self, trial: Trial, rng: np.random.Generator, distance: Distance) -> Trial:
        """A trial whose keys, or perturbations, within a random disc are drawn again."""
        keys, noise = self._drawn(rng)
        centre, radius = rng.random(2), LARGEST_RADIUS * rng.random() ** SMALL_RADII
        if self.hunt.shuffled and (not self.hunt.noisy or rng.random() < ORDER_MOVES):
            near = _within(self._midpoints, centre, radius)
            keys, noise = np.where(near, keys, trial.keys), trial.noise
        else:
            near = _within(self.procedure.mesh.nodes, centre, radius)
            keys, noise = trial.keys, np.where(near, noise, trial.noise)
        return self.trial(keys, noise, distance, trial)

    def _drawn(self, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        mesh = self.procedure.mesh
        noisy = rng.random(mesh.n_nodes) < self.hunt.noisy
        return rng.random(mesh.n_edges), np.where(noisy, NOISE * rng.standard_normal(mesh.n_nodes), 0.0)

    @cached_property
    def _midpoints(self) -> np.ndarray:
        mesh = self.procedure.mesh
        return mesh.nodes[mesh.edges].mean(axis=1)

    def off_error(self, mesh: Mesh) -> float:
        """Relative distance of the L2 error from the printed one; 0 if it matches."""
        return _off(l2_error(mesh, self.function), self.texts[L2])

    def off_shape(self, mesh: Mesh) -> float:
        """Sum of the relative distances of all other numbers; infinite if a maximum does not match."""
        found = measured(mesh)
        off = {key: _off(found[key], text) for key, text in self.texts.items() if key != L2}
        return sum(np.inf if key[1] == "max" and d else d for key, d in off.items())

    def off_all(self, mesh: Mesh) -> float:
        """Distance `off_shape`, or infinity if the L2 error does not match."""
        return np.inf if self.off_error(mesh) else self.off_shape(mesh)


def _off(value: float, text: str) -> float:
    return 0.0 if printed.matches(value, text) else abs(np.log(value / float(text)))


def _within(points: np.ndarray, centre: np.ndarray, radius: float) -> np.ndarray:
    return np.hypot(*(points - centre).T) < radius


def way(key: str) -> str:
    """All settings that a walk depends on, as text."""
    return repr(
        (HUNTS[key], NOISE, LARGEST_RADIUS, SMALL_RADII, ORDER_MOVES, STEPS, SECOND_WALKS, WARM, HOT, COLD)
    )


def task(key: str, seed: int, number: int) -> Trial | None:
    """Walk from a random start: the nearest trial with the printed L2 error, or None if there is none."""
    target, rng = Target(key), np.random.default_rng([seed, number])
    trial = walk(target, target.first(rng), rng, target.off_error, np.full(STEPS, WARM))
    if trial.distance > 0:
        return None
    trial = replace(trial, distance=target.off_shape(trial.mesh))
    if not np.isfinite(trial.distance):
        return None
    for _ in range(SECOND_WALKS):
        found = walk(target, trial, rng, target.off_all, np.geomspace(HOT, COLD, STEPS))
        trial = min(trial, found, key=lambda t: t.distance)
    return trial


def walk(
    target: Target,
    trial: Trial,
    rng: np.random.Generator,
    distance: Distance,
    temperatures: Iterable[float],
) -> Trial:
    """The nearest trial of a walk by simulated annealing, which stops at distance 0."""
    nearest = trial
    for temperature in temperatures:
        if nearest.distance == 0:
            break
        found = target.moved(trial, rng, distance)
        if found.distance - trial.distance <= temperature * rng.exponential():
            trial = found
        nearest = min(nearest, trial, key=lambda t: t.distance)
    return nearest


def as_certificate(target: Target, trial: Trial, found_by: str) -> Certificate:
    """A trial as data that any program can check."""
    experiment, procedure = target.experiment, target.procedure
    mesh, noisy = procedure.mesh, np.flatnonzero(trial.noise)
    return Certificate(
        found_by=found_by,
        start=experiment.nodes,
        function=experiment.function,
        criterion=experiment.operate.criterion,
        norm=experiment.operate.norm,
        tolerance=procedure.tolerance[1],
        perturbation=dict(zip(noisy.tolist(), trial.noise[noisy].tolist(), strict=True)),
        nodes=mesh.nodes,
        elements=mesh.elements,
        edges=mesh.edges[trial.order],
        result=canonical(trial.mesh.elements),
    )
