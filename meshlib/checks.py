"""Checks of what a user hands in, made before anything is computed from it."""
import difflib

import numpy as np

from .errors import MeshError

MINIMUM_NODES = 3


def node_array(nodes):
    """Nodes as an (N, 2) float64 array of finite coordinates, or a MeshError."""
    nodes = _numeric(nodes, "nodes")
    if nodes.ndim != 2 or nodes.shape[1] != 2:
        raise MeshError("shape", f"nodes have shape {nodes.shape}; give an (N, 2) array of x and y")
    if len(nodes) < MINIMUM_NODES:
        raise MeshError("shape", f"{len(nodes)} nodes make no element; give at least {MINIMUM_NODES}")
    bad = np.flatnonzero(~np.isfinite(nodes).all(axis=1))
    if bad.size:
        x, y = nodes[bad[0]]
        raise MeshError("finite", f"node {bad[0]} has the coordinates ({x}, {y}); "
                        "remove it or give finite numbers", bad)
    return nodes


def element_array(elements):
    """Elements as a (T, 3) int32 array, or a MeshError."""
    elements = np.asarray(elements)
    if elements.ndim != 2 or elements.shape[1] != 3:
        raise MeshError("shape", f"elements have shape {elements.shape}; "
                        "give a (T, 3) array of node numbers")
    if not len(elements):
        raise MeshError("shape", "there are no elements; give at least one")
    if elements.dtype.kind not in "iu":
        raise MeshError("dtype", f"elements have dtype {elements.dtype}; give integer node numbers")
    return elements.astype(np.int32)


def distinct_nodes(nodes):
    """Raise a MeshError that names the first pair of coinciding nodes."""
    order = np.lexsort((np.arange(len(nodes)), nodes[:, 1], nodes[:, 0]))
    same = np.flatnonzero((np.diff(nodes[order], axis=0) == 0).all(axis=1))
    if same.size:
        i, j = order[same[0]], order[same[0] + 1]
        x, y = (float(v) for v in nodes[i])
        raise MeshError("duplicate", f"nodes {i} and {j} coincide at ({x}, {y}); keep one of them", (i, j))


def nodal_values(mesh, values):
    """Values of u at the nodes as an (N,) float64 array.

    ``values`` is such an array or a vectorised function u(x, y).
    """
    if callable(values):
        values = values(*mesh.nodes.T)
    values = _numeric(values, "values")
    if values.shape != (mesh.n_nodes,):
        raise MeshError("shape", f"values have shape {values.shape}; give one value "
                        f"for each of the {mesh.n_nodes} nodes")
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise MeshError("finite", f"the value at node {bad[0]} is {values[bad[0]]}; "
                        "fill it in or remove the node", bad)
    return values


def fraction(value):
    """A number in [0, 1], or a MeshError."""
    if not (np.isscalar(value) and np.isreal(value) and 0 <= value <= 1):
        raise MeshError("range", f"fraction is {value!r}; give a number from 0 to 1, 0.2 for 20 %")
    return float(value)


def choice(value, options, what):
    """``value`` if it is one of the options, else an error with the nearest one."""
    if value in options:
        return value
    near = difflib.get_close_matches(str(value), [str(o) for o in options], n=1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    listed = ", ".join(repr(o) for o in options)
    raise MeshError("unknown", f"{what} {value!r} is not known{hint} (known: {listed})")


def permutation(order, size):
    """``order`` as an (E,) array that names every edge once, or a MeshError."""
    order = np.arange(size) if order is None else np.asarray(order)
    if order.shape != (size,) or order.dtype.kind not in "iu":
        raise MeshError("shape", f"order has shape {order.shape} and dtype {order.dtype}; "
                        f"give the {size} edge numbers in the order of inspection")
    missing = np.setdiff1d(np.arange(size), order)
    if missing.size:
        raise MeshError("order", f"edge {missing[0]} is not in order; name each edge once", missing)
    return order.astype(np.int64)


def _numeric(array, what):
    try:
        array = np.asarray(array)
    except ValueError:
        raise MeshError("shape", f"{what} have rows of different lengths; give a regular array") from None
    if array.dtype.kind not in "fiu":
        raise MeshError("dtype", f"{what} have dtype {array.dtype}; give real numbers")
    return array.astype(np.float64)
