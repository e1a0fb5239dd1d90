"""A mesh in the making: what operations replace, and the error of each element."""

from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from .._typing import BoolArray, FloatArray, IntArray
from ..mesh.boundary_sides import Sides, sides_of
from ..mesh.mesh import Mesh
from ..mesh.topology import around_nodes, grouped
from ..support.independent import coarse
from .error_integrals import Misfit
from .settings import Settings


@dataclass(frozen=True, eq=False)
class Draft:
    """A mesh with the error of each element, and which elements are new.

    A draft never changes, and its arrays are read-only: every operation of the package returns
    another one. So the best of several drafts is kept as it is, and nothing has to be restored.

    Parameters
    ----------
    misfit : Misfit
    norm : {"L2", "max"}
        Norm of the error.
    settings : Settings
    mesh : Mesh
    values : (N,) ndarray of float
        The function at the nodes, in the misfit's unit.
    side : (N,) ndarray of int
        Number of the straight side of the domain on which a node lies; INTERIOR or CORNER.
    boundary : Sides
    errors : (T,) ndarray of float
        Integral of the squared error, or of a higher power, over each element. Those that
        are not a number are computed.
    fresh : (T,) ndarray of bool
        Whether an element has changed since its edges were last considered.
    """

    misfit: Misfit
    norm: str
    settings: Settings
    mesh: Mesh
    values: FloatArray
    side: IntArray
    boundary: Sides
    errors: FloatArray
    fresh: BoolArray

    def __post_init__(self) -> None:
        unknown = np.flatnonzero(np.isnan(self.errors))
        if len(unknown):
            self.errors[unknown] = self.error_of(self.elements[unknown], is_new=False)
        for array in (self.values, self.side, self.errors, self.fresh):
            array.flags.writeable = False

    @classmethod
    def of(cls, misfit: Misfit, mesh: Mesh, norm: str = "L2", settings: Settings | None = None) -> Self:
        """The draft of a mesh."""
        mesh, boundary = Mesh._trusted(mesh.nodes, mesh.elements), sides_of(mesh)
        values = np.array(misfit.values(*(np.ascontiguousarray(v) for v in mesh.nodes.T)))
        unknown, fresh = np.full(mesh.n_elements, np.nan), np.ones(mesh.n_elements, dtype=bool)
        return cls(
            misfit, norm, settings or Settings(), mesh, values, boundary.of_node, boundary, unknown, fresh
        )

    def changed(self, nodes: FloatArray, elements: IntArray, **arrays: Any) -> Self:
        """The draft with another mesh, and other arrays given by name."""
        return replace(self, mesh=Mesh._trusted(nodes, elements), **arrays)

    @property
    def nodes(self) -> FloatArray:
        """(N, 2): coordinates of the nodes."""
        return self.mesh.nodes

    @property
    def elements(self) -> IntArray:
        """(T, 3): node numbers of the elements."""
        return self.mesh.elements

    @property
    def n_nodes(self):
        """Number of nodes."""
        return len(self.nodes)

    @property
    def n_elements(self) -> int:
        """Number of elements."""
        return len(self.elements)

    @property
    def error(self):
        """The norm of the error."""
        if self.norm == "max":
            return float(self._largest * self.misfit.unit)
        return float(np.sqrt(self.errors.sum())) * self.misfit.unit

    @property
    def objective(self):
        """What is being lowered: the integral of the squared error, or the largest error."""
        return self.errors.sum() if self.misfit.squarings == 1 else self.error

    @property
    def _largest(self):
        return self.misfit.largest(self.nodes[self.elements], self.values[self.elements])

    def measured(self, squarings: int) -> Self:
        """The draft with integrals of the power 2 ** squarings of the error, in units near its largest."""
        unit = 2.0 ** np.round(np.log2(largest)) if (largest := self._largest) > 0 else 1.0
        misfit = replace(self.misfit, squarings=squarings, unit=self.misfit.unit * unit)
        return self._measured_by(misfit, self.values / unit)

    def measured_finely(self, times: float) -> Self:
        """The draft with integrals by a quadrature whose spacing is divided by a factor."""
        return self._measured_by(replace(self.misfit, spacing=self.misfit.spacing / times), self.values)

    def _measured_by(self, misfit: Misfit, values: FloatArray) -> Self:
        unknown, fresh = np.full(self.n_elements, np.nan), np.ones(self.n_elements, dtype=bool)
        return replace(self, misfit=misfit, values=values, errors=unknown, fresh=fresh)

    @property
    def little(self):
        """An error so small that what is left of it is rounding, or not worth a change."""
        return self.settings.objective.negligible * self.errors.mean()

    @property
    def weight(self):
        """What a unit of the squared error along the boundary counts as."""
        return self.settings.objective.boundary_share * np.sqrt(self.mesh.domain_area / self.n_nodes)

    def error_of(self, elements, is_new=True):
        """Integral of the squared error over elements given by node numbers, (m, 3)."""
        return self.misfit.on_elements(self.nodes[elements], self.values[elements], is_new)

    def edge_error_of(self, pairs):
        """Weighted integral of the squared error along edges given by node numbers, (m, 2)."""
        return self.weight * self.misfit.on_edges(self.nodes[pairs], self.values[pairs])

    def bends_of(self, pairs):
        """How far the function bends between two nodes: the sum at both less twice that in the middle."""
        middle = self.nodes[pairs].mean(axis=1)
        return self.values[pairs].sum(axis=1) - 2 * self.misfit.values(*middle.T.copy())

    def patch_sums(self, of_elements):
        """For each node the sum over the elements around it."""
        return np.bincount(self.elements.ravel(), np.repeat(of_elements, 3), self.n_nodes)

    def edge_errors(self):
        """(T,): weighted error along the boundary edges of each element."""
        found = np.zeros(len(self.elements))
        boundary = np.flatnonzero(self.mesh.boundary)
        np.add.at(found, self.mesh.edge_elements[boundary, 0], self.edge_error_of(self.mesh.edges[boundary]))
        return found

    def worst(self, most, share):
        """The elements of largest error, at most a given number, down to a share of the largest."""
        error = coarse(self.errors + self.edge_errors())
        order = np.argsort(-error, kind="stable")[:most]
        return order[error[order] >= share * error[order[0]]]

    def patches(self):
        """The elements around each node."""
        return Rows(*grouped(self.elements.ravel(), self.n_nodes))

    def neighbours(self):
        """The nodes joined to each node."""
        heads, _, starts = around_nodes(self.mesh.edges, self.n_nodes)
        return Rows(heads, starts)


class Rows:
    """Lists of numbers of different lengths, one after the other."""

    def __init__(self, numbers, starts):
        self.numbers, self.starts = numbers, starts

    def of(self, which):
        """Numbers in the lists of some, one list after the other, and for each the place in ``which``."""
        lengths = self.starts[which + 1] - self.starts[which]
        row = np.repeat(np.arange(len(which)), lengths)
        ahead = np.cumsum(lengths) - lengths
        return self.numbers[np.arange(len(row)) - ahead[row] + self.starts[which][row]], row
