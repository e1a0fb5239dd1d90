"""What several kernels ask of an element: whether it is flat, and its gradient."""

from meshlib.geometry.predicates import FLAT, ROUNDOFF, ULPS

from .backend import compiled

INSIDE = 1e-12  # barycentric coordinates this far below 0 still count as on the boundary
MOVED = ULPS * ROUNDOFF
CLEARLY = 2.0  # times the bound, beyond which its own rounding does not matter


@compiled
def is_flat(node, a, b, c, unit):
    """`predicates.nearly_flat` of one element; ``unit`` is the largest coordinate of all."""
    ux, uy = node[2 * b] - node[2 * a], node[2 * b + 1] - node[2 * a + 1]
    vx, vy = node[2 * c] - node[2 * a], node[2 * c + 1] - node[2 * a + 1]
    left, right = ux * vy, uy * vx
    longest = max(abs(ux), abs(uy), abs(vx), abs(vy))
    bound = FLAT * (abs(left) + abs(right)) + MOVED * unit * longest
    return not left - right > CLEARLY * bound and is_flat_in_units(
        node[2 * a] / unit,
        node[2 * a + 1] / unit,
        node[2 * b] / unit,
        node[2 * b + 1] / unit,
        node[2 * c] / unit,
        node[2 * c + 1] / unit,
    )


@compiled
def is_flat_in_units(ax, ay, bx, by, cx, cy):
    """The same for coordinates of up to 1, as products of tiny ones underflow."""
    ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
    left, right = ux * vy, uy * vx
    longest = max(abs(ux), abs(uy), abs(vx), abs(vy))
    moved = MOVED * max(abs(ax), abs(ay), abs(bx), abs(by), abs(cx), abs(cy)) * longest
    return left - right <= FLAT * (abs(left) + abs(right)) + moved


@compiled
def plane(ux, uy, vx, vy, du, dv):
    """Gradient of the plane that grows by du along u and by dv along v."""
    twice_area = ux * vy - uy * vx
    return (du * vy - dv * uy) / twice_area, (dv * ux - du * vx) / twice_area
