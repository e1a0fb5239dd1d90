"""The one switch between numba and plain Python.

The environment variable ``MESHLIB_BACKEND`` chooses: ``numba``, ``python``, or
``auto`` (numba where it is installed).  Kernels are written once, with flat arrays
and scalars: numba compiles them for NumPy arrays, plain Python runs them on lists,
which it indexes several times faster than arrays.
"""
import os

from ..checks import choice
from ..errors import missing_extra

BACKENDS = ("auto", "numba", "python")


def _chosen():
    wanted = choice(os.environ.get("MESHLIB_BACKEND", "auto"), BACKENDS, "MESHLIB_BACKEND")
    if wanted == "python":
        return "python", None
    try:
        import numba
    except ImportError:
        if wanted == "numba":
            raise missing_extra("numba", "fast") from None
        return "python", None
    return "numba", numba


NAME, _numba = _chosen()


def compiled(function):
    """The function compiled by numba, or as it is."""
    return _numba.njit(cache=True, error_model="numpy")(function) if _numba else function


def inlined(function):
    """The same, copied into its callers: a call that hands over many arrays is dear."""
    return _numba.njit(cache=True, error_model="numpy", inline="always")(function) if _numba else function


def flat(array):
    """A private, flat working copy: an array for numba, a list for plain Python."""
    return array.ravel().copy() if _numba else array.ravel().tolist()


def read(array):
    """A flat array that is only read, or a list for plain Python."""
    return array.ravel() if _numba else array.ravel().tolist()


def written(array):
    """A flat array that the kernel may write into, or a list for plain Python."""
    return array if _numba else array.tolist()
