"""Errors that name the offending item and the remedy."""


class MeshError(ValueError):
    """A mesh, or the input of an operation on it, breaks a stated rule.

    Attributes
    ----------
    clause : str
        Short name of the broken rule, for example ``"orientation"``.
    items : tuple of int
        Numbers of the offending nodes, edges or elements.

    Examples
    --------
    >>> raise MeshError("duplicate", "nodes 0 and 3 coincide", (0, 3))
    Traceback (most recent call last):
        ...
    meshlib.errors.MeshError: duplicate: nodes 0 and 3 coincide
    """

    def __init__(self, clause, message, items=()):
        super().__init__(f"{clause}: {message}")
        self.clause = clause
        self.items = tuple(int(i) for i in items)


def missing_extra(package, extra):
    """The error for an optional dependency that is not installed."""
    from . import DISTRIBUTION
    return ImportError(f"{package} is needed here: pip install '{DISTRIBUTION}[{extra}]'")
