"""The experiments of chapters 5 and 6: what each computes, and by which recipe.

An experiment is a start mesh, a function and an operation.  Most are deterministic;
those whose printed numbers depend on the edge order and on rounding noise read both
from a certificate, a file of explicit data.
"""
import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files

import numpy as np

from .. import Interpolant, Mesh, problems, quality, refined, smoothed, swapped
from ..checks import choice

GRID_POINTS = 101  # the tables match this grid, not the 200 x 200 of section 4.5.1
SHARE = 0.2
SMALLEST_ANGLE = 8.0

DETERMINISTIC, CERTIFIED, SEARCHED = "deterministic", "certificate", "none"


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
        In one line, for people.
    function : str
        Name of u in `meshlib.problems`, empty where none is needed.
    certificate : str
        File in ``meshlib/thesis/certificates``, empty if deterministic.
    """

    key: str
    nodes: str
    operate: Callable
    recipe: str
    function: str = ""
    certificate: str = ""


@dataclass(frozen=True)
class Result:
    """An experiment carried out.

    Attributes
    ----------
    experiment : Experiment
    start, mesh : Mesh
        Before and after.
    record : object
        What the operation returned.
    kind : {"deterministic", "certificate", "none"}
        ``"none"`` if the certificate is not known: the canonical order stands in.
    """

    experiment: Experiment
    start: Mesh
    mesh: Mesh
    record: object
    kind: str

    @property
    def function(self):
        """The test function u, or None."""
        return problems.functions.get(self.experiment.function)

    @cached_property
    def measures(self):
        """Every number the tables print: (measure, statistic) -> value."""
        found, mean, largest = {}, self.quality.mean, self.quality.max
        for name in mean:
            found[name, "mean"], found[name, "max"] = mean[name], largest[name]
        if self.function:
            found["l2_error", ""] = self.interpolant.l2_error(self.function, points=GRID_POINTS)
        return found

    @cached_property
    def quality(self):
        """Geometric quality of the mesh."""
        return quality(self.mesh)

    @cached_property
    def interpolant(self):
        """Interpolant of u on the mesh."""
        return Interpolant(self.mesh, self.function)

    @cached_property
    def start_interpolant(self):
        """Interpolant of u on the start mesh."""
        return Interpolant(self.start, self.function)


@dataclass(frozen=True)
class Unchanged:
    """The record of doing nothing."""

    mesh: Mesh


def _start(nodes, function=""):
    key = f"{function}-{nodes}" if function else f"start-{nodes}"
    return Experiment(key, nodes, lambda mesh, u, order: Unchanged(mesh), "the start mesh", function)


def _swap(key, function, nodes, criterion, norm, min_angle=None, certificate="", recipe="canonical order"):
    def operate(mesh, u, order, tolerance=None):
        return swapped(mesh, u, criterion, norm, order, min_angle, tolerance=tolerance)
    return Experiment(key, nodes, operate, f"{criterion.upper()}-L{norm}, {recipe}", function, certificate)


def _refine(key, nodes, mark, recipe, ties="first"):
    def operate(mesh, u, order):
        order = order if mark == "edge" else None
        return refined(mesh, u, "abn", SHARE, mark, "centroid", ties, order)
    return Experiment(key, nodes, operate, recipe, "SR1")


def _certified(key, function, nodes, criterion, norm):
    return _swap(key, function, nodes, criterion, norm, certificate=f"{key}.json",
                 recipe="order and perturbation of a certificate")


EXPERIMENTS = {e.key: e for e in (
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
    _certified("DD1-33-refined-reordered", "DD1", "33-refined", "abn", 2),
    _swap("SR3-81-8-degrees", "SR3", "81", "abn", 2, SMALLEST_ANGLE,
          recipe="canonical order, no new angle below 8 degrees"),
    _refine("SR1-81-by-edge", "81", "edge", "elements at the worst edges until 20 % are marked"),
    _refine("SR1-33-by-edge", "33", "edge", "elements at the worst edges until 20 % are marked"),
    _refine("SR1-81-by-element", "81", "element", "worst 20 % by mean of edge costs"),
    _refine("SR1-33-by-element", "33", "element",
            "worst 20 % by mean of edge costs, and the tie with the last", "all"),
    _refine("SR1-33-density", "33", "density", "worst 20 % by sum of edge costs per area"),
    Experiment("smoothed-33", "33", lambda mesh, u, order: smoothed(mesh), "Laplacian smoothing"),
)}


@cache
def run(key):
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
    u, extra, kind = problems.functions.get(experiment.function), {}, DETERMINISTIC
    order = problems.order(experiment.nodes)
    if experiment.certificate:
        data = certificate(experiment.certificate)
        kind = CERTIFIED if data else SEARCHED
        order, u, extra = _as_certified(start, u, order, data) if data else (order, u, {})
    record = experiment.operate(start, u, order, **extra)
    return Result(experiment, start, record.mesh, record, kind)


@cache
def certificate(name):
    """The data of a certificate, or None if there is no such file."""
    file = files(__package__) / "certificates" / name
    return json.loads(file.read_text()) if file.is_file() else None


def _as_certified(start, u, order, data):
    """Edge order, perturbed nodal values and tolerance of a certificate."""
    values = u(*start.nodes.T)
    values[data["nodes"]] += np.array(data["perturbation"])
    return np.array(data["order"]), values, {"tolerance": data["tolerance"]}
