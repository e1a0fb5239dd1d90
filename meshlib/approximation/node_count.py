"""The least number of nodes with which an error is within a tolerance."""

import numpy as np

FIRST = 30  # nodes tried first
CLOSE = 1.01  # ratio of a number that is enough to one that is not, at which the search ends
FASTEST, SLOWEST = 3.0, 0.5  # orders of convergence that are believed
MOST_LEAPS = 8.0  # by how much the number may grow at once
MOST_TRIALS = 30
FEWER = (1.015, 1.03, 1.045, 1.06)  # times as few nodes are tried at the end, as errors do not fall evenly


def least(trial, tolerance, smallest, most):
    """The trial with about the least number of nodes whose error is within the tolerance.

    Numbers are foreseen by the order of convergence between the last two, and kept
    between the largest that was not enough and the smallest that was.  At the end some
    that are a little smaller are tried as well.

    Parameters
    ----------
    trial : callable
        What is found with a number of nodes; its ``error`` counts.
    tolerance : float
    smallest, most : int
        Numbers of nodes between which is looked.

    Returns
    -------
    the trial, or None if the most nodes are not enough

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> found = least(lambda n: SimpleNamespace(n=n, error=5 / n), 0.01, 3, 10_000)
    >>> 500 <= found.n <= 505
    True
    """
    nodes, best = _narrowed(trial, tolerance, smallest, most)
    if best is None:
        return None
    for fewer in dict.fromkeys(max(int(nodes / times), smallest) for times in FEWER):
        found = trial(fewer)
        best = found if found.error <= tolerance else best
    return best


def _narrowed(trial, tolerance, smallest, most):
    """A number that is enough, if any is, just above one that is not, and its trial."""
    nodes, below, above, best, order, last = max(FIRST, smallest), smallest - 1, None, None, 1.0, None
    for _ in range(MOST_TRIALS):
        found = trial(nodes)
        if found.error <= tolerance:
            best, above = found, nodes
        else:
            below = nodes
        if best is None and below >= most or best is not None and above <= max(below + 1, CLOSE * below):
            break
        order, last = _order(last, nodes, found.error, order), (nodes, found.error)
        ahead = nodes * np.clip(found.error / tolerance, 1e-9, 1e9) ** (1 / order)
        nodes = _between(ahead, nodes, below, most if best is None else above, best is not None)
    return above, best


def _order(last, nodes, error, order):
    """Order of convergence between two trials, or the one before where it cannot be told."""
    if last is None or last[0] == nodes or not (0 < error < np.inf and last[1] > 0):
        return order
    return float(np.clip(np.log(last[1] / error) / np.log(nodes / last[0]), SLOWEST, FASTEST))


def _between(ahead, nodes, below, above, is_bound):
    """A whole number near the one foreseen, above what is too few and below what is enough."""
    ahead = min(ahead, MOST_LEAPS * nodes, above)
    if is_bound:
        ahead = np.clip(ahead, below * CLOSE**0.5, max(above / CLOSE**0.5, below + 1))
    return int(np.clip(round(ahead), below + 1, above - 1 if is_bound else above))
