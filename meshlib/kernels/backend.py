"""The two forms of the kernels: plain Python functions on lists, or compiled by numba on arrays.

Kernels are written once, as plain functions of flat arrays and numbers, and that is the
plain form.  The compiled form of a function is the function itself, with the kernels that
it calls replaced by their compiled forms, handed to numba: nothing is imported twice, and
whatever reads source (an editor, a type checker, a coverage tool, a freezer) sees the code
that runs.
"""

import sys
from collections.abc import Callable
from threading import RLock
from types import FunctionType, ModuleType
from typing import Any

from numpy.typing import NDArray

from . import colours, costs, element_shapes, half_edges, location, lop, raster, schedules, springs
from .marks import INLINING

MODULES = colours, costs, element_shapes, half_edges, location, lop, raster, schedules, springs


class Plain:
    """Kernels as plain Python functions, on lists, which Python indexes several times faster than arrays.

    Attributes
    ----------
    name : {"python", "numba"}
    colours, costs, element_shapes, half_edges, location, lop, raster, schedules, springs
        The modules of kernels in this form.
    """

    name, is_compiled = "python", False
    colours: Any
    costs: Any
    element_shapes: Any
    half_edges: Any
    location: Any
    lop: Any
    raster: Any
    schedules: Any
    springs: Any

    def __init__(self) -> None:
        for module in MODULES:
            setattr(self, module.__name__.rpartition(".")[2], self._form(module))

    def _form(self, module: ModuleType) -> Any:
        return module

    def readable(self, array: NDArray[Any]) -> Any:
        """A flat form that kernels only read."""
        return array.ravel().tolist()

    def flat(self, array: NDArray[Any]) -> Any:
        """A private, flat copy that kernels change."""
        return array.ravel().tolist()

    def writable(self, array: NDArray[Any]) -> Any:
        """A flat array that nobody else holds, in a form that kernels change."""
        return array.tolist()

    def inner(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """A user's function in a form that another one can call."""
        return function

    def pointer(self, function: Callable[..., Any]) -> Any:
        """A function of four points in a form that kernels can be handed, or None if it has none."""
        return function


class Compiled(Plain):
    """Kernels compiled by numba, on arrays."""

    name, is_compiled = "numba", True

    def __init__(self, numba: Any) -> None:
        self._numba, self._lock = numba, RLock()
        self._names: dict[str, dict[str, Any]] = {}
        self._done: dict[FunctionType, Any] = {}
        self._options = {"cache": True, "error_model": "numpy"}
        if hasattr(numba.core.options.DefaultOptions, "_nrt"):  # numba does not promise that it stays
            self._options["_nrt"] = False  # no kernel allocates; counting references would halve the speed
        super().__init__()

    def _form(self, module: ModuleType) -> Any:
        return _CompiledModule(module, self.compiled)

    def compiled(self, value: Any) -> Any:
        """A kernel compiled, together with the kernels that it calls; anything else as it is."""
        if not isinstance(value, FunctionType) or value not in INLINING:
            return value
        with self._lock:
            if value not in self._done:
                self._done[value] = self._twin(value)
            return self._done[value]

    def _twin(self, kernel: FunctionType) -> Any:
        """A copy of the kernel with other global names, for numba to compile at the first call."""
        twin = FunctionType(kernel.__code__, self._names_in(kernel.__module__), kernel.__name__)
        twin.__module__, twin.__qualname__ = kernel.__module__, kernel.__qualname__
        return self._numba.njit(**self._options, inline=INLINING[kernel])(twin)

    def _names_in(self, module: str) -> dict[str, Any]:
        """The global names of a module, with its kernels compiled."""
        if module not in self._names:
            names = self._names[module] = dict(vars(sys.modules[module]))
            names.update({name: self.compiled(value) for name, value in names.items()})
        return self._names[module]

    def readable(self, array: NDArray[Any]) -> Any:
        """The array itself, which kernels must not change."""
        found = array.ravel().view()
        found.flags.writeable = False  # so that kernels are compiled for one kind of array
        return found

    def flat(self, array: NDArray[Any]) -> Any:
        """A private, flat copy that kernels change."""
        return array.ravel().copy()

    def writable(self, array: NDArray[Any]) -> Any:
        """The array itself, which kernels change."""
        return array

    def inner(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """A user's function, compiled unless it is."""
        if hasattr(function, "py_func"):  # it is compiled already
            return function
        return self._numba.njit(error_model="numpy")(function)

    def pointer(self, function: Callable[..., Any]) -> Any:
        """A function of four points as a C function, or None if numba cannot compile it."""
        number = self._numba.float64
        point = self._numba.types.UniTuple(number, 3)
        try:
            return self._numba.cfunc(number(point, point, point, point), error_model="numpy")(function)
        except self._numba.core.errors.NumbaError:
            return None


class _CompiledModule:
    """A module whose kernels are compiled, each when it is first asked for."""

    def __init__(self, module: ModuleType, compiled: Callable[[Any], Any]) -> None:
        self._module, self._compiled = module, compiled

    def __getattr__(self, name: str) -> Any:
        found = self._compiled(getattr(self._module, name))
        setattr(self, name, found)
        return found
