"""A mesh in the making: what operations replace, and the error of each element."""

from copy import copy
from dataclasses import replace

import numpy as np

from ..mesh.boundary_sides import sides_of
from ..mesh.mesh import Mesh
from ..mesh.topology import around_nodes, grouped
from ..support.independent import coarse
from .settings import Settings


class Draft:
    """Nodes, values and elements, the error of each element, and which elements are new.

    Operations of the package replace its arrays and end with `settle`.

    Attributes
    ----------
    nodes, values, elements : (N, 2), (N,), (T, 3) ndarray
        Values are counted in the misfit's unit.
    side : (N,) ndarray of int
        Number of the straight side of the domain on which a node lies; INTERIOR or CORNER.
    errors : (T,) ndarray of float
        Integral of the squared error, or of a higher power, over each element.
    fresh : (T,) ndarray of bool
        Whether an element has changed since its edges were last considered.
    misfit : Misfit
    norm : {"L2", "max"}
        Of the error.
    settings : Settings
    """

    def __init__(self, misfit, mesh, norm="L2", settings=None):
        self.norm, self.misfit, self.settings = norm, misfit, settings or Settings()
        self.begin(mesh)

    def begin(self, mesh):
        """Take over a mesh."""
        self.nodes, self.elements, self.boundary = mesh.nodes, mesh.elements, sides_of(mesh)
        self.side = self.boundary.of_node.copy()
        self.values = self.misfit.values(*(np.ascontiguousarray(v) for v in mesh.nodes.T))
        self.settle(np.full(mesh.n_elements, np.nan), np.ones(mesh.n_elements, dtype=bool))

    def settle(self, errors, fresh):
        """Take over new arrays; errors that are not a number are computed."""
        self.mesh = Mesh._trusted(self.nodes, self.elements)
        self.errors, self.fresh = errors, fresh
        unknown = np.flatnonzero(np.isnan(errors))
        self.errors[unknown] = self.error_of(self.elements[unknown], is_new=False)

    @property
    def n_nodes(self):
        """Number of nodes."""
        return len(self.nodes)

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

    def measure(self, squarings):
        """From now on integrate the power 2 ** squarings of the error, in units of about its largest."""
        unit = 2.0 ** np.round(np.log2(largest)) if (largest := self._largest) > 0 else 1.0
        self.values = self.values / unit
        self.misfit = replace(self.misfit, squarings=squarings, unit=self.misfit.unit * unit)
        self._settle_anew()

    def measure_finely(self, times):
        """From now on integrate by elements that are divided so many times as finely."""
        self.misfit = replace(self.misfit, spacing=self.misfit.spacing / times)
        self._settle_anew()

    def _settle_anew(self):
        self.settle(np.full(len(self.elements), np.nan), np.ones(len(self.elements), dtype=bool))

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
        """The elements of largest error, so many at most, down to a share of the largest."""
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


class Best:
    """The best of the states through which a draft goes: most nodes, then the smallest error.

    What counts is the error that is being lowered, be the norm what it may.
    """

    ARRAYS = "misfit", "nodes", "values", "elements", "side", "boundary", "errors", "fresh", "mesh"

    def __init__(self, draft):
        self.draft, self.rank, self.kept = draft, (np.inf, np.inf), None

    def offer(self):
        """Keep the present state if it is better."""
        rank = -self.draft.n_nodes, self.draft.objective
        if rank < self.rank:
            self.rank, self.kept = rank, {name: copy(getattr(self.draft, name)) for name in self.ARRAYS}

    def restore(self):
        """Go back to the best state."""
        for name, array in self.kept.items():
            setattr(self.draft, name, array)


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
