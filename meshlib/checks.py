"""Checks of what a user hands in, made before anything is computed from it."""

import difflib
from collections.abc import Collection
from numbers import Real
from typing import Any, TypeVar

import numpy as np

from ._typing import AnyMesh, ArrayLike, FloatArray, Function, IntArray, NDArray, Values
from .errors import CostError, InvalidInputError, InvalidMeshError, UnknownNameError

MINIMUM_NODES = 3  # number of nodes of a mesh, or of a closed boundary
LARGEST_VALUE = 1e120  # nodal value; squares of gradients, and of their inverses, are finite up to here

GivenT = TypeVar("GivenT")


def node_array(nodes: ArrayLike) -> FloatArray:
    """Nodes as an (N, 2) float64 array of finite coordinates, or a MeshError."""
    nodes = numeric(nodes, "nodes")
    if nodes.ndim != 2 or nodes.shape[1] != 2:
        raise InvalidInputError("shape", f"nodes have shape {nodes.shape}; give an (N, 2) array of x and y")
    if len(nodes) < MINIMUM_NODES:
        raise InvalidInputError(
            "shape", f"{_counted(len(nodes), 'node')} cannot make an element; give at least {MINIMUM_NODES}"
        )
    if not np.isfinite(nodes).all():
        bad = np.flatnonzero(~np.isfinite(nodes).all(axis=1))
        x, y = nodes[bad[0]]
        raise InvalidInputError(
            "finite",
            f"node {bad[0]} has the coordinates ({x}, {y}); remove it or give finite numbers",
            bad,
            len(bad),
        )
    return nodes


def element_array(elements: ArrayLike) -> NDArray[np.int32]:
    """Elements as a (T, 3) int32 array, or a MeshError."""
    elements = _numbers(elements, "elements", 3, "a (T, 3) array of node numbers")
    largest = np.iinfo(np.int32).max
    if not len(elements):
        raise InvalidInputError("shape", "there are no elements; give at least one")
    if elements.max() > largest:
        bad = np.argwhere(elements > largest)
        t, k = bad[0]
        raise InvalidMeshError(
            "index range",
            f"element {t} names node {elements[t, k]}; the largest number is {largest}",
            bad[:, 0],
            len(bad),
        )
    return elements.astype(np.int32)


def green_array(green: ArrayLike | None) -> NDArray[np.int32]:
    """Pairs of element numbers as a (G, 2) int32 array, none by default, or a MeshError."""
    if green is None:
        return np.empty((0, 2), dtype=np.int32)
    return _numbers(green, "green pairs", 2, "a (G, 2) array of element numbers").astype(np.int32)


def node_pairs(pairs: ArrayLike) -> NDArray[np.int64]:
    """Pairs of node numbers as an (m, 2) int64 array, the smaller first, or a MeshError."""
    found = _numbers(pairs, "pairs", 2, "an (m, 2) array of node numbers")
    return np.sort(found, axis=1).astype(np.int64)


def distinct_nodes(nodes: FloatArray) -> None:
    """Raise a MeshError that names the first pair of coinciding nodes."""
    points = np.sort(np.ascontiguousarray(nodes).view(np.complex128), axis=None)  # by x, then by y
    if (points[1:] != points[:-1]).all():
        return
    order = np.lexsort((np.arange(len(nodes)), nodes[:, 1], nodes[:, 0]))
    same = np.flatnonzero((np.diff(nodes[order], axis=0) == 0).all(axis=1))
    if same.size:
        pairs = np.column_stack([order[same], order[same + 1]])
        (i, j), (x, y) = pairs[0], (float(v) for v in nodes[order[same[0]]])
        raise InvalidMeshError(
            "duplicate",
            f"nodes {i} and {j} coincide at ({x}, {y}); keep one of them",
            pairs.ravel(),
            len(pairs),
        )


def unnamed(elements: IntArray, n_nodes: int) -> IntArray:
    """Numbers of the nodes that belong to no element, in ascending order."""
    used = np.zeros(n_nodes, dtype=bool)
    used[elements] = True
    return np.flatnonzero(~used)


def nodal_values(mesh: AnyMesh, values: Values) -> FloatArray:
    """Values of u at the nodes as an (N,) float64 array, or a MeshError.

    ``values`` is such an array or a vectorised function u(x, y).
    """
    values = numeric(values(*mesh.nodes.T) if callable(values) else values, "values")
    if values.shape != (mesh.n_nodes,):
        raise InvalidInputError(
            "shape", f"values have shape {values.shape}; give one value for each of the {mesh.n_nodes} nodes"
        )
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise InvalidInputError(
            "finite",
            f"the value at node {bad[0]} is {values[bad[0]]}; fill it in or remove the node",
            bad,
            bad.size,
        )
    size = np.abs(values).max()
    if size > LARGEST_VALUE or 0 < size < 1 / LARGEST_VALUE:
        raise InvalidInputError(
            "range", f"the largest value is {size:g}, whose square is out of range; measure u in another unit"
        )
    return values


def function_values(function: Function, x: FloatArray, y: FloatArray) -> NDArray[Any]:
    """Values of a vectorised function, finite and of the shape of x and y, or a MeshError."""
    found = np.asarray(function(x, y))
    if found.shape != x.shape or found.dtype.kind not in "fiu":
        raise InvalidInputError(
            "shape",
            f"the function returned shape {found.shape} and dtype {found.dtype} "
            f"for points of shape {x.shape}; return one real number for each",
        )
    if not np.isfinite(found).all():
        k = np.flatnonzero(~np.isfinite(found).ravel())[0]
        at = f"({x.ravel()[k]}, {y.ravel()[k]})"
        raise InvalidInputError(
            "finite", f"the function is {found.ravel()[k]} at {at}; it must be finite in the whole domain"
        )
    return found


