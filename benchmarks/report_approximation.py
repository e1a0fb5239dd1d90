"""Meshes made for functions, as the tables and pictures of the page "Performance"."""

from statistics import median

from report import results, sentence, verdict

from meshlib import plotting
from meshlib.thesis.studies.section_7_7a_limit import ZIGZAG
from meshlib.thesis.tables.markup import grid, markdown

RATES = {"B": 1, "K": 2}  # of the error in the number of nodes, by the constant of a function
EQUAL = "x² + y²", "x² − y²"  # curved alike everywhere
LARGE, LARGEST = 6400, 25_600  # nodes
NEAR, FRONT = 1.05, 1.15  # of the limit
COLUMNS = 5  # of panels
PANEL = 1.9, 2.3  # inches
WHO = {"ours": ("o", "blue", "-"), "mmg2d": ("s", "vermillion", "--"), "pydelatin": ("^", "green", "--")}


def part():
    """What the last run wrote of this part."""
    return results().get("approximate", {"lines": [], "B": {}, "K": {}})


def lines(name, who, nodes):
    """Lines of a function for so many nodes."""
    asked = name, who, nodes
    return [row for row in part()["lines"] if (row["function"], row["who"], row["nodes"]) == asked]


def names():
    """The functions that were measured."""
    return tuple(dict.fromkeys(row["function"] for row in part()["lines"]))


def sizes():
    """The numbers of nodes."""
    return tuple(sorted({row["nodes"] for row in part()["lines"]}))


# -- measures: of a function and a number of nodes, None where that was not measured ---------------


def efficiency(name, nodes):
    """Error times elements over the limit, of the worst seed."""
    bound, rows = part()["B"].get(name), lines(name, "ours", nodes)
    return max(row["error"] * row["elements"] for row in rows) / bound if bound and rows else None


def over_strips(name, nodes):
    """Error over that of parallel strips, of the worst seed."""
    constant, rows = part()["K"].get(name), lines(name, "ours", nodes)
    strips = (nodes - 2) / 2
    return max(row["error"] for row in rows) * strips**2 / constant if constant and rows else None


def our(name, nodes, field="error"):
    """The median of our seeds."""
    rows = lines(name, "ours", nodes)
    return median(row[field] for row in rows) if rows else None


def at_equal_nodes(name, row):
    """The error of a peer with so many nodes as were asked for, by the rate at which errors fall."""
    rate = RATES["K" if name in part()["K"] else "B"]
    return row["error"] * (row["found"] / row["nodes"]) ** rate


def best_remeshed(name, nodes):
    """The line of MMG with the floor that serves it best."""
    return min(lines(name, "mmg2d", nodes), key=lambda row: at_equal_nodes(name, row), default=None)


def mmg_error(name, nodes):
    """Error of MMG over ours."""
    row, own = best_remeshed(name, nodes), our(name, nodes)
    return at_equal_nodes(name, row) / own if row and own else None


def mmg_time(name, nodes):
    """Our time over that of all passes of MMG."""
    row, own = best_remeshed(name, nodes), our(name, nodes, "seconds")
    return own / row["seconds"] if row and own else None


def greedy_error(name, nodes):
    """Error of pydelatin over ours."""
    rows, own = lines(name, "pydelatin", nodes), our(name, nodes)
    return at_equal_nodes(name, rows[0]) / own if rows and own else None


def greedy_largest(name, nodes):
    """Largest error of pydelatin over that of our mesh for the largest error."""
    rows, own = lines(name, "pydelatin", nodes), lines(name, "ours, max", nodes)
    return rows[0]["largest"] / own[0]["largest"] if rows and own else None


