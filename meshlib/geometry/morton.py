"""Morton's curve: through the quarters of a square one after the other, and of each likewise."""

import numpy as np

from .._typing import IntArray, NDArray

BYTE = 256  # number of values of a byte
SPREAD = np.array([int(f"{i:b}", 4) for i in range(BYTE)], dtype=np.uint64)  # bytes, a 0 before every bit


def places(column: IntArray, row: IntArray, n_bytes: int = 1) -> NDArray[np.uint64]:
    """Places of cells along the curve: the bits of column and row in turn.

    Parameters
    ----------
    column, row : (n,) ndarray of int
        At least 0 and below ``256 ** n_bytes``.
    n_bytes : int
        From 1 to 4.

    Returns
    -------
    (n,) ndarray of uint64

    Examples
    --------
    >>> places(np.array([0, 1, 0, 1, 2]), np.array([0, 0, 1, 1, 0])).tolist()
    [0, 1, 2, 3, 4]
    """
    return _spread(column, n_bytes) | _spread(row, n_bytes) << np.uint64(1)


def _spread(numbers: IntArray, n_bytes: int) -> NDArray[np.uint64]:
    found = SPREAD[numbers & (BYTE - 1)]
    for k in range(1, n_bytes):
        found |= SPREAD[numbers >> 8 * k & (BYTE - 1)] << np.uint64(16 * k)
    return found