def cost_vector(costs: ArrayLike, size: int, what: str) -> FloatArray:
    """Costs that a criterion returned, as (size,) finite floats of at least 0, or a MeshError."""
    costs = np.asarray(costs, dtype=float)
    if costs.shape != (size,):
        raise InvalidInputError(
            "shape",
            f"the criterion returned costs of shape {costs.shape} "
            f"for {size} {what}s; return one number for each",
        )
    bad = np.flatnonzero(~(np.isfinite(costs) & (costs >= 0)))
    if bad.size:
        raise CostError(
            "cost",
            f"the cost of {what} {bad[0]} is {costs[bad[0]]}; "
            "a criterion must return finite numbers of at least 0",
            bad,
            bad.size,
        )
    return costs


def a_mesh(mesh: GivenT) -> GivenT:
    """The mesh, validated unless it has been before, or a MeshError if it is something else."""
    if hasattr(mesh, "_checked"):
        return mesh._checked()
    hint = "take its .mesh" if hasattr(mesh, "mesh") else "make a meshlib.Mesh or use meshlib.delaunay"
    raise InvalidInputError("type", f"a mesh is needed, this is a {type(mesh).__name__}; {hint}")


def fraction(value: float) -> float:
    """A number in [0, 1], or a MeshError."""
    return number(value, "fraction", 0, np.nextafter(1, 2), "a number from 0 to 1, 0.2 for 20 %")


def number(value: float, what: str, least: float, above: float, remedy: str) -> float:
    """A real number with least <= number < above, or a MeshError."""
    if not (isinstance(value, Real) and least <= value < above):
        raise InvalidInputError("range", f"{what} is {value!r}; give {remedy}")
    return float(value)


def whole(value: int, least: int, what: str) -> int:
    """A whole number of at least ``least``, or a MeshError."""
    if not (isinstance(value, (int, np.integer)) and value >= least):
        raise InvalidInputError("range", f"{what} is {value!r}; give a whole number of at least {least}")
    return int(value)


def workers(value: int) -> int:
    """A number of processes, -1 for one on each core, or a MeshError."""
    if not (isinstance(value, (int, np.integer)) and value >= -1 and value != 0):
        raise InvalidInputError(
            "range", f"workers is {value!r}; give a whole number of at least 1, or -1 for all cores"
        )
    return int(value)


def choice(value: GivenT, options: Collection[GivenT], what: str) -> GivenT:
    """``value`` if it is one of the options, else a MeshError that proposes the nearest one."""
    if isinstance(value, (str, Real)) and value in options:
        return value
    by_text = {str(option).lower(): option for option in options}
    near = difflib.get_close_matches(value.lower(), by_text, n=1) if isinstance(value, str) else ()
    hint = f"; did you mean {by_text[near[0]]!r}?" if near else ""
    listed = ", ".join(repr(o) for o in options)
    raise UnknownNameError("unknown", f"{what} {value!r} is not known{hint} (known: {listed})")


def permutation(order: ArrayLike, size: int, what: str = "edge") -> NDArray[np.int64]:
    """``order`` as an array that names every edge (element, node) once, or a MeshError."""
    order = _regular(order, "order")
    if order.shape != (size,) or order.dtype.kind not in "iu":
        raise InvalidInputError(
            "shape",
            f"order has shape {order.shape} and dtype {order.dtype}; "
            f"give the {size} {what} numbers, each once",
        )
    named = np.zeros(size, dtype=bool)
    named[order[(order >= 0) & (order < size)]] = True
    missing = np.flatnonzero(~named)
    if missing.size:
        raise InvalidInputError(
            "order", f"{what} {missing[0]} is not in order; name each {what} once", missing, missing.size
        )
    return order.astype(np.int64)


def _counted(number: int, noun: str) -> str:
    """A number and its noun, in the plural unless it is 1."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _regular(array: Any, what: str) -> NDArray[Any]:
    """An array, NaN where it was masked, or a MeshError if the rows differ in length."""
    try:
        return array.astype(float).filled(np.nan) if np.ma.is_masked(array) else np.asarray(array)
    except ValueError:
        raise InvalidInputError(
            "shape", f"the rows of {what} differ in length; give a regular array"
        ) from None


def _numbers(array: ArrayLike, what: str, columns: int, shape: str) -> NDArray[Any]:
    """A table of whole numbers with this number of columns, or a MeshError that tells the shape."""
    array = _regular(array, what)
    if array.ndim != 2 or array.shape[1] != columns:
        raise InvalidInputError("shape", f"{what} have shape {array.shape}; give {shape}")
    if array.dtype.kind not in "iu" and array.size:
        raise InvalidInputError("dtype", f"{what} have dtype {array.dtype}; give whole numbers")
    return array


def numeric(array: ArrayLike, what: str) -> FloatArray:
    """Real numbers as a float64 array, or a MeshError."""
    array = _regular(array, what)
    if array.dtype.kind not in "fiu":
        raise InvalidInputError("dtype", f"{what} have dtype {array.dtype}; give real numbers")
    return array.astype(np.float64)
