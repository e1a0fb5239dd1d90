"""Names for the types that signatures share."""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray: TypeAlias = NDArray[np.float64]
IntArray: TypeAlias = NDArray[np.integer[Any]]
BoolArray: TypeAlias = NDArray[np.bool_]
Function: TypeAlias = Callable[..., Any]  # a vectorised u(x, y)
Values: TypeAlias = ArrayLike | Function  # nodal values, or the function that has them
Norm: TypeAlias = int | float | str  # 1, 2, inf, "L1", "L2", "max" or "lexicographic"

__all__ = ["ArrayLike", "BoolArray", "FloatArray", "Function", "IntArray", "NDArray", "Norm", "Values"]
