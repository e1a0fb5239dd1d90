"""The hot loops: one source, compiled by numba where it is installed, or run as plain Python.

Loading numba takes some tenths of a second, in which plain Python does many a small job.
Whether it pays cannot be known before the last job; who rents skis until the rents have
reached the price, and then buys, never pays more than twice what was necessary.
"""

import os
import sys
from importlib import import_module

BUDGET = 300_000  # steps, about a microsecond of plain Python each, that take as long as loading numba
_spent = 0  # steps asked for in this process


class _Kernels:
    """The modules of a package, each loaded when it is first asked for."""

    def __init__(self, package):
        self._package = package

    def __getattr__(self, name):
        if name.startswith("_"):  # tools look for such names
            raise AttributeError(name)
        module = import_module(f"{self._package}.{name}")
        setattr(self, name, module)
        return module


COMPILED = _Kernels("meshlib.kernels")  # by numba, unless it is missing or not wanted
INTERPRETED = _Kernels("meshlib.kernels.interpreted")


def for_work(steps):
    """The kernels for a job of so many steps: interpreted ones until it pays to load the compiled.

    The choice depends on what this process has done before, and no result on the choice.
    Whoever holds data in the form of one ``backend`` must stay with its kernels.
    """
    global _spent
    _spent += steps
    loaded = "meshlib.kernels.backend" in sys.modules
    asked = os.environ.get("MESHLIB_BACKEND", "auto")
    return INTERPRETED if asked == "auto" and not loaded and _spent <= BUDGET else COMPILED
