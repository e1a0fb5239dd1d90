"""What kernels are handed together: named groups of flat arrays and of numbers.

A flat array is an array of one dimension for compiled kernels, and a list for plain ones.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = "NDArray[np.float64] | list[float]"
Ints: TypeAlias = "NDArray[np.integer[Any]] | list[int]"

Point: TypeAlias = tuple[float, float, float]  # x, y, u
Vector: TypeAlias = tuple[float, float]
Corners: TypeAlias = tuple[int, int, int]  # nodes of an element
Quad: TypeAlias = tuple[int, int, int, int]  # nodes a, b, c, d of the drawing in `lop`
Face: TypeAlias = tuple[float, float, float]  # gradient of u over an element, and its doubled area
Five: TypeAlias = tuple[float, float, float, float, float]  # costs of the edges a-b, b-c, c-a, a-d, d-b
UserCost: TypeAlias = Callable[[Point, Point, Point, Point], float]  # see `user_costs`


class Rules(NamedTuple):
    """When an edge is swapped."""

    code: int  # criterion, see `codes`
    norm: int  # see `codes`
    relative: float  # gain below which no swap is made, as a fraction of the local cost
    absolute: float  # gain below which no swap is made, in the unit of the costs
    min_angle: float  # smallest angle that a swap may create, in radians
    min_area: float  # smallest doubled area that a swap may create


class State(NamedTuple):
    """A mesh in the middle of the procedure; all but ``point`` is changed by kernels."""

    point: Floats  # (3 N,) x, y, u of each node
    element: Ints  # (3 T,) nodes of each element
    twin: Ints  # (3 T,) the other side of each half-edge, or -1
    slot: Ints  # (3 T,) edge of each half-edge
    half: Ints  # (E,) one half-edge of each edge
    face: Floats  # (3 T,) gradient and doubled area of each element
    cost: Floats  # (E,) cost of each edge; not used by criteria on elements
    settled: Ints  # (E,) what the last inspection of each edge found, or UNKNOWN if it may be outdated


class Log(NamedTuple):
    """Room to record swaps that are tried, a row for each; nothing is recorded if it has none."""

    tried: Ints  # (6 rows,) edge, nodes a, b, c, d, whether accepted
    costs: Floats  # (2 rows,) local cost before and after
