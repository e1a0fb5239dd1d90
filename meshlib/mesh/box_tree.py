"""Pairs of boxes that touch, found by a tree of bounding boxes; all sides are parallel to the axes.

The boxes are sorted along Morton's curve, so that boxes near each other in order are mostly
near each other in the plane.  Four boxes in order get a common bounding box, four of these
another one, and so on, until a few are left at the top of the tree.
"""

from collections.abc import Callable, Iterator
from functools import reduce
from typing import Any, TypeAlias

import numpy as np

from .._typing import BoolArray, FloatArray, IntArray, NDArray
from ..geometry import morton

Misses: TypeAlias = Callable[[IntArray, FloatArray, FloatArray], BoolArray]


class BoxTree:
    """A tree over boxes, each given by its lower left and upper right corner, (n, 2) arrays."""

    fan = 4  # number of boxes that have a common bounding box
    top = 8  # largest number of boxes at the top of the tree
    few_rows = 64  # number of rows in the first batch: a search often ends with the first find
    many_rows = 65_536  # largest number of rows in a batch
    pairs_at_once = 2_000_000  # largest number of pairs of a batch, to limit the memory

    def __init__(self, low: FloatArray, high: FloatArray) -> None:
        self.items = np.argsort(
            _along_curve(low / 4 + high / 4)
        )  # a half of the middle, so that nothing overflows
        level = [a[self.items].T.copy() for a in (low, high)]
        self.levels = [level]
        while level[0].shape[1] > self.top:
            starts = np.arange(0, level[0].shape[1], self.fan)
            level = [
                end.reduceat(side, starts, axis=1)
                for end, side in zip((np.minimum, np.maximum), level, strict=True)
            ]
            self.levels.insert(0, level)

    def touching(
        self, low: FloatArray, high: FloatArray, misses: Misses | None = None
    ) -> Iterator[tuple[IntArray, IntArray]]:
        """Rows of given boxes and items of the tree that touch, pair by pair, in batches.

        Rows ascend from batch to batch.  ``misses(rows, low, high)`` tells for pairs of a row
        and a box of the tree whether they need not be found, since what the box of the row
        encloses has no point in the other box.
        """
        start, size = 0, self.few_rows
        while start < len(low):
            rows = np.arange(start, min(start + size, len(low)))
            found = self._descend(rows, low.T, high.T, misses)
            if found is None:
                size //= 2
                continue
            yield found
            start, size = start + size, min(2 * size, self.many_rows)

    def _descend(
        self, rows: IntArray, low: FloatArray, high: FloatArray, misses: Misses | None
    ) -> tuple[IntArray, IntArray] | None:
        """Rows and items that touch, or None if more than ``pairs_at_once`` pairs come up on the way."""
        most = self.pairs_at_once if len(rows) > 1 else np.inf
        highest = np.arange(self.levels[0][0].shape[1])
        boxes: IntArray = np.tile(highest, len(rows))
        rows = np.repeat(rows, len(highest))
        for depth, level in enumerate(self.levels):
            if depth:
                rows, boxes = self._children(rows, boxes, level[0].shape[1])
            if len(rows) > most:
                return None
            rows, boxes = _touching(rows, boxes, low, high, *level)
            if misses:
                near = ~misses(rows, *(side.T[boxes] for side in level))
                rows, boxes = rows[near], boxes[near]
        return rows, self.items[boxes]

    def _children(self, rows: IntArray, boxes: IntArray, n_boxes: int) -> tuple[IntArray, IntArray]:
        """Pairs of a row and each box below its box, of the ``n_boxes`` on the next level."""
        boxes = (boxes[:, None] * self.fan + np.arange(self.fan)).ravel()
        there = boxes < n_boxes
        return np.repeat(rows, self.fan)[there], boxes[there]


def _touching(
    rows: IntArray,
    boxes: IntArray,
    low: FloatArray,
    high: FloatArray,
    box_low: FloatArray,
    box_high: FloatArray,
) -> tuple[IntArray, IntArray]:
    """The pairs in which neither box begins behind the end of the other, in x and in y."""
    for axis in (0, 1):
        near = (low[axis][rows] <= box_high[axis][boxes]) & (box_low[axis][boxes] <= high[axis][rows])
        rows, boxes = rows[near], boxes[near]
    return rows, boxes


def _along_curve(points: FloatArray, bits: int = 31) -> NDArray[np.uint64]:
    """Places of points along Morton's curve, with this number of bits for each coordinate."""
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    cells = (points - low) / np.where(size > 0, size, 1) * (2**bits - 1)
    column, row = cells.astype(np.int64).T
    return morton.places(column, row, n_bytes=4)


def bounds(*points: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Minimum and maximum of several arrays, item by item: the corners of boxes around points."""
    return reduce(np.minimum, points), reduce(np.maximum, points)


def least(first: IntArray, second: IntArray) -> tuple[int, int]:
    """Of the pairs of numbers the one that comes first in lexicographic order."""
    k = np.lexsort((second, first))[0]
    return int(first[k]), int(second[k])
