"""The least number of nodes with which an error is within a tolerance."""

import numpy as np


def least(trial, tolerance, smallest, settings):
    """The trial with about the least number of nodes whose error is within the tolerance.

    Numbers are foreseen by the order of convergence between the last two, and kept
    between the largest that was not enough and the smallest that was.  At the end some
    that are a little smaller are tried as well.

    Parameters
    ----------
    trial : callable
        What is found with a number of nodes; its ``error`` counts.
    tolerance : float
    smallest : int
        Nodes of the smallest mesh.
    settings : NodeCount

    Returns
    -------
    the trial, or None if the most nodes are not enough

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> from meshlib.approximation.settings import NodeCount
    >>> found = least(lambda n: SimpleNamespace(n=n, error=5 / n), 0.01, 3, NodeCount())
    >>> 500 <= found.n <= 505
    True
    """
    nodes, best = _narrowed(trial, tolerance, smallest, settings)
    if best is None:
        return None
    for fewer in dict.fromkeys(max(int(nodes / times), smallest) for times in settings.fewer):
        found = trial(fewer)
        best = found if found.error <= tolerance else best
    return best


def _narrowed(trial, tolerance, smallest, settings):
    """A number that is enough, if any is, just above one that is not, and its trial."""
    nodes, below, above, best, order, last = (
        max(settings.first, smallest),
        smallest - 1,
        None,
        None,
        1.0,
        None,
    )
    for _ in range(settings.most_trials):
        found = trial(nodes)
        if found.error <= tolerance:
            best, above = found, nodes
        else:
            below = nodes
        if _is_over(below, above, settings):
            break
        order, last = _order(last, nodes, found.error, order, settings), (nodes, found.error)
        ratio = np.clip(found.error / tolerance, 1 / settings.largest_ratio, settings.largest_ratio)
        nodes = _between(nodes * ratio ** (1 / order), nodes, below, above, settings)
    return above, best


def _is_over(below, above, settings):
    """Whether the number that is enough is close to one that is not, or none is enough."""
    return below >= settings.most if above is None else above <= max(below + 1, settings.close * below)


def _order(last, nodes, error, order, settings):
    """Order of convergence between two trials, or the one before where it cannot be told."""
    if last is None or last[0] == nodes or not (0 < error < np.inf and last[1] > 0):
        return order
    return float(
        np.clip(np.log(last[1] / error) / np.log(nodes / last[0]), settings.slowest, settings.fastest)
    )


def _between(ahead, nodes, below, above, settings):
    """A whole number near the one foreseen, above what is too few and below what is enough."""
    most, apart = settings.most if above is None else above, settings.close**0.5
    ahead = min(ahead, settings.most_growth * nodes, most)
    if above is not None:
        ahead = np.clip(ahead, below * apart, max(above / apart, below + 1))
    return int(np.clip(round(ahead), below + 1, most if above is None else above - 1))
