"""Test functions u(x, y) by name, each with its formula, source and peculiarities."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .._typing import ArrayLike, FloatArray
from ..checks import choice

THESIS = "section 4.2 of the thesis, after Malcolm"
FRANKE = "Franke 1982; Renka & Brown 1999 (Algorithm 792)"


@dataclass(frozen=True)
class TestFunction:
    """A vectorised function u(x, y) with its formula and its source.

    Attributes
    ----------
    name : str
        Name in ``problems.functions``.
    function : callable
        What is called, with float64 arrays x and y.
    formula : str
        The right-hand side of u(x, y) = ..., in LaTeX.
    source : str
        Publication that the function comes from, or its kind.
    note : str
        Known peculiarities.

    See Also
    --------
    meshlib.problems.mesh : start meshes by name.

    Examples
    --------
    >>> from meshlib import problems
    >>> round(float(problems.functions["SR1"](0.0, 0.5)), 4)
    0.2222
    """

    __test__ = False  # not a test case, whatever its name says to pytest

    name: str
    function: Callable[[FloatArray, FloatArray], FloatArray]
    formula: str
    source: str
    note: str = ""

    def __call__(self, x: ArrayLike, y: ArrayLike) -> FloatArray:
        """The values at points with the coordinates x and y, arrays of equal shape."""
        return self.function(np.asarray(x, dtype=float), np.asarray(y, dtype=float))

    def __repr__(self) -> str:
        return f"TestFunction({self.name!r})"


def _sr1(x: FloatArray, y: FloatArray) -> FloatArray:
    return (np.tanh(9 * y - 9 * x) + 1) / 9


def _sr2(x: FloatArray, y: FloatArray) -> FloatArray:
    return (np.tanh(9 * y + 9 * x - 9) + 1) / 2


def _sr3(x: FloatArray, y: FloatArray) -> FloatArray:
    g = 0.595576 * (y + 3.79762) ** 2 - x - 10
    return 1 + np.tanh(-3 * g)


def _dd1(x: FloatArray, y: FloatArray) -> FloatArray:
    phi = 2.1 * x - 0.1
    height = y - phi
    r = np.hypot(phi - 1.5, y - 0.5)
    spike = np.where(r <= 0.25, (1 + np.cos(4 * np.pi * r)) / 2, 0.0)
    return np.select([height >= 0.5, height >= 0], [1.0, 2 * height], spike)


def _franke(x: FloatArray, y: FloatArray) -> FloatArray:
    p, q = 9 * x, 9 * y
    return (
        0.75 * np.exp(-((p - 2) ** 2 + (q - 2) ** 2) / 4)
        + 0.75 * np.exp(-((p + 1) ** 2) / 49 - (q + 1) / 10)
        + 0.5 * np.exp(-((p - 7) ** 2 + (q - 3) ** 2) / 4)
        - 0.2 * np.exp(-((p - 4) ** 2) - (q - 7) ** 2)
    )


def _saddle(x: FloatArray, y: FloatArray) -> FloatArray:
    return (1.25 + np.cos(5.4 * y)) / (6 + 6 * (3 * x - 1) ** 2)


def _from_centre(x: FloatArray, y: FloatArray) -> FloatArray:
    return (x - 0.5) ** 2 + (y - 0.5) ** 2


def _gentle(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.exp(-81 / 16 * _from_centre(x, y)) / 3


def _steep(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.exp(-81 / 4 * _from_centre(x, y)) / 3


def _sphere(x: FloatArray, y: FloatArray) -> FloatArray:
    return np.sqrt(64 - 81 * _from_centre(x, y)) / 9 - 0.5


class Functions(dict[str, TestFunction]):
    """Test functions by name; the error for an unknown name proposes the nearest one.

    Examples
    --------
    >>> from meshlib import problems
    >>> problems.functions["sr1"]
    Traceback (most recent call last):
        ...
    meshlib.errors.UnknownNameError: unknown: function 'sr1' is not known; did you mean 'SR1'? (known: ...)
    """

    def __missing__(self, name: str) -> TestFunction:
        return self[choice(name, tuple(self), "function")]


functions = Functions(
    (f.name, f)
    for f in (
        TestFunction(
            "SR1",
            _sr1,
            r"\tfrac19(\tanh(9y-9x)+1)",
            THESIS,
            "Franke's cliff; the factor is 1/9, that of SR2 is 1/2",
        ),
        TestFunction("SR2", _sr2, r"\tfrac12(\tanh(9y+9x-9)+1)", THESIS),
        TestFunction("SR3", _sr3, r"1+\tanh(-3g),\ g=0.595576(y+3.79762)^2-x-10", THESIS),
        TestFunction(
            "DD1",
            _dd1,
            r"\text{ramp } 2(y-\phi),\ \text{spike } \tfrac12(1+\cos 4\pi r)",
            THESIS,
            "continuous, with jumps in its gradient; the cases are read from top to bottom",
        ),
        TestFunction("franke", _franke, r"\text{four exponentials}", FRANKE, "defined on the unit square"),
        TestFunction("cliff", _sr1, r"\tfrac19(\tanh(9y-9x)+1)", FRANKE, "the same function as SR1"),
        TestFunction("saddle", _saddle, r"(1.25+\cos 5.4y)/(6+6(3x-1)^2)", FRANKE),
        TestFunction("gentle", _gentle, r"\tfrac13 e^{-81/16((x-1/2)^2+(y-1/2)^2)}", FRANKE),
        TestFunction("steep", _steep, r"\tfrac13 e^{-81/4((x-1/2)^2+(y-1/2)^2)}", FRANKE),
        TestFunction(
            "sphere", _sphere, r"\tfrac19\sqrt{64-81((x-\frac12)^2+(y-\frac12)^2)}-\tfrac12", FRANKE
        ),
        TestFunction(
            "convex",
            lambda x, y: x**2 + y**2,
            "x^2+y^2",
            "quadratic, det H > 0",
            "Delaunay is its best mesh on given nodes",
        ),
        TestFunction("hyperbolic", lambda x, y: x**2 - y**2, "x^2-y^2", "quadratic, det H < 0"),
        TestFunction("product", lambda x, y: x * y, "xy", "quadratic, det H < 0"),
    )
)
