"""Names for the types that signatures share."""

from collections.abc import Callable
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.integer[Any]]
BoolArray: TypeAlias = NDArray[np.bool_]
Function: TypeAlias = Callable[..., Any]  # a vectorised u(x, y)
Values: TypeAlias = ArrayLike | Function  # nodal values, or the function that has them
Norm: TypeAlias = int | float | str  # 1, 2, inf, "L1", "L2", "max" or "lexicographic"


class AnyMesh(Protocol):
    """What the modules below `meshlib.mesh.mesh` ask of a mesh; see `meshlib.Mesh` for the shapes."""

    @property
    def nodes(self) -> FloatArray: ...
    @property
    def elements(self) -> IntArray: ...
    @property
    def green(self) -> IntArray: ...
    @property
    def n_nodes(self) -> int: ...
    @property
    def n_elements(self) -> int: ...
    @property
    def edges(self) -> IntArray: ...
    @property
    def element_edges(self) -> IntArray: ...
    @property
    def edge_elements(self) -> IntArray: ...
    @property
    def neighbours(self) -> IntArray: ...
    @property
    def boundary(self) -> BoolArray: ...
    @property
    def boundary_nodes(self) -> BoolArray: ...
    @property
    def corners(self) -> FloatArray: ...


__all__ = [
    "AnyMesh",
    "ArrayLike",
    "BoolArray",
    "FloatArray",
    "Function",
    "IntArray",
    "NDArray",
    "Norm",
    "Values",
]
