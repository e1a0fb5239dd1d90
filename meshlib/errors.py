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


class Interrupted(KeyboardInterrupt):
    """A run was interrupted (Ctrl-C); what it had reached is kept.

    Attributes
    ----------
    result : object
        What the function would have returned had it ended there; its mesh is valid.
    """

    def __init__(self, result):
        super().__init__("stopped before the end; the mesh so far is in .result.mesh")
        self.result = result


def not_a_cost(a, b):
    """The error for a cost around the edge a-b that a criterion must not return."""
    return MeshError(
        "cost",
        f"a cost around edge ({a}, {b}) is negative or not finite; "
        "a criterion must return finite numbers of at least 0",
        (a, b),
    )


def missing_extra(package, extra):
    """The error for an optional dependency that is not installed."""
    from . import DISTRIBUTION

    return ImportError(f"{package} is needed here: pip install '{DISTRIBUTION}[{extra}]'")
