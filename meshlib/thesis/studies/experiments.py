"""The experiments of chapters 5 and 6: what each computes, and by which recipe.

An experiment is a start mesh, a function and an operation.  Most are deterministic;
those whose printed numbers depend on the edge order and on rounding noise read an
order and a perturbation from a certificate, a file of explicit data.
"""

from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import numpy as np

from ... import Interpolant, Mesh, problems, refined, smoothed, swapped
from ...checks import choice
from ...refinement.refined import Refinement
from ...swapping.procedure import Procedure
from ...swapping.swapped import Swapping, prepared
from ..record import certificates
from .measures import Function, Measures, measured

SHARE = 0.2  # fraction of the elements that is marked
SMALLEST_ANGLE = 8.0  # degrees, the limit of section 6.1
NATURAL = "edges in natural order"

DETERMINISTIC, CERTIFIED, MISSING = "deterministic", "certificate", "none"


@dataclass(frozen=True)
class Experiment:
    """How one mesh of the report comes about.

    Attributes
    ----------
    key : str
    nodes : str
        Name of the start mesh in `meshlib.problems`.
    operate : callable
        ``operate(mesh, u, order)`` returns a record with a ``.mesh``.
    recipe : str
        One line that says how the mesh is made.
    function : str
        Name of u in `meshlib.problems`, empty where none is needed.
    certified : bool
        Whether order and perturbation come from the certificate named by the key.
    shuffled : bool
        Whether the thesis shuffled the edges, so that no natural order is meant.
    """

    key: str
    nodes: str
    operate: Any
    recipe: str
    function: str = ""
    certified: bool = False
    shuffled: bool = False


@dataclass(frozen=True)
class Result:
    """An experiment carried out.

    Attributes
    ----------
    experiment : Experiment
    start, mesh : Mesh
        The mesh before and after.
    record : object
        What the operation returned.
    kind : {"deterministic", "certificate", "none"}
        ``"none"`` if a certificate is needed and there is none; the result is then that of
        the natural order.
    """

    experiment: Experiment
    start: Mesh
    mesh: Mesh
    record: Any
    kind: str

    @property
    def function(self) -> Function | None:
        """The test function u, or None."""
        return problems.functions.get(self.experiment.function)

    @cached_property
    def measures(self) -> Measures:
        """Every number that the tables print: (measure, statistic) -> value."""
        return measured(self.mesh, self.function)

    @cached_property
    def interpolant(self) -> Interpolant:
        """Interpolant of u on the mesh."""
        return Interpolant(self.mesh, problems.functions[self.experiment.function])

    @cached_property
    def start_interpolant(self) -> Interpolant:
        """Interpolant of u on the start mesh."""
        return Interpolant(self.start, problems.functions[self.experiment.function])


@dataclass(frozen=True)
class Unchanged:
    """The record of an experiment that adapts nothing."""

    mesh: Mesh


def _start(nodes: str, function: str = "") -> Experiment:
    key = f"{function}-{nodes}" if function else f"start-{nodes}"
    return Experiment(key, nodes, lambda mesh, u, order: Unchanged(mesh), "the start mesh", function)


@dataclass(frozen=True)
class Swap:
    """The operation of edge swapping, with its criterion, norm and limit on angles as attributes."""

    criterion: str
    norm: int
    min_angle: float | None = None

    def __call__(self, mesh: Mesh, u: Function, order: np.ndarray) -> Swapping:
        """Swap edges in the given order."""
        return swapped(mesh, u, self.criterion, norm=self.norm, order=order, min_angle=self.min_angle)

    def prepared(self, mesh: Mesh, values: np.ndarray, tolerance: float | None = None) -> Procedure:
        """The procedure on these nodal values, which can be run with any edge order."""
        return prepared(mesh, values, self.criterion, self.norm, self.min_angle, None, tolerance)

    @property
    def title(self) -> str:
        """Criterion and norm as they are written, for example ``"JND-L2"``."""
        return f"{self.criterion.upper()}-L{self.norm}"


def _swap(key: str, function: str, nodes: str, swap: Swap, recipe: str, **flags: bool) -> Experiment:
    return Experiment(key, nodes, swap, f"{swap.title}, {recipe}", function, **flags)


