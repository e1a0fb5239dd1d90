"""The explorers of the report: what can be chosen in each, and what comes of it."""

import numpy as np

from .. import criteria, problems
from ..approximation.approximate import approximate
from ..explorer import Exploration, Explorer, Scene, menu, slider
from ..movement.smoothed import smoothed
from ..movement.springs import DataSprings
from ..refinement.marking import MARKS
from ..refinement.refined import refined
from ..refinement.splitting import SPLITS
from ..swapping.swapped import swapped
from .studies.section_7_7a_limit import lattice

NORM_NAMES = {1: "L1", 2: "L2", "max": "max", "lexicographic": "lexicographic"}
THESIS = "SR1", "SR2", "SR3", "DD1"
NONE = "none"
PERCENTAGES = range(0, 101, 5)
PASSES = 3
MOST_NODES = 500  # beyond which a refinement is not repeated
NATURAL = "natural"
EQUAL, BY_DATA, SLIDING = "equal", "by the data", "by the data, boundary sliding"
ON_PAGE_SPRINGS = EQUAL, SLIDING
MOST_SWEEPS = 25
SIZES = 10, 20, 30, 50, 75, 100, 150, 200, 300, 400, 500


def _criteria():
    """Label of each cost that swaps can lower; names that abbreviate the title stand before it."""
    found = {
        name: criteria.get(name).title or name
        for place in ("edge", "element")
        for name in criteria.names(place)
    }
    return {
        name: title if "-" in name or title == name else f"{name.upper()}: {title}"
        for name, title in found.items()
    }


def _function(on_page=THESIS):
    return menu("function", "function", tuple(problems.functions), on_page)


def _nodes(on_page=("33", "81")):
    return menu("nodes", "nodes", problems.names(), on_page)


# -- swap by swap (chapter 3) ----------------------------------------------------------------


def _swaps(function, nodes, criterion, norm):
    start, u = problems.mesh(nodes), problems.functions[function]
    found = swapped(start, u, criterion, norm=norm, order=problems.order(nodes))
    title = f"{function} on {nodes} nodes, {criterion.upper()}-{NORM_NAMES[norm]}"
    return Scene(title, u, start, (found.mesh,), found.history, found.swaps, criterion, norm)


SWAPS = Exploration(
    "swaps",
    (_function(), _nodes(), menu("criterion", "criterion", _criteria()), menu("norm", "norm", NORM_NAMES)),
    _swaps,
    {"function": "SR1", "nodes": "33", "criterion": "jnd", "norm": 2},
    "try",
)


def swaps(**settings):
    """The local optimisation procedure, one tried swap after the other."""
    return Explorer(SWAPS, **settings)


# -- refinement (chapter 5) --------------------------------------------------------------------


def _refinement(function, nodes, swap, percentage, refine_by, mark, split):
    start, u = problems.mesh(nodes), problems.functions[function]
    title, mesh, swaps = f"{function} on {nodes} nodes", start, 0
    if swap != NONE:
        found = swapped(start, u, swap, order=problems.order(nodes))
        title, mesh, swaps = f"{title}, {swap.upper()}-L2", found.mesh, found.swaps
    if percentage:
        title += f", {percentage}% by {refine_by.upper()} ({mark}, {split})"
    return Scene(
        title,
        u,
        start,
        _passes(mesh, u, percentage, refine_by, mark, split),
        swaps=swaps,
        cost=refine_by if refine_by in criteria.names("edge") else "abn",
    )


def _passes(mesh, u, percentage, refine_by, mark, split):
    """The meshes after one pass, two and so on, as long as they are small enough to be shown."""
    if not percentage:
        return (mesh,)
    film = []
    for _ in range(PASSES):
        mesh = refined(mesh, u, refine_by, fraction=percentage / 100, mark=mark, split=split).mesh
        if film and mesh.n_nodes > MOST_NODES:
            break
        film.append(mesh)
    return tuple(film)


REFINEMENT = Exploration(
    "refinement",
    (
        _function(),
        _nodes(),
        menu("swap", "swap first", {NONE: NONE} | _criteria(), (NONE,)),
        slider("percentage", "share", PERCENTAGES, "{}%".format),
        menu("refine_by", "by cost", {name: name for name in criteria.names()}, ("abn",)),
        menu("mark", "mark by", MARKS),
        menu("split", "split", tuple(SPLITS)),
    ),
    _refinement,
    {
        "function": "SR1",
        "nodes": "33",
        "swap": NONE,
        "percentage": 20,
        "refine_by": "abn",
        "mark": "edge",
        "split": "centroid",
    },
    "pass",
)


