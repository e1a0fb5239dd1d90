"""Certificates: the data with which Algorithm 3.1.4 gives all numbers of a table column.

A certificate is a file of plain data that any program can check: start mesh, function,
criterion and norm, the edges in the order of inspection, the gain below which no swap is
made, a perturbation of nodal values, and the elements that come out.
"""

import dataclasses
import json
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files

import numpy as np

from ... import Mesh, criteria, problems, swapped
from ...mesh.topology import canonical

FOLDER = files(__package__) / "certificates"
LARGEST_PERTURBATION = 1e-8
ULP_TRIALS = 8  # nodal values are moved by their last bit so many times


@dataclass(frozen=True)
class Certificate:
    """How one column of a table is reached.

    Attributes
    ----------
    found_by : str
        The command that finds it again from nothing.
    start : str
        Name of the start mesh in `meshlib.problems`.
    function, criterion : str
        Names of u in `meshlib.problems` and of the criterion of the caption.
    norm : {1, 2}
    tolerance : float
        Gain in the norm of the local cost below which no swap is made.
    perturbation : dict
        Node number -> what is added to u there.
    nodes : (N, 2) ndarray of float64
    elements : (T, 3) ndarray of int64
        Of the start mesh.
    edges : (E, 2) ndarray of int64
        Of the start mesh, in the order of inspection.
    result : (T, 3) ndarray of int64
        Elements after the procedure, smallest node first, in lexicographic order.
    """

    found_by: str
    start: str
    function: str
    criterion: str
    norm: int
    tolerance: float
    perturbation: dict
    nodes: np.ndarray
    elements: np.ndarray
    edges: np.ndarray
    result: np.ndarray

    @cached_property
    def mesh(self):
        """The start mesh."""
        return Mesh(self.nodes, self.elements)

    @property
    def order(self):
        """Edge numbers of the start mesh in the order of inspection."""
        return self.mesh.edge_numbers(self.edges)

    @property
    def values(self):
        """Perturbed nodal values."""
        values = problems.functions[self.function](*self.nodes.T)
        values[list(self.perturbation)] += list(self.perturbation.values())
        return values

    def swapped(self, independent=False, values=None):
        """The record of the procedure; ``independent``: by the slow reference procedure."""
        criterion = criteria.get(self.criterion)
        if independent:
            criterion = dataclasses.replace(criterion, code=-1)
        values = self.values if values is None else values
        return swapped(
            self.mesh, values, criterion, norm=self.norm, order=self.order, min_gain=self.tolerance
        )

    def faults(self):
        """What is wrong with it, each fault a sentence; an empty list if nothing is.

        Checked are the size of the perturbation, the order, the start mesh, and the
        result: by both procedures, and with every nodal value moved by its last bit.
        """
        found = []
        if not all(abs(v) < LARGEST_PERTURBATION for v in self.perturbation.values()):  # nor NaN
            found.append(f"a perturbation reaches {LARGEST_PERTURBATION:g}")
        if not self.mesh.equals(problems.mesh(self.start)):
            return [*found, f"the start mesh is not that of {self.start!r}"]
        if sorted(map(sorted, self.edges.tolist())) != self.mesh.edges.tolist():
            return [*found, "the edges are not those of the start mesh, each once"]
        return found + [
            f"{how} ends in another mesh"
            for how, values, independent in self._trials()
            if not self._ends_well(values, independent)
        ]

    def _trials(self):
        yield "the procedure", self.values, False
        yield "the independent procedure", self.values, True
        for seed in range(ULP_TRIALS):
            up = np.random.default_rng(seed).choice([-np.inf, np.inf], len(self.nodes))
            yield f"the procedure with last bits moved (seed {seed})", np.nextafter(self.values, up), False

    def _ends_well(self, values, independent):
        return np.array_equal(canonical(self.swapped(independent, values).mesh.elements), self.result)

    def to_json(self):
        """The data as JSON text, an entry on each line."""
        data = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        lines = (f" {json.dumps(name)}: {json.dumps(_plain(value))}" for name, value in data.items())
        return "{\n" + ",\n".join(lines) + "\n}\n"


def _plain(value):
    return value.tolist() if isinstance(value, np.ndarray) else value


def from_json(text):
    """The certificate in a JSON text."""
    data = json.loads(text)
    for name in ("nodes", "elements", "edges", "result"):
        data[name] = np.array(data[name])
    data["perturbation"] = {int(n): v for n, v in data["perturbation"].items()}
    return Certificate(**data)


@cache
def load(name):
    """A certificate of this report by its name, or None if there is no such file."""
    file = FOLDER / f"{name}.json"
    return from_json(file.read_text()) if file.is_file() else None


def names():
    """Names of all stored certificates."""
    return sorted(f.name.removesuffix(".json") for f in FOLDER.iterdir() if f.name.endswith(".json"))
