"""The results file as the tables and pictures of the page "Performance"."""

import json
from functools import cache
from math import nan
from pathlib import Path
from statistics import median

from cases import KINDS

from meshlib import plotting
from meshlib.thesis.tables.markup import grid, markdown

RESULTS = Path(__file__).with_name("results.json")
MILLION = 1_000_000
MARKERS, COLOURS = "osv^D", [plotting.PALETTE[c] for c in ("blue", "green", "sky", "orange", "black")]
PANEL = 3.1  # inches
# A goal: text, of which measure, nodes, what is divided by what ("ours" or a peer), and the limit.
GOALS = (
    *(
        (
            f"adjacency and swapping with {name} / Delaunay",
            "swapping",
            MILLION,
            name,
            "SciPy Delaunay",
            "<=",
            goal,
        )
        for name, goal in (("JND-L2", 0.10), ("ABN-L1", 0.20), ("ABN-L2", 0.20))
    ),
    *(
        ("matplotlib / values on a grid", "grid", n, "matplotlib", "on_grid", ">=", goal)
        for n, goal in ((10_000, 35), (100_000, 90), (MILLION, 300))
    ),
    ("SciPy / values at scattered points", "scattered", MILLION, "SciPy LinearND", "Interpolant", ">=", 5),
    ("scikit-fem / red-green refinement", "refinement", MILLION, "scikit-fem", "red-green", ">=", 3),
    *(
        (f"{peer} / quality", "quality", MILLION, peer, "three measures", ">=", 1)
        for peer in ("VTK", "matplotlib")
    ),
)
GROWTH = (
    ("swapping", "JND-L2"),
    ("refinement", "red-green"),
    ("grid", "on_grid"),
    ("scattered", "Interpolant"),
    ("quality", "three measures"),
)
MOST_GROWTH = 13
SIGNS = {"<=": "≤", ">=": "≥"}
STARTS = {
    "import meshlib": 0.25,
    "first swapping, 81 nodes": 0.2,
    "without numba, 33 nodes": 0.006,
    "without numba, 81 nodes": 0.006,
}


@cache
def results():
    """What the last run wrote."""
    return json.loads(RESULTS.read_text())


def found(measure, kind, nodes, name, field="times"):
    """Median seconds, or megabytes, of one call; None if it was not measured."""
    for line in results()["results"]:
        here = line["measure"], line["kind"], line["nodes"], line["name"]
        if here == (measure, kind, nodes, name):
            return median(line["times"]) if field == "times" else line[field]
    return None


def machine():
    """The machine and the versions, in a sentence."""
    return markdown(sentence(results()))


def sentence(about):
    """When, on what and with what something was measured."""
    versions = ", ".join(f"{name} {number}" for name, number in about["versions"].items())
    return (
        f"Measured on {about['date']} on {about['cores']} cores of {about['processor']} "
        f"({about['system']}, {about['machine']}), Python {about['python']}, {versions}."
    )


def short_answer():
    """What swapping costs, beside the mesh that it starts from."""
    ours, peer = _of_random("swapping", "JND-L2"), _of_random("swapping", "SciPy Delaunay")
    return markdown(
        "The short answer: swapping edges until the mesh of a million nodes is locally optimal "
        f"takes {ours / peer:.0%} of the time in which its Delaunay triangulation was built."
    )


def grid_short():
    """Why a grid on many nodes falls short."""
    given, placed, numbering = (
        _of_random("numbering", name) for name in ("grid as given", "grid along the curve", "along_curve")
    )
    return markdown(
        "*A grid on a million nodes.* Elements and nodes of a random mesh are stored in an order that has "
        "nothing to do with their places, so each of the six million look-ups of a corner waits for memory, "
        "and so does each write to the grid. On the same mesh numbered by place it takes "
        f"{placed / given:.0%} of the time; numbering takes {numbering / (given - placed):.1f} times what "
        "it saves."
    )


def growth_short():
    """Why some calls grow faster than the number of nodes."""
    times = sorted((_growth(measure, name), measure) for measure, name in GROWTH)
    return markdown(
        "*Growth.* For the same reason ten times the nodes take more than ten times as long, "
        f"{', '.join(f'{measure} {growth:.1f}' for growth, measure in times)}: a hundred thousand nodes fit "
        "into the second level of the cache, a million do not, and every large array is new memory that the "
        "system has to provide page by page."
    )