def growth(name, nodes):
    """Time over that for a quarter of the nodes."""
    large, small = (our(name, n, "seconds") for n in (nodes, nodes // 4))
    return large / small if large and small else None


def invalid(name, nodes):
    """How many of our meshes are not valid."""
    rows = lines(name, "ours", nodes)
    return sum(not row["valid"] for row in rows) if rows else None


def unconfirmed(name, nodes):
    """The error that approximate reports against the one by another quadrature, in per cent."""
    rows = lines(name, "ours", nodes)
    return max(100 * abs(row["claimed"] / row["error"] - 1) for row in rows) if rows else None


def tolerance(name, nodes):
    """Nodes that a tolerance takes over the fewest that bisection finds."""
    rows = lines(name, "tolerance", nodes)
    return rows[0]["found"] / rows[0]["bisected"] if rows else None


STEEP = "Franke", "ring", "SR3"
# A goal: what is measured, on which functions (None: all) for how many nodes (None: all), and the limit.
GOALS = (
    ("error · elements / limit", efficiency, ("Franke", "ring", "DD1", "SR3"), (LARGE,), "<=", NEAR),
    (
        "the same on a front that leaves the domain, and on a mixture",
        efficiency,
        ("arc", "mixture"),
        (1600,),
        "<=",
        FRONT,
    ),
    ("error / error of parallel strips", over_strips, None, None, "<=", 1),
    ("$L_2$ error of MMG / ours, steep or smooth", mmg_error, STEEP, None, ">=", 1.25),
    ("$L_2$ error of MMG / ours, anywhere", mmg_error, None, None, ">=", 1),
    ("our time / time of MMG", mmg_time, None, (LARGE, LARGEST), "<=", 2),
    ("$L_2$ error of pydelatin / ours", greedy_error, None, None, ">=", 1.7),
    ("largest error of pydelatin / ours", greedy_largest, None, None, ">=", 1),
    ("time / time for a quarter of the nodes", growth, None, (LARGEST,), "<=", 6),
    ("meshes that are not valid", invalid, None, None, "<=", 0),
    ("error reported / by another quadrature: difference, %", unconfirmed, None, None, "<=", 0.5),
    ("nodes for a tolerance / fewest by bisection", tolerance, None, None, "<=", 1.03),
)


def worst(measure, functions, nodes, sign):
    """The worst value among functions and numbers of nodes, and where; None if none was measured."""
    found = [
        (value, name, n)
        for name in functions or names()
        for n in nodes or sizes()
        if (value := measure(name, n)) is not None
    ]
    return (max if sign == "<=" else min)(found, default=None)


# -- what is shown -------------------------------------------------------------------------------


def machine():
    """The machine and the versions of this part."""
    return markdown(sentence(part()))


def goals():
    """Every goal, the worst that was measured, where, and whether it meets the goal."""
    rows = []
    for text, measure, functions, nodes, sign, goal in GOALS:
        found = worst(measure, functions, nodes, sign)
        value, where = (found[0], f"{found[1]}, {found[2]:,}" * bool(found[0])) if found else (None, "")
        rows.append((text, where, *verdict(value, sign, goal)))
    return markdown(grid(("Measure", "Worst: function, nodes", "Goal", "Measured", ""), rows))


TABLE = {
    "error · elements / limit": efficiency,
    "error / strips": over_strips,
    "MMG / ours": mmg_error,
    "our time / MMG's": mmg_time,
    "pydelatin / ours": greedy_error,
    "largest error": greedy_largest,
}


def everything():
    """All of it, a row for each function and number of nodes."""
    rows = [
        (
            name,
            f"{nodes:,}",
            *(_cell(measure(name, nodes)) for measure in TABLE.values()),
            f"{our(name, nodes, 'seconds'):.3g}",
        )
        for name in names()
        for nodes in sizes()
    ]
    return markdown(grid(("Function", "Nodes", *TABLE, "seconds"), rows))


def _cell(value):
    return "" if value is None else f"{value:.3g}"


def picture():
    """Error against the number of nodes, a panel for each function."""
    pyplot, shown = plotting.look.pyplot(), names()
    rows = -(-len(shown) // COLUMNS)
    with plotting.style():
        figure, axes = pyplot.subplots(
            rows,
            COLUMNS,
            layout="constrained",
            squeeze=False,
            sharex=True,
            figsize=(plotting.WIDTH, PANEL[1] * rows),
        )
        for ax in axes.flat[len(shown) :]:
            ax.set_visible(False)
        for ax, name in zip(axes.flat, shown, strict=False):
            _curves(ax, name)
        figure.legend(*axes.flat[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
        for row in axes:
            row[0].set_ylabel("$L_2$ error")
        for ax in axes[-1]:
            ax.set_xlabel("nodes")
    return figure


def _curves(ax, name):
    for who, (marker, colour, dashes) in WHO.items():
        found = {n: _error(name, who, n) for n in sizes()}
        points = [(n, error) for n, error in found.items() if error is not None]
        ax.loglog(
            *zip(*points, strict=True),
            marker=marker,
            markersize=4,
            linestyle=dashes,
            color=plotting.PALETTE[colour],
            label=who,
        )
    ax.loglog(sizes(), [least(name, n) for n in sizes()], color=plotting.FAINT, label="limit", zorder=0)
    ticks = sorted({sizes()[0], sizes()[len(sizes()) // 2], sizes()[-1]})
    ax.minorticks_off()
    ax.set_xticks(ticks, ticks)
    ax.set_title(name)
    ax.spines[["top", "right"]].set_visible(False)


def _error(name, who, nodes):
    if who == "ours":
        return our(name, nodes)
    row = best_remeshed(name, nodes) if who == "mmg2d" else next(iter(lines(name, who, nodes)), None)
    return row and at_equal_nodes(name, row)


def least(name, nodes):
    """The limit for so many nodes: twice as many elements, or the best strips."""
    found = part()
    if name in found["K"]:
        return ZIGZAG * found["K"][name] / ((nodes - 2) / 2) ** 2
    return found["B"][name] / (2 * nodes)


def falls_short():
    """The goals that are missed, by how much, and what bounds them."""
    missed = []
    for text, measure, functions, nodes, sign, goal in GOALS:
        found = worst(measure, functions, nodes, sign)
        if found and verdict(found[0], sign, goal)[-1] == "missed":
            value, name, n = found
            reason = REASONS.get(measure, lambda name, nodes: "")(name, n)
            missed.append(f"*{text}*: {value:.3g} instead of {goal:g} for {name} on {n:,} nodes. {reason}")
    return markdown("\n\n".join(missed) or "All goals that were measured are met.")


def _bound_of_greedy(name, nodes):
    """How far above the limit pydelatin is, which no mesh can exceed."""
    if name not in part()["B"]:
        return ""
    row = lines(name, "pydelatin", nodes)[0]
    possible = row["error"] * row["elements"] / part()["B"][name]
    alike = " The function is curved alike everywhere, and little can be adapted." if name in EQUAL else ""
    return (
        f"The mesh of pydelatin is {possible:.2f} times above the limit there; no mesh could make the "
        f"ratio much larger.{alike}"
    )


def _near_limit(name, nodes):
    """What the theorem does not say about so many nodes."""
    values = [efficiency(other, nodes) for other in names()]
    near = [value is not None and value <= NEAR for value in values]
    return (
        f"The limit is one for many elements; at {nodes:,} nodes {sum(near)} of "
        f"{len(part()['B'])} functions are within {NEAR - 1:.0%} of it."
    )


def _already_near(name, nodes):
    """How near the limit MMG is itself."""
    if name not in part()["B"]:
        return ""
    row = best_remeshed(name, nodes)
    return (
        f"MMG comes within {row['error'] * row['elements'] / part()['B'][name]:.2f} times the limit "
        f"there, ours within {efficiency(name, nodes):.2f}."
    )


def _largest(name, nodes):
    """The errors themselves, also of our meshes for the mean square."""
    peer, own = (lines(name, who, nodes)[0]["largest"] for who in ("pydelatin", "ours, max"))
    return (
        f"The errors are {peer:.3g} and {own:.3g}; meshes made for the $L_2$ error have "
        f"{our(name, nodes, 'largest'):.3g}."
    )


def _seconds(name, nodes):
    """The times themselves."""
    return f"It takes {our(name, nodes, 'seconds'):.3g} s."


REASONS = {
    efficiency: _near_limit,
    mmg_error: _already_near,
    mmg_time: _seconds,
    growth: _seconds,
    greedy_error: _bound_of_greedy,
    greedy_largest: _largest,
}
