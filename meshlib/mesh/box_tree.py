"""Which boxes with sides parallel to the axes touch, by a tree of bounding boxes.

Boxes that follow each other along Morton's curve lie near each other; each FAN of them
get a bounding box, and so do each FAN of those, up to a few at the top.
"""

from functools import reduce

import numpy as np

from ..geometry import morton

FAN = 4
TOP = 8  # boxes at most that get no bounding boxes
BITS = 31  # of each coordinate along the curve
FEW_ROWS, MANY_ROWS = 64, 65_536  # taken together: few at first, since the first find often ends the search
PAIRS_AT_ONCE = 2_000_000


class BoxTree:
    """A tree over boxes, each given by its lower left and upper right corner, (n, 2) arrays."""

    def __init__(self, low, high):
        self.items = np.argsort(_along_curve(low / 4 + high / 4))  # a fraction, so that nothing overflows
        level = [a[self.items].T.copy() for a in (low, high)]
        self.levels = [level]
        while level[0].shape[1] > TOP:
            starts = np.arange(0, level[0].shape[1], FAN)
            level = [
                end.reduceat(side, starts, axis=1)
                for end, side in zip((np.minimum, np.maximum), level, strict=True)
            ]
            self.levels.insert(0, level)

    def touching(self, low, high, misses=None):
        """Pairs (row, item) of a box low[row]..high[row] and one of the tree that touch, in batches.

        Rows ascend from batch to batch.  ``misses(rows, low, high)`` may tell that what is
        in the box of a row has no point in another box.
        """
        start, size = 0, FEW_ROWS
        while start < len(low):
            rows = np.arange(start, min(start + size, len(low)))
            found = self._descend(rows, low.T, high.T, misses)
            if found is None:
                size //= 2
                continue
            yield found
            start, size = start + size, min(2 * size, MANY_ROWS)

    def _descend(self, rows, low, high, misses):
        """The pairs of these rows, or None if there are too many on the way."""
        most = PAIRS_AT_ONCE if len(rows) > 1 else np.inf
        boxes = np.arange(self.levels[0][0].shape[1])
        rows, boxes = np.repeat(rows, len(boxes)), np.tile(boxes, len(rows))
        for depth, level in enumerate(self.levels):
            if depth:
                rows, boxes = _children(rows, boxes, level[0].shape[1])
            if len(rows) > most:
                return None
            rows, boxes = _touching(rows, boxes, low, high, *level)
            if misses:
                near = ~misses(rows, *(side.T[boxes] for side in level))
                rows, boxes = rows[near], boxes[near]
        return rows, self.items[boxes]


def _children(rows, boxes, n_boxes):
    """Each pair FAN times, with the boxes below."""
    boxes = (boxes[:, None] * FAN + np.arange(FAN)).ravel()
    there = boxes < n_boxes
    return np.repeat(rows, FAN)[there], boxes[there]


def _touching(rows, boxes, low, high, box_low, box_high):
    """Those pairs in which, in each axis, neither begins behind the end of the other."""
    for axis in (0, 1):
        near = (low[axis][rows] <= box_high[axis][boxes]) & (box_low[axis][boxes] <= high[axis][rows])
        rows, boxes = rows[near], boxes[near]
    return rows, boxes


def _along_curve(points):
    """Places along Morton's curve."""
    low, size = points.min(axis=0), np.ptp(points, axis=0)
    cells = (points - low) / np.where(size > 0, size, 1) * (2**BITS - 1)
    return morton.places(*cells.astype(np.int64).T, n_bytes=4)


def bounds(*points):
    """The smallest and the largest of several arrays, item by item: the corners of boxes around points."""
    return reduce(np.minimum, points), reduce(np.maximum, points)


def least(first, second):
    """The pair that comes first in lexicographic order."""
    k = np.lexsort((second, first))[0]
    return first[k], second[k]
