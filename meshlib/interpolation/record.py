"""The base of the results of all operations: a mesh and its nodal values."""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import ClassVar

import numpy as np

from .._typing import FloatArray
from ..errors import InvalidInputError
from ..mesh.mesh import Mesh
from .interpolant import Interpolant


@dataclass(frozen=True, repr=False, eq=False)
class Record:
    """The result of an operation.

    Attributes
    ----------
    mesh : Mesh
        The new mesh.
    values : (N,) ndarray of float64, or None
        Nodal values on the new mesh; None after nodes were moved without a function.

    Notes
    -----
    The record of an operation has further attributes: ``cost_before`` and ``cost_after``,
    the cost of the start mesh and of the new mesh in the measure that the operation lowers;
    ``history``, a structured array with a row for each step; and those special to it.
    All records can be pickled.

    See Also
    --------
    meshlib.swapped, meshlib.refined, meshlib.smoothed, meshlib.combined, meshlib.annealed,
    meshlib.optimal, meshlib.local_optima, meshlib.approximate
    """

    mesh: Mesh
    values: FloatArray | None
    _on_demand: ClassVar[tuple[str, ...]] = ()  # results that are computed when they are first asked for

    @cached_property
    def interpolant(self) -> Interpolant:
        """The piecewise linear function on the new mesh.

        Raises
        ------
        MeshError
            If the nodes were moved and no function gives the values there.
        """
        if self.values is None:
            raise InvalidInputError(
                "values",
                "nodes have moved, and no function gives the values there; "
                "make Interpolant(record.mesh, u) with a function u",
            )
        return Interpolant(self.mesh, self.values)

    def __getstate__(self) -> dict[str, object]:
        """All results, computed if they have not been; what computes them need not be picklable."""
        found = {name: getattr(self, name) for name in self._on_demand}
        hidden = {f.name for f in fields(self) if f.name.startswith("_")}
        return {name: value for name, value in vars(self).items() if name not in hidden} | found

    def __repr__(self) -> str:
        numbers = ((f.name, getattr(self, f.name)) for f in fields(self) if f.repr)
        shown = (f"{name}={value!r}" for name, value in numbers if not isinstance(value, (np.ndarray, tuple)))
        return f"{type(self).__name__}({', '.join(shown)})"
