"""The tables of the appendix on reproducibility, every cell computed."""

import numpy as np

from ... import criteria, problems
from ..record import printed
from ..studies import appendix_b as studies
from ..studies.experiments import EXPERIMENTS, run
from ..studies.measures import L2, l2_error
from .numbered import grid, markdown

COLUMNS = {
    ("maximum_angle", "mean"): "angle, mean",
    ("maximum_angle", "max"): "max",
    ("skewness", "mean"): "skewness, mean",
    ("skewness", "max"): "max",
    ("aspect_ratio", "mean"): "aspect, mean",
    ("aspect_ratio", "max"): "max",
    L2: "$L_2$",
}


def title(key):
    """An experiment of edge swapping for people, for example ``SR2, 81, JND-L2``."""
    experiment = EXPERIMENTS[key]
    limit = f", {experiment.operate.min_angle:g}°" if experiment.operate.min_angle else ""
    shuffled = ", reordered" if experiment.shuffled else ""
    return f"{experiment.function}, {experiment.nodes}, {experiment.operate.title}{limit}{shuffled}"


def orders():
    """What many random edge orders lead to, beside what is printed."""
    head = (
        "Experiment",
        "Local optima",
        "$L_2$ least",
        "median",
        "largest",
        "printed",
        "Orders that give it",
        "Orders that give the column",
    )
    rows = []
    for key in studies.SWAPS:
        study, column = studies.orders(key), printed.texts(key)
        errors = study.values(L2)
        spread = (f"{error:.5f}" for error in np.quantile(errors, (0, 0.5, 1)))
        rows.append(
            (
                title(key),
                len(study.optima),
                *spread,
                column[L2],
                percent(study.share(L2, column[L2])),
                percent(study.share_of_column(column)),
            )
        )
    return markdown(grid(head, rows))


def shares():
    """Share of the orders that give each printed number."""
    rows = []
    for key in studies.SWAPS:
        study, column = studies.orders(key), printed.texts(key)
        rows.append((title(key), *(percent(study.share(which, column[which])) for which in COLUMNS)))
    return markdown(grid(("Experiment", *COLUMNS.values()), rows))


def percent(share):
    """A share as a percentage, with two decimals where it is nearly, but not, 0 or 1."""
    return f"{100 * share:.2f} %" if 0 < min(share, 1 - share) < 0.01 else f"{100 * share:.0f} %"


def dependence():
    """What each printed number depends on: the method, the edge order, noise, or both."""
    rows = []
    for key in filter(printed.texts, EXPERIMENTS):
        words = studies.depends_on(key)
        name = title(key) if key in studies.SWAPS else key.replace("-", ", ", 2).replace("-", " ")
        rows.append((name, *(words.get(which, "") for which in COLUMNS)))
    return markdown(grid(("Experiment", *COLUMNS.values()), rows))


def quadrature():
    """Every printed error by three trapezium rules and by quadrature that has settled."""
    head = ("", "Printed", "$101^2$ points", "$200^2$ points", "$201^2$ points", "Settled")
    rows = []
    for number in printed.numbers():
        if number.measure == L2[0]:
            *by_grid, settled, searched = studies.quadrature(number)
            cells = [_marked(value, number.text) for value in by_grid]
            rows.append(
                (
                    f"{number.table}, {number.column}" + searched * " (fitted)",
                    number.text,
                    *cells,
                    printed.digits(settled, number.text),
                )
            )
    return markdown(grid(head, rows))


def _marked(value, text):
    """A value, set off if it is not printed so."""
    found = printed.digits(value, text)
    return found if printed.matches(value, text) else f"**{found}**"


def optimum():
    """Cost and error of the printed meshes, of the best of many orders, and of the proved optima."""
    head = (
        "Column",
        "Measured by",
        "Printed mesh",
        "Best of the orders",
        "Proved optimum",
        "Printed above it by",
    )
    rows = []
    for key in studies.SMALL:
        result, study = run(key), studies.orders(key)
        swap, function = result.experiment.operate, result.experiment.function
        cost = np.linalg.norm(criteria.costs(result.mesh, result.function, swap.criterion), swap.norm)
        best = studies.best(function, swap.criterion, swap.norm).cost_after
        error = l2_error(studies.best(function, "l2", 2).mesh, problems.functions[function])
        least = study.optima.costs.min()
        values = (f"{value:.4f}" for value in (cost, least, best))
        rows.append((title(key), swap.title, *values, _excess(cost, best)))
        rows.append(
            (
                "",
                "$L_2$ error",
                f"{result.measures[L2]:.6f}",
                f"{study.measures[L2].min():.6f}",
                f"{error:.6f}",
                _excess(result.measures[L2], error),
            )
        )
    return markdown(grid(head, rows))


def _excess(value, best):
    return f"{100 * abs(value / best - 1):.1f} %"
