"""Points and polygons; a polygon is given by its corners in order, (n, 2)."""

import numpy as np

from .._typing import BoolArray, FloatArray


def lattice_inside(ring: FloatArray, spacing: float, clearance: float = 0.6) -> FloatArray:
    """Nodes, (m, 2), of a lattice of equilateral triangles inside a polygon.

    Their distance to the polygon is above ``clearance`` spacings, so that no element between
    lattice and boundary is much smaller than those of the lattice.
    """
    low, high = ring.min(axis=0), ring.max(axis=0)
    steps = (high - low) / 2 / spacing / (1, np.sqrt(3) / 2)
    i, j = (np.arange(-n, n + 1) for n in np.ceil(steps).astype(int) + 1)
    x, y = np.meshgrid(i * spacing, j * spacing * np.sqrt(3) / 2)
    x[j % 2 == 1] += spacing / 2
    nodes = np.column_stack([x.ravel(), y.ravel()]) + (low + high) / 2
    nodes = nodes[inside(ring, nodes)]
    return nodes[distance(ring, nodes) > clearance * spacing]


def inside(ring: FloatArray, points: FloatArray) -> BoolArray:
    """Whether points, (m, 2), lie inside a polygon: a ray to the right crosses an odd number of edges."""
    (px, py), (qx, qy) = ring.T, np.roll(ring, -1, axis=0).T
    x, y = points[:, :1], points[:, 1:]
    spans = (py > y) != (qy > y)
    left = (px - x) * (qy - y) - (qx - x) * (py - y)
    return (spans & ((left > 0) == (qy > py))).sum(axis=1) % 2 == 1


def distance(ring: FloatArray, points: FloatArray) -> FloatArray:
    """Distance of points, (m, 2), to the nearest edge of a polygon, in the unit of the coordinates."""
    along = np.roll(ring, -1, axis=0) - ring
    away = points[:, None] - ring
    share = ((away * along).sum(axis=2) / (along**2).sum(axis=1)).clip(0, 1)
    return np.sqrt(((away - share[..., None] * along) ** 2).sum(axis=2)).min(axis=1)