def refinement(**settings):
    """A share of the elements refined, again and again."""
    return Explorer(REFINEMENT, **settings)


# -- limits, orders and movement (chapter 6) -----------------------------------------------------


def _limits(function, nodes, criterion, min_angle):
    start, u = problems.mesh(nodes), problems.functions[function]
    found = swapped(start, u, criterion, order=problems.order(nodes), min_angle=min_angle)
    title = f"{function} on {nodes} nodes, {criterion.upper()}-L2"
    title += f", angles from {min_angle}°" * bool(min_angle)
    return Scene(title, u, start, (found.mesh,), swaps=found.swaps, cost=criterion)


LIMITS = Exploration(
    "limits",
    (
        _function(),
        _nodes(("81", "33")),
        menu("criterion", "criterion", _criteria()),
        slider("min_angle", "least angle", range(31), "{}°".format),
    ),
    _limits,
    {"function": "SR3", "nodes": "81", "criterion": "abn", "min_angle": 8},
)


def limits(**settings):
    """Swapping when small angles are refused (section 6.1)."""
    return Explorer(LIMITS, **settings)


def _orders(function, nodes, criterion, order):
    start, u = problems.mesh(nodes), problems.functions[function]
    edges = (
        problems.order(nodes) if order == NATURAL else np.random.default_rng(order).permutation(start.n_edges)
    )
    found = swapped(start, u, criterion, order=edges)
    title = f"{function} on {nodes} nodes, {criterion.upper()}-L2, order {order}"
    return Scene(title, u, start, (found.mesh,), swaps=found.swaps, cost=criterion)


ORDERS = Exploration(
    "orders",
    (
        _function(),
        _nodes(("33", "33-refined", "81")),
        menu("criterion", "criterion", _criteria(), ("jnd", "abn", "dlp", "dfp")),
        slider("order", "order", (NATURAL, *range(20))),
    ),
    _orders,
    {"function": "DD1", "nodes": "33-refined", "criterion": "abn", "order": 0},
)


def orders(**settings):
    """Swapping by the natural order of the edges and by random ones (section 6.3)."""
    return Explorer(ORDERS, **settings)


def _movement(function, nodes, springs):
    start, u = problems.mesh(nodes), problems.functions[function]
    constants = DataSprings(u) if springs != EQUAL else None
    film, movement = [], np.inf
    while movement and len(film) < MOST_SWEEPS:
        moved = smoothed(film[-1] if film else start, constants, max_sweeps=1, sliding=springs == SLIDING)
        film.append(moved.mesh)
        movement = moved.movement
    return Scene(f"{function} on {nodes} nodes, springs {springs}", u, start, tuple(film))


MOVEMENT = Exploration(
    "movement",
    (_function(), _nodes(), menu("springs", "springs", (EQUAL, BY_DATA, SLIDING), ON_PAGE_SPRINGS)),
    _movement,
    {"function": "SR3", "nodes": "33", "springs": EQUAL},
    "sweep",
)


def movement(**settings):
    """Nodes moved by springs, sweep by sweep (sections 5.4 and 7.4)."""
    return Explorer(MOVEMENT, **settings)


# -- meshes made for a function (chapter 7) ------------------------------------------------------


def _approximation(function, nodes):
    u, start = problems.functions[function], lattice(nodes)
    side = round(start.n_nodes**0.5)
    return Scene(
        f"{function} by {nodes} nodes, beside a lattice of {side} × {side}",
        u,
        start,
        (approximate(u, nodes=nodes).mesh,),
    )


APPROXIMATION = Exploration(
    "approximation",
    (_function(("franke", "SR3", "DD1")), slider("nodes", "nodes", range(10, 501, 5), on_page=SIZES)),
    _approximation,
    {"function": "franke", "nodes": 100},
)


def approximation(**settings):
    """The best mesh of so many nodes that `approximate` finds, beside a lattice."""
    return Explorer(APPROXIMATION, **settings)


ALL = {
    exploration.name: exploration
    for exploration in (SWAPS, REFINEMENT, LIMITS, ORDERS, MOVEMENT, APPROXIMATION)
}
