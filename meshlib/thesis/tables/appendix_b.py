"""The tables of the appendix on reproducibility, every cell computed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ... import criteria, problems
from ..record import printed
from ..studies import appendix_b as studies
from ..studies.experiments import EXPERIMENTS, run
from ..studies.measures import L2, l2_error
from .markup import grid, markdown, percent

if TYPE_CHECKING:
    from IPython.display import Markdown

COLUMNS = {
    ("maximum_angle", "mean"): "angle, mean",
    ("maximum_angle", "max"): "max",
    ("skewness", "mean"): "skewness, mean",
    ("skewness", "max"): "max",
    ("aspect_ratio", "mean"): "aspect, mean",
    ("aspect_ratio", "max"): "max",
    L2: "$L_2$",
}


def orders() -> Markdown:
    """What many random edge orders lead to, beside what is printed."""
    errors = "$L_2$ least", "median", "largest", "printed"
    shares = "Orders that give it", "Orders that give the column"
    head = ("Experiment", "Local optima", *errors, *shares)
    return markdown(grid(head, [_orders(key) for key in studies.SWAPS]))


def _orders(key: str) -> tuple:
    study, column = studies.orders(key), printed.texts(key)
    spread = (f"{error:.5f}" for error in np.quantile(study.values(L2), (0, 0.5, 1)))
    shares = study.share(L2, column[L2]), study.share_of_column(column)
    return studies.title(key), len(study.optima), *spread, column[L2], *map(percent, shares)


def shares() -> Markdown:
    """Share of the orders that give each printed number."""
    rows = []
    for key in studies.SWAPS:
        study, column = studies.orders(key), printed.texts(key)
        rows.append((studies.title(key), *(percent(study.share(which, column[which])) for which in COLUMNS)))
    return markdown(grid(("Experiment", *COLUMNS.values()), rows))


def dependence() -> Markdown:
    """What each printed number depends on: the method, the edge order, noise, or both of these."""
    rows = []
    for key in filter(printed.texts, EXPERIMENTS):
        words = studies.depends_on(key)
        name = studies.title(key) if key in studies.SWAPS else key.replace("-", ", ", 2).replace("-", " ")
        rows.append((name, *(words.get(which, "") for which in COLUMNS)))
    return markdown(grid(("Experiment", *COLUMNS.values()), rows))


def quadrature() -> Markdown:
    """Every printed error by three trapezium rules and by quadrature that has settled."""
    head = ("", "Printed", "$101^2$ points", "$200^2$ points", "$201^2$ points", "Settled")
    rows = [_quadrature(number) for number in printed.numbers() if number.measure == L2[0]]
    return markdown(grid(head, rows))


def _quadrature(number: printed.Printed) -> tuple:
    by_grid, settled, fitted = studies.quadrature(number)
    name = f"{number.table}, {number.column}" + fitted * " (fitted)"
    cells = [_marked(value, number.text) for value in by_grid]
    return name, number.text, *cells, printed.digits(settled, number.text)


def _marked(value: float, text: str) -> str:
    """A value, in bold if it does not match the printed text."""
    found = printed.digits(value, text)
    return found if printed.matches(value, text) else f"**{found}**"


def optimum() -> Markdown:
    """Cost and error of the printed meshes, of the best of many orders, and of the proved optima."""
    meshes = "Printed mesh", "Best of the orders", "Proved optimum"
    head = ("Column", "Measured by", *meshes, "Printed above it by")
    return markdown(grid(head, [row for key in studies.SMALL for row in _optimum(key)]))


def _optimum(key: str) -> Iterator[tuple]:
    """Two rows, the cost by the criterion and the L2 error."""
    result, study = run(key), studies.orders(key)
    swap, function = result.experiment.operate, result.experiment.function
    u = problems.functions[function]
    costs = criteria.costs(result.mesh, u, swap.criterion)
    cost = float(np.linalg.norm(costs, swap.norm))
    best = studies.best(function, swap.criterion, swap.norm).cost_after
    cells = (f"{value:.4f}" for value in (cost, study.optima.costs.min(), best))
    yield studies.title(key), swap.title, *cells, _excess(cost, best)
    error = result.measures[L2]
    least = l2_error(studies.best(function, "l2", 2).mesh, u)
    cells = (f"{value:.6f}" for value in (error, study.measures[L2].min(), least))
    yield "", "$L_2$ error", *cells, _excess(error, least)


def _excess(value: float, best: float) -> str:
    return f"{100 * abs(value / best - 1):.1f} %"
