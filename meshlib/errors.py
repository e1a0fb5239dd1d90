"""Errors that name the offending items and the remedy."""

from collections.abc import Iterable

DISTRIBUTION = "data-dependent-mesh"  # name of the package on the index


class MeshError(ValueError):
    """A mesh, or the input of an operation on it, breaks a stated rule.

    Parameters
    ----------
    clause : str
        Short name of the broken rule, for example ``"orientation"``.
    message : str
        What is wrong with the first offending item, and the remedy.
    items : iterable of int
        Numbers of all offending nodes, edges or elements.
    count : int
        Number of breaches; the message says so if there are several.

    Attributes
    ----------
    clause : str
    items : tuple of int

    See Also
    --------
    InvalidMeshError, InvalidInputError, UnknownNameError, CostError, NotReachedError

    Examples
    --------
    >>> raise InvalidMeshError("duplicate", "nodes 0 and 3 coincide", (0, 3))
    Traceback (most recent call last):
        ...
    meshlib.errors.InvalidMeshError: duplicate: nodes 0 and 3 coincide
    """

    def __init__(self, clause: str, message: str, items: Iterable[int] = (), count: int = 1) -> None:
        others = f" ({count} in all, see .items)" if count > 1 else ""
        super().__init__(f"{clause}: {message}{others}")
        self.clause = clause
        self.items = tuple(int(i) for i in items)
        self._arguments = clause, message, self.items, count

    def __reduce__(self) -> tuple[type, tuple[str, str, tuple[int, ...], int]]:
        return type(self), self._arguments  # an error of a worker reaches the one who waits for it


class InvalidMeshError(MeshError):
    """Nodes and elements are not a mesh in the sense of Definitions 2.0.1 and 2.0.2."""


class InvalidInputError(MeshError):
    """An argument has the wrong type, shape or size, or holds numbers that are not finite."""


class UnknownNameError(MeshError):
    """There is no criterion, norm, mesh or choice of that name."""


class CostError(MeshError):
    """A criterion returned something that is not a cost: a finite number of at least 0 each."""


class NotReachedError(MeshError):
    """The result that was asked for exists perhaps, but was not reached within the limits given."""


class Interrupted(KeyboardInterrupt):
    """A run was interrupted (Ctrl-C); what it had reached is kept.

    Attributes
    ----------
    result : object
        What the function would have returned had it ended there; its mesh is valid.
    """

    def __init__(self, result: object) -> None:
        super().__init__("stopped before the end; the mesh so far is in .result.mesh")
        self.result = result

    def __reduce__(self) -> tuple[type, tuple[object]]:
        return type(self), (self.result,)


def not_a_cost(a: int, b: int) -> CostError:
    """The error for a cost around the edge a-b that a criterion must not return."""
    return CostError(
        "cost",
        f"a cost around edge ({a}, {b}) is negative or not finite; "
        "a criterion must return finite numbers of at least 0",
        (a, b),
    )


def missing_extra(package: str, extra: str) -> ImportError:
    """The error for an optional dependency that is not installed."""
    return ImportError(f"{package} is needed here: pip install '{DISTRIBUTION}[{extra}]'")
