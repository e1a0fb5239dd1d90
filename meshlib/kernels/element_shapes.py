"""What several kernels ask of an element: whether it is flat, and its gradient."""

from meshlib.geometry.predicates import FLAT, ROUNDOFF, ULPS

from .groups import Corners, Floats, Vector
from .marks import kernel

INSIDE = 1e-12  # how far below 0 a barycentric coordinate on the boundary may be
MOVED = ULPS * ROUNDOFF  # error of an area, as a fraction of largest coordinate times longest side
CLEARLY = 2.0  # multiple of the bound beyond which the rounding of the bound does not matter


@kernel
def corner(node: Floats, n: int) -> Vector:
    """Coordinates of a node."""
    return node[2 * n], node[2 * n + 1]


@kernel
def minus(p: Vector, q: Vector) -> Vector:
    """The vector from q to p."""
    return p[0] - q[0], p[1] - q[1]


@kernel
def is_flat(node: Floats, corners: Corners, unit: float) -> bool:
    """`predicates.nearly_flat` of one element; ``unit`` is the largest coordinate of the mesh."""
    a, b, c = corner(node, corners[0]), corner(node, corners[1]), corner(node, corners[2])
    u, v = minus(b, a), minus(c, a)
    left, right = u[0] * v[1], u[1] * v[0]
    longest = max(abs(u[0]), abs(u[1]), abs(v[0]), abs(v[1]))
    bound = FLAT * (abs(left) + abs(right)) + MOVED * unit * longest
    if left - right > CLEARLY * bound:
        return False
    return is_flat_in_units(
        (a[0] / unit, a[1] / unit), (b[0] / unit, b[1] / unit), (c[0] / unit, c[1] / unit)
    )


@kernel
def is_flat_in_units(a: Vector, b: Vector, c: Vector) -> bool:
    """`is_flat` for coordinates of up to 1, as products of tiny coordinates underflow."""
    u, v = minus(b, a), minus(c, a)
    left, right = u[0] * v[1], u[1] * v[0]
    longest = max(abs(u[0]), abs(u[1]), abs(v[0]), abs(v[1]))
    moved = MOVED * max(abs(a[0]), abs(a[1]), abs(b[0]), abs(b[1]), abs(c[0]), abs(c[1])) * longest
    return left - right <= FLAT * (abs(left) + abs(right)) + moved


@kernel
def gradient(u: Vector, v: Vector, du: float, dv: float, twice_area: float) -> Vector:
    """Gradient of the plane that rises by du along u and by dv along v; of many planes, for arrays."""
    return (du * v[1] - dv * u[1]) / twice_area, (dv * u[0] - du * v[0]) / twice_area
