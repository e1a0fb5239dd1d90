"""The local optimisation procedure once more: slow, obvious, for any criterion.

The mesh is a dictionary from directed edges to the node on their left.  Costs come
from the vectorised definitions in `meshlib.criteria`, so that nothing but the
algorithm is shared with the compiled form, whose oracle this is.
"""
import numpy as np

from .. import norms
from ..errors import MeshError
from ..interpolant import Interpolant
from ..mesh import Mesh
from ..quality import angles

FLAT = 1e-12


def swapped(mesh, values, criterion, norm, order, limits, tolerance):
    """Elements after Algorithm 3.1.4, the numbers of swaps and sweeps, and every tried swap."""
    apex = {(a, b): c for t in mesh.elements.tolist() for a, b, c in (t, t[1:] + t[:1], t[2:] + t[:2])}
    slots, points = [tuple(e) for e in mesh.edges.tolist()], np.column_stack([mesh.nodes, values])
    local_cost = {"edge": _edge_costs, "element": _element_costs, "node": _node_costs}[criterion.on]
    tried, swaps, sweep, changed = [], 0, 0, True
    while changed:
        sweep, changed = sweep + 1, False
        for e in order.tolist():
            quad = _quadrilateral(apex, slots[e])
            if quad is None or _is_refused(mesh.nodes, quad, limits):
                continue
            a, b, c, d = quad
            old, new = (norms.measure(_finite(h, a, b), norm, tolerance[1])
                        for h in local_cost(criterion.cost, points, apex, quad))
            accepted = norms.is_below(new, old, norm, *tolerance)
            tried.append((sweep, e, a, b, c, d, accepted, *_deciding(old, new)))
            if accepted:
                _swap(apex, quad)
                slots[e], swaps, changed = (c, d), swaps + 1, True
    return _elements(apex), swaps, sweep, tried


def _finite(costs, a, b):
    if (np.isfinite(costs) & (np.asarray(costs) >= 0)).all():
        return costs
    raise MeshError("cost", f"a cost around edge ({a}, {b}) is negative or not finite; "
                    "a criterion must return finite numbers of at least 0", (a, b))


def _deciding(old, new):
    """The costs that decide: the first that differ in the lexicographic order."""
    if not isinstance(old, tuple):
        return old, new
    differ = (pair for pair in zip(old, new, strict=False) if pair[0] != pair[1])
    return next(differ, (old[0], new[0]))


def _quadrilateral(apex, edge):
    """Nodes a, b, c, d: the edge a-b, c to its left, d to its right; None on the boundary."""
    a, b = edge
    c, d = apex.get((a, b)), apex.get((b, a))
    return None if c is None or d is None else (a, b, c, d)


def _swap(apex, quad):
    """Replace the elements (c, a, b), (d, b, a) by (c, a, d), (d, b, c)."""
    a, b, c, d = quad
    del apex[a, b], apex[b, a]
    for p, q, r in ((c, a, d), (d, b, c)):
        apex[p, q], apex[q, r], apex[r, p] = r, p, q


def _elements(apex):
    rows = {_from_smallest(a, b, c) for (a, b), c in apex.items()}
    return np.array(sorted(rows), dtype=np.int32)


def _from_smallest(a, b, c):
    """The element turned so that its smallest node number comes first."""
    return min((a, b, c), (b, c, a), (c, a, b))


def _is_refused(nodes, quad, limits):
    a, b, c, d = quad
    corners = nodes[[[c, a, d], [d, b, c]]]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    left, right = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
    if (left - right <= FLAT * (abs(left) + abs(right))).any():
        return True
    return ((left - right) / 2 < limits.area).any() or angles(corners).min() < limits.angle


def _edge_costs(cost, points, apex, quad):
    """Costs of the five edges around a-b, and of those around c-d instead."""
    a, b, c, d = quad
    sides = [(b, c), (c, a), (a, d), (d, b)]
    beyond = [apex.get((q, p)) for p, q in sides]
    old = [(a, b, c, d)] + [(p, q, r, n) for (p, q), r, n in zip(sides, (a, b, b, a), beyond, strict=True)]
    new = [(c, d, b, a)] + [(p, q, r, n) for (p, q), r, n in zip(sides, (d, d, c, c), beyond, strict=True)]
    return tuple(cost(*np.moveaxis(points[[_canonical(*s) for s in stencils if s[3] is not None]], 1, 0))
                 for stencils in (old, new))


def _canonical(p, q, left, right):
    """The edge p-q from its smaller node, so that its cost does not depend on history."""
    return (p, q, left, right) if p < q else (q, p, right, left)


def _element_costs(cost, points, apex, quad):
    """Costs of the two elements at a-b, and of those at c-d instead."""
    a, b, c, d = quad
    return tuple(cost(*np.moveaxis(points[[_from_smallest(*t) for t in pair]], 1, 0))
                 for pair in ([(c, a, b), (d, b, a)], [(c, a, d), (d, b, c)]))


def _node_costs(cost, points, apex, quad):
    """Costs of the four nodes, before and after, on the elements around them."""
    after = dict(apex)
    _swap(after, quad)
    return tuple(_patch_costs(cost, points, mesh, quad) for mesh in (apex, after))


def _patch_costs(cost, points, apex, quad):
    elements = _elements({edge: c for edge, c in apex.items() if {*edge, c} & {*quad}})
    used, numbers = np.unique(elements, return_inverse=True)
    patch = Mesh._trusted(points[used, :2], numbers.reshape(-1, 3))
    return cost(Interpolant(patch, points[used, 2]))[np.searchsorted(used, quad)]