def _growth(measure, name):
    return _of_random(measure, name) / _of_random(measure, name, MILLION // 10)


def _of_random(measure, name, nodes=MILLION):
    """Seconds on random nodes; NaN if that was not measured."""
    return found(measure, "random", nodes, name) or nan


def goals():
    """Every goal, what was measured, and whether that meets it."""
    rows = [*_ratios(), *_growths(), *_memory(), *_starts()]
    return markdown(grid(("Measure", "Nodes", "Goal", "Measured", ""), rows))


def _ratios():
    for text, measure, nodes, above, below, sign, goal in GOALS:
        over, under = (found(measure, "random", nodes, name) for name in (above, below))
        yield _row(text, nodes, sign, goal, over and under and over / under)


def _growths():
    for measure, name in GROWTH:
        yield _row(
            f"growth of {measure} ({name}), time at ten times the nodes / time",
            MILLION,
            "<=",
            MOST_GROWTH,
            _growth(measure, name),
        )


def _memory():
    ours, peer = (
        found("swapping", "random", MILLION, name, "memory") for name in ("JND-L2", "SciPy Delaunay")
    )
    yield _row("peak memory of swapping / of Delaunay", MILLION, "<=", 1, ours and peer and ours / peer)


def _starts():
    for name, goal in STARTS.items():
        yield _row(f"{name}, seconds", "", "<=", goal, found("starting", "", 0, name))


def _row(text, nodes, sign, goal, value):
    return text, _count(nodes), *verdict(value, sign, goal)


def verdict(value, sign, goal):
    """A goal, what was measured, and whether that meets it, as three cells."""
    about = f"{SIGNS[sign]}&nbsp;{goal:g}"
    if value is None or value != value:
        return about, "not measured", ""
    met = value <= goal if sign == "<=" else value >= goal
    return about, f"{value:.3g}", "met" if met else "missed"


def _count(nodes):
    return f"{nodes:,}" if nodes else ""


def starting():
    """Times of new processes."""
    lines = [line for line in results()["results"] if line["measure"] == "starting"]
    return markdown(
        grid(
            ("In a new process", "Seconds"),
            [(line["name"], f"{median(line['times']):.3g}") for line in lines],
        )
    )


def everything():
    """All times and memory, a row for each call and kind of nodes."""
    sizes = sorted({line["nodes"] for line in results()["results"]} - {0})
    rows = [_times(measure, name, kind, sizes) for measure, name in _calls() for kind in KINDS]
    return markdown(grid(("Measure", "Call", "Nodes are", *(f"{n:,}" for n in sizes)), rows))


def _calls():
    return dict.fromkeys((line["measure"], line["name"]) for line in results()["results"] if line["nodes"])


def _times(measure, name, kind, sizes):
    cells = []
    for n in sizes:
        time, memory = (found(measure, kind, n, name, field) for field in ("times", "memory"))
        space = "" if memory is None else f", {memory:.0f} MB"
        cells.append("" if time is None else f"{time:.3g} s{space}")
    return (measure, name, kind, *cells)


def picture(*measures):
    """Time against the number of nodes, a row of panels for each measure, a panel for each kind of nodes."""
    pyplot = plotting.look.pyplot()
    with plotting.style():
        figure, rows = pyplot.subplots(
            len(measures),
            len(KINDS),
            layout="constrained",
            squeeze=False,
            sharex=True,
            sharey="row",
            figsize=(plotting.WIDTH, PANEL * len(measures)),
        )
        for measure, row in zip(measures, rows, strict=True):
            for kind, ax in zip(KINDS, row, strict=True):
                _curves(ax, measure, kind)
            row[0].set_ylabel(f"{measure}, seconds")
            row[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
        for kind, ax in zip(KINDS, rows[0], strict=True):
            ax.set_title(kind)
        for ax in rows[-1]:
            ax.set_xlabel("nodes")
    return figure


def _curves(ax, measure, kind):
    lines = [line for line in results()["results"] if line["measure"] == measure and line["kind"] == kind]
    names = list(dict.fromkeys(line["name"] for line in lines))
    for name, marker, colour in zip(names, MARKERS, COLOURS, strict=False):
        own = [line for line in lines if line["name"] == name]
        nodes, times = [line["nodes"] for line in own], [median(line["times"]) for line in own]
        peer = own[0]["who"] == "peer"
        ax.plot(
            nodes,
            times,
            marker=marker,
            markersize=5,
            label=name,
            linestyle="--" if peer else "-",
            color=plotting.ACCENT if peer else colour,
        )
    ax.set(xscale="log", yscale="log")
    ax.spines[["top", "right"]].set_visible(False)
    ax.grid(True, color=plotting.FAINT, linewidth=0.5)
