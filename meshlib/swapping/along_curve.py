"""Nodes and elements along a space-filling curve, so that neighbours in the plane are near in memory."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ..errors import MeshError, not_a_cost
from ..geometry import morton
from ..kernels import for_work
from ..mesh.mesh import Mesh
from .procedure import Procedure

SIDE = 256  # cells along each axis, whose 16 bits are sorted in linear time


@dataclass(frozen=True)
class Renumbered:
    """A mesh with its nodes and elements along Morton's curve, and the way back.

    Attributes
    ----------
    mesh : Mesh
    nodes : (N,) ndarray of int
        Number in the mesh given of each node.
    elements : (T,) ndarray of int
        Number in the mesh given of each element.
    """

    mesh: Mesh
    nodes: np.ndarray
    elements: np.ndarray

    def restored(self, elements):
        """Elements in the numbering and the rows of the mesh given."""
        return _renamed("scattered", elements, self.elements, self.nodes)


def along_curve(mesh):
    """Renumber a mesh along Morton's curve through its bounding box.

    Examples
    --------
    >>> from meshlib import problems
    >>> start = problems.mesh("33")
    >>> found = along_curve(start)
    >>> bool((found.restored(found.mesh.elements) == start.elements).all())
    True
    """
    place = _places(mesh)
    nodes = np.argsort(place, kind="stable")
    elements = np.argsort(place[mesh.elements[:, 0]], kind="stable")
    number = np.empty(mesh.n_nodes, dtype=np.int32)
    number[nodes] = np.arange(mesh.n_nodes, dtype=np.int32)
    rows = _renamed("gathered", mesh.elements, elements, number)
    return Renumbered(Mesh._trusted(np.take(mesh.nodes, nodes, axis=0), rows), nodes, elements)


def _renamed(kernel, elements, row, number):
    """Elements in other rows, with other numbers for their nodes, by the kernel of that name."""
    kernels = for_work(elements.size)
    found = kernels.writable(np.empty(elements.size, dtype=np.int32))
    getattr(kernels.half_edges, kernel)(*map(kernels.readable, (elements, row, number)), found)
    return np.asarray(found, dtype=np.int32).reshape(-1, 3)


def _places(mesh):
    """The cell of each node, counted along the curve."""
    column, row = (
        ((v - low) * (SIDE / (high - low))).astype(np.int16).clip(max=SIDE - 1)
        for v, low, high in zip(mesh.nodes.T, *mesh.box, strict=True)
    )
    return morton.places(column, row).astype(np.uint16)


@dataclass(frozen=True)
class AlongCurve:
    """A procedure that runs on the mesh along the curve; what it returns is in the numbering given."""

    given: Procedure

    @cached_property
    def _curve(self):
        return along_curve(self.given.mesh)

    @cached_property
    def _procedure(self):
        return replace(
            self.given, mesh=self._curve.mesh, values=self.given.values[self._curve.nodes], once=True
        )

    def run(self, order, trace=False, schedule="queue", watch=None):
        """As `Procedure.run`, with the edges in their order along the curve and not in the given one."""
        edges = np.arange(self._curve.mesh.n_edges, dtype=np.int32)
        done = self._run(edges, trace, schedule, watch)
        return replace(done, elements=self._curve.restored(done.elements), trace=self._restored(done.trace))

    def _run(self, *arguments):
        try:
            return self._procedure.run(*arguments)
        except MeshError as error:  # a bad cost, around an edge of the renumbered mesh
            raise not_a_cost(*sorted(self._curve.nodes[list(error.items)].tolist())) from None

    def _restored(self, trace):
        nodes, found = self._curve.nodes, trace.copy()
        for name in "abcd":
            found[name] = nodes[trace[name]]
        edges = self._curve.mesh.edges[trace["edge"]]
        found["edge"] = self.given.mesh.edge_numbers(nodes[edges]) if len(trace) else 0
        return found
