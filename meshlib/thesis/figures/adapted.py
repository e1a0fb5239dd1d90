"""What the figures of chapters 5 and 6 have in common: an adapted mesh below its start mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ... import plotting
from ..studies.experiments import Result, run

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DOUBLE = plotting.WIDTH / 2  # inches, the size of each of two panels
HEAVY, DOT = 1.6, 4.0  # points, width of edges and size of nodes that are set off


def started(key: str) -> Figure:
    """Mesh, surface and lines of constant value of an experiment that adapts nothing."""
    return plotting.representation(run(key).interpolant)


def swapped(key: str, label: str = "swapped") -> Figure:
    """Two rows; in the second the edges that the start mesh does not have are coloured."""
    found, figure, ax = compared(key, label)
    plotting.highlight_edges(ax, found.mesh, plotting.edges_not_in(found.mesh, found.start), width=HEAVY)
    return figure


def refined(key: str, label: str = "refined") -> Figure:
    """Two rows; in the second the elements that were split are shaded and the new nodes marked."""
    found, figure, ax = compared(key, label)
    plotting.shade_elements(ax, found.mesh, np.isin(found.record.parents, found.record.marked))
    new = np.arange(found.start.n_nodes, found.mesh.n_nodes)
    plotting.mark_nodes(ax, found.mesh, new, colour=plotting.ACCENT, size=DOT)
    return figure


def compared(key: str, label: str) -> tuple[Result, Figure, Axes]:
    """The result of an experiment, two rows for start and result, and the axes of the final mesh."""
    found = run(key)
    labels = ("start", label)
    figure = plotting.representation(found.interpolant, before=found.start_interpolant, labels=labels)
    return found, figure, figure.axes[-3]  # the first of the three in the last row
