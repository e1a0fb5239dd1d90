"""The one switch between numba and plain Python.

The environment variable ``MESHLIB_BACKEND`` chooses: ``numba``, ``python``, or
``auto`` (numba where it is installed, once there is enough to do, see `for_work`).
Kernels are written once, with flat arrays and scalars: numba compiles them for NumPy
arrays, plain Python runs them on lists, which it indexes several times faster than arrays.
"""

import os

from meshlib.checks import choice
from meshlib.errors import missing_extra

BACKENDS = ("auto", "numba", "python")
COMPILING = "meshlib.kernels"  # the package; its twin is `meshlib.kernels.interpreted`


def _chosen():
    if __package__ != COMPILING:
        return "python", None
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


def _lean(numba):
    """Options of the compiler: no kernel allocates, so counting references would only halve the speed."""
    known = hasattr(numba.core.options.DefaultOptions, "_nrt")  # numba does not promise that it stays
    return {"cache": True, "error_model": "numpy", **({"_nrt": False} if known else {})}


NAME, _numba = _chosen()
_OPTIONS = _lean(_numba) if _numba else {}


def compiled(function):
    """The function compiled by numba, or as it is."""
    return _numba.njit(**_OPTIONS)(function) if _numba else function


def inlined(function):
    """The same, copied into its callers: a call that hands over many arrays is dear."""
    return _numba.njit(**_OPTIONS, inline="always")(function) if _numba else function


def inner(function):
    """A user's function, for another that is compiled to call it."""
    if not _numba or hasattr(function, "py_func"):  # it is compiled already
        return function
    return _numba.njit(error_model="numpy")(function)


def callable_from_kernels(function, n_numbers):
    """A function of so many numbers that a kernel can be handed, or None if numba refuses it."""
    if not _numba:
        return function
    number = _numba.float64
    try:
        return _numba.cfunc(number(*[number] * n_numbers), error_model="numpy")(function)
    except _numba.core.errors.NumbaError:
        return None


def readable(array):
    """A flat form that a kernel only reads: the array itself for numba, a list for plain Python."""
    if not _numba:
        return array.ravel().tolist()
    found = array.ravel().view()
    found.flags.writeable = False  # so that kernels are compiled for one kind of array
    return found


def flat(array):
    """A private, flat working copy: an array for numba, a list for plain Python."""
    return array.ravel().copy() if _numba else array.ravel().tolist()


def writable(array):
    """A flat array that a kernel writes into, itself and no copy, or a list for plain Python."""
    return array if _numba else array.tolist()
