"""What the figures of chapters 5 and 6 have in common: an adapted mesh below its start."""

import numpy as np

from ... import plotting
from ..studies.experiments import run

DOUBLE = plotting.WIDTH / 2  # inches, of each of two panels
HEAVY, DOT = 1.6, 4.0  # points, of what is set off


def started(key):
    """Row of mesh, surface and lines of constant value of an experiment that adapts nothing."""
    return plotting.representation(run(key).interpolant)


def swapped(key, label="swapped"):
    """Two rows, where the edges that the start mesh does not have are set off in colour."""
    found, figure, ax = compared(key, label)
    plotting.highlight_edges(ax, found.mesh, plotting.edges_not_in(found.mesh, found.start), width=HEAVY)
    return figure


def refined(key, label="refined"):
    """Two rows, where the elements that were split are shaded and the new nodes marked."""
    found, figure, ax = compared(key, label)
    plotting.shade_elements(ax, found.mesh, np.isin(found.record.parents, found.record.marked))
    plotting.mark_nodes(
        ax, found.mesh, np.arange(found.start.n_nodes, found.mesh.n_nodes), colour=plotting.ACCENT, size=DOT
    )
    return figure


def compared(key, label):
    """An experiment, two rows for its start and its result, and the axes of the final mesh."""
    found = run(key)
    figure = plotting.representation(
        found.interpolant, before=found.start_interpolant, labels=("start", label)
    )
    return found, figure, figure.axes[-3]  # the first of the three in the last row
