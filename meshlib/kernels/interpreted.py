"""The modules of `kernels` once more, from the same files, as plain Python: for jobs too small for numba."""

from . import __path__  # noqa: F401 (what has a path is a package)