def _refine(key: str, nodes: str, mark: str, recipe: str, ties: str = "first") -> Experiment:
    def operate(mesh: Mesh, u: Function, order: np.ndarray) -> Refinement:
        by_order = order if mark == "edge" else None
        return refined(mesh, u, "abn", fraction=SHARE, mark=mark, split="centroid", ties=ties, order=by_order)

    return Experiment(key, nodes, operate, recipe, "SR1")


def _certified(
    key: str, function: str, nodes: str, criterion: str, norm: int, shuffled: bool = False
) -> Experiment:
    recipe = f"order, perturbation and tolerance of certificates/{key}.json"
    return _swap(key, function, nodes, Swap(criterion, norm), recipe, certified=True, shuffled=shuffled)


EXPERIMENTS = {
    e.key: e
    for e in (
        *(_start(nodes) for nodes in ("81", "33", "33-refined")),
        *(_start("81", f) for f in ("SR1", "SR2", "SR3")),
        *(_start("33", f) for f in ("SR1", "SR2")),
        _start("33-refined", "DD1"),
        _certified("SR2-81-JND-L2", "SR2", "81", "jnd", 2),
        _certified("SR3-81-JND-L2", "SR3", "81", "jnd", 2),
        _certified("SR1-33-ABN-L2", "SR1", "33", "abn", 2),
        _certified("SR1-33-ABN-L1", "SR1", "33", "abn", 1),
        _certified("SR2-33-ABN-L1", "SR2", "33", "abn", 1),
        _certified("DD1-33-refined-ABN-L2", "DD1", "33-refined", "abn", 2),
        _certified("DD1-33-refined-reordered", "DD1", "33-refined", "abn", 2, shuffled=True),
        _swap(
            "SR3-81-8-degrees",
            "SR3",
            "81",
            Swap("abn", 2, SMALLEST_ANGLE),
            f"{NATURAL}, no new angle below 8 degrees",
        ),
        _refine("SR1-81-by-edge", "81", "edge", "elements at the worst edges until 20 % are marked"),
        _refine("SR1-33-by-edge", "33", "edge", "elements at the worst edges until 20 % are marked"),
        _refine("SR1-81-by-element", "81", "element", "worst 20 % by mean of edge costs"),
        _refine(
            "SR1-33-by-element",
            "33",
            "element",
            "worst 20 % by mean of edge costs, and the tie with the last",
            "all",
        ),
        _refine("SR1-33-density", "33", "density", "worst 20 % by sum of edge costs per area"),
        Experiment("smoothed-33", "33", lambda mesh, u, order: smoothed(mesh), "Laplacian smoothing"),
    )
}


@cache
def run(key: str) -> Result:
    """Carry out an experiment by its key.

    Parameters
    ----------
    key : str
        One of `EXPERIMENTS`.

    Returns
    -------
    Result

    Raises
    ------
    MeshError
        If there is no such experiment.

    Examples
    --------
    >>> round(run("SR3-81-8-degrees").measures["l2_error", ""], 5)
    0.05503
    """
    experiment = EXPERIMENTS[choice(key, tuple(EXPERIMENTS), "experiment")]
    start = problems.mesh(experiment.nodes)
    if experiment.certified and key in certificates.names():
        record = certificates.load(key).swapped()
        return Result(experiment, start, record.mesh, record, CERTIFIED)
    kind = MISSING if experiment.certified else DETERMINISTIC
    return Result(experiment, start, *_natural(experiment, start), kind)


@cache
def natural(key: str) -> Result | None:
    """Carry out an experiment in the natural order of the edges, on unperturbed data.

    None if `run` does just that, or if the thesis shuffled the edges.
    """
    experiment = EXPERIMENTS[choice(key, tuple(EXPERIMENTS), "experiment")]
    if not experiment.certified or experiment.shuffled:
        return None
    plain = replace(experiment, certified=False, recipe=f"{experiment.operate.title}, {NATURAL}")
    start = problems.mesh(experiment.nodes)
    return Result(plain, start, *_natural(plain, start), DETERMINISTIC)


def _natural(experiment: Experiment, start: Mesh) -> tuple[Mesh, Any]:
    """Mesh and record of an experiment in the natural order of the edges."""
    u = problems.functions.get(experiment.function)
    record = experiment.operate(start, u, problems.order(experiment.nodes))
    return record.mesh, record
