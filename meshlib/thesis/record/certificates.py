"""Certificates: data with which Algorithm 3.1.4 of the thesis gives all numbers of a table column.

A certificate is a file of plain data that any program can check: start mesh, function,
criterion and norm, the edges in the order of inspection, the gain below which no swap is
made, a perturbation of nodal values, and the elements that come out.
"""

import dataclasses
import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from typing import Any

import numpy as np

from ... import Mesh, criteria, problems, swapped
from ...mesh.topology import canonical
from ...swapping.swapped import Swapping

FOLDER = files(__package__) / "certificates"
LARGEST_PERTURBATION = 1e-8  # bound on what may be added to a nodal value
ULP_TRIALS = 8  # runs in which every nodal value is moved by its last bit


@dataclass(frozen=True)
class Certificate:
    """An edge order and a perturbation that give one column of a table.

    Attributes
    ----------
    found_by : str
        The command that finds the certificate again from nothing.
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
        Nodes of the start mesh.
    elements : (T, 3) ndarray of int64
        Elements of the start mesh.
    edges : (E, 2) ndarray of int64
        Edges of the start mesh, in the order of inspection.
    result : (T, 3) ndarray of int64
        Elements after the procedure, smallest node first, in lexicographic order.
    """

    found_by: str
    start: str
    function: str
    criterion: str
    norm: int
    tolerance: float
    perturbation: dict[int, float]
    nodes: np.ndarray
    elements: np.ndarray
    edges: np.ndarray
    result: np.ndarray

    @cached_property
    def mesh(self) -> Mesh:
        """The start mesh."""
        return Mesh(self.nodes, self.elements)

    @property
    def order(self) -> np.ndarray:
        """Edge numbers of the start mesh in the order of inspection."""
        return self.mesh.edge_numbers(self.edges)

    @property
    def values(self) -> np.ndarray:
        """(N,) float64: the perturbed nodal values."""
        values = problems.functions[self.function](*self.nodes.T)
        values[list(self.perturbation)] += list(self.perturbation.values())
        return values

    def swapped(self, independent: bool = False, values: np.ndarray | None = None) -> Swapping:
        """The record of the procedure; ``independent``: of the one in plain Python, not the compiled one."""
        criterion = criteria.get(self.criterion)
        if independent:
            criterion = dataclasses.replace(criterion, code=-1)
        values = self.values if values is None else values
        return swapped(
            self.mesh, values, criterion, norm=self.norm, order=self.order, min_gain=self.tolerance
        )

    def faults(self) -> list[str]:
        """What is wrong with the certificate, a sentence for each fault; an empty list if it holds.

        Checked are the size of the perturbation, the start mesh, the order, and the result:
        by both procedures, and with every nodal value moved by its last bit.
        """
        found = []
        if not all(abs(v) < LARGEST_PERTURBATION for v in self.perturbation.values()):  # also if one is NaN
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

    def _trials(self) -> Iterator[tuple[str, np.ndarray, bool]]:
        yield "the procedure", self.values, False
        yield "the independent procedure", self.values, True
        for seed in range(ULP_TRIALS):
            up = np.random.default_rng(seed).choice([-np.inf, np.inf], len(self.nodes))
            yield f"the procedure with last bits moved (seed {seed})", np.nextafter(self.values, up), False

    def _ends_well(self, values: np.ndarray, independent: bool) -> bool:
        return np.array_equal(canonical(self.swapped(independent, values).mesh.elements), self.result)

    def to_json(self) -> str:
        """The data as JSON text, one entry a line."""
        data = {f.name: getattr(self, f.name) for f in dataclasses.fields(self)}
        lines = (f" {json.dumps(name)}: {json.dumps(_plain(value))}" for name, value in data.items())
        return "{\n" + ",\n".join(lines) + "\n}\n"


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else value


def from_json(text: str) -> Certificate:
    """The certificate in a JSON text."""
    data = json.loads(text)
    for name in ("nodes", "elements", "edges", "result"):
        data[name] = np.array(data[name])
    data["perturbation"] = {int(n): v for n, v in data["perturbation"].items()}
    return Certificate(**data)


@cache
def load(name: str) -> Certificate:
    """A certificate of this report by its name, which is the key of its experiment."""
    return from_json((FOLDER / f"{name}.json").read_text())


def names() -> list[str]:
    """Names of all stored certificates."""
    return sorted(f.name.removesuffix(".json") for f in FOLDER.iterdir() if f.name.endswith(".json"))
