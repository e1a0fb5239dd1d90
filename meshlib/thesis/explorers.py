"""The explorers of the report: what can be chosen in each, and what comes of it."""

from typing import Any

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
PERCENTAGES = range(0, 101, 5)  # shares of the elements
PASSES = 3  # refinements, one after the other
MOST_NODES = 500  # nodes of a mesh beyond which a refinement is not repeated
NATURAL = "natural"
EQUAL, BY_DATA, SLIDING = "equal", "by the data", "by the data, boundary sliding"
ON_PAGE_SPRINGS = EQUAL, SLIDING
MOST_SWEEPS = 25  # sweeps of moving nodes that a film shows
TOLD_BY_ABN = "smallest-angle", "largest-angle", "gradient-spread"  # criteria of elements and nodes
SIZES = 10, 20, 30, 50, 75, 100, 150, 200, 300, 400, 500


def _criteria():
    """Label of each registered criterion; names that abbreviate the title stand before it."""
    found = {name: criteria.get(name).title or name for name in criteria.names()}
    return {
        name: title if "-" in name or title == name else f"{name.upper()}: {title}"
        for name, title in found.items()
    }


def _quick_criteria():
    """Names of the criteria by which swaps are quick enough for all settings of a page."""
    return criteria.names("edge") + criteria.names("element")


def _functions():
    return tuple(problems.functions)


def _function(on_page=THESIS):
    return menu("function", "function", _functions, on_page)


def _nodes(on_page=("33", "81")):
    return menu("nodes", "nodes", problems.names, on_page)


def _criterion(on_page=_quick_criteria):
    return menu("criterion", "criterion", _criteria, on_page)


# -- swap by swap (chapter 3) ----------------------------------------------------------------


def _swaps(function, nodes, criterion, norm):
    start, u = problems.mesh(nodes), problems.functions[function]
    found = swapped(start, u, criterion, norm=norm, order=problems.order(nodes))
    title = f"{function} on {nodes} nodes, {criterion.upper()}-{NORM_NAMES[norm]}"
    return Scene(title, u, start, (found.mesh,), found.history, found.swaps, criterion, norm)


SWAPS = Exploration(
    "swaps",
    (_function(), _nodes(), _criterion(), menu("norm", "norm", NORM_NAMES)),
    _swaps,
    {"function": "SR1", "nodes": "33", "criterion": "jnd", "norm": 2},
    "try",
)


def swaps(**settings: Any) -> Explorer:
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
        cost="abn" if refine_by in TOLD_BY_ABN else refine_by,
    )


def _swap_first():
    return {NONE: NONE} | _criteria()


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
        menu("swap", "swap first", _swap_first, (NONE,)),
        slider("percentage", "share", PERCENTAGES, "{}%".format),
        menu("refine_by", "by cost", criteria.names, ("abn",)),
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


def refinement(**settings: Any) -> Explorer:
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
        _criterion(),
        slider("min_angle", "least angle", range(31), "{}°".format),
    ),
    _limits,
    {"function": "SR3", "nodes": "81", "criterion": "abn", "min_angle": 8},
)


def limits(**settings: Any) -> Explorer:
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
        _criterion(on_page=("jnd", "abn", "dlp", "dfp")),
        slider("order", "order", (NATURAL, *range(20))),
    ),
    _orders,
    {"function": "DD1", "nodes": "33-refined", "criterion": "abn", "order": 0},
)


def orders(**settings: Any) -> Explorer:
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


def movement(**settings: Any) -> Explorer:
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


def approximation(**settings: Any) -> Explorer:
    """Meshes of a given number of nodes that `approximate` finds, beside a lattice."""
    return Explorer(APPROXIMATION, **settings)


ALL = {
    exploration.name: exploration
    for exploration in (SWAPS, REFINEMENT, LIMITS, ORDERS, MOVEMENT, APPROXIMATION)
}
