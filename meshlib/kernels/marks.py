"""Marks of the functions that numba compiles.  A marked function stays a plain Python function."""

from collections.abc import Callable
from typing import Any, TypeVar

F = TypeVar("F", bound=Callable[..., Any])

INLINING: dict[Callable[..., Any], str] = {}  # every kernel, and whether numba copies it into its callers


def kernel(function: F) -> F:
    """Mark a function that numba compiles."""
    INLINING[function] = "never"  # the optimiser behind numba still does so with small functions
    return function


def inlined(function: F) -> F:
    """Mark a kernel that numba copies into its callers: a call that hands over many arrays is expensive."""
    INLINING[function] = "always"
    return function
