"""Draw the picture that opens the README: ``python book/picture.py``.

The same 600 scattered points twice: their Delaunay mesh, and the mesh after edge
swapping; over each the lines of constant value of the linear interpolant.
"""
from pathlib import Path

import numpy as np

import meshlib as ml
from meshlib import plotting

TARGET = Path(__file__).parent / "_static" / "scattered.png"
POINTS, SEED, DOTS_PER_INCH, PANEL, LINE = 300, 7, 110, 4.4, 0.5


def height(x, y):
    """A steep ring around a dip."""
    r = np.hypot(x - 0.5, y - 0.5)
    return np.tanh(18 * (r - 0.3)) + 0.4 * x


def draw():
    """The figure: a panel for each mesh, with the lines of constant value over it."""
    corners = [[0, 0], [1, 0], [1, 1], [0, 1]]
    points = np.vstack([corners, np.random.default_rng(SEED).random((POINTS, 2))])
    start = ml.delaunay(points)
    figure, axes = plotting.panels(2, size=PANEL)
    for ax, name, mesh in zip(axes, ("Delaunay", "swapped with JND"),
                              (start, ml.swapped(start, height, "jnd").mesh), strict=True):
        u_h = ml.Interpolant(mesh, height)
        plotting.plot_contours(ax, u_h)
        plotting.plot_mesh(ax, mesh, width=LINE)
        error = u_h.l2_error(height, "exact")
        ax.set_title(f"{name}: $L_2$ error {error:.3f}")
    return figure


if __name__ == "__main__":
    draw().savefig(TARGET, dpi=DOTS_PER_INCH)
