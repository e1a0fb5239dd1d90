"""The controls of the explorer: standard ipywidgets, one for each setting."""
from .. import criteria, norms, problems
from ..errors import missing_extra
from ..marking import MARKS
from ..splitting import SPLITS
from .engine import LARGEST_ANGLE_LIMIT, NO_SWAPS, NORM_NAMES

try:
    import ipywidgets as widgets
except ImportError as error:
    raise missing_extra("ipywidgets", "widgets") from error

FRACTION_STEP = 0.05
GROUPS = {"Data": ("problem", "nodes"), "Swap edges": ("criterion", "norm", "min_angle"),
          "Then refine": ("fraction", "refine_by", "mark", "split")}
SHOWN = ("start mesh", "adapted mesh")
COLUMN = "repeat(auto-fit, minmax(min(19rem, 100%), 1fr))"


def build(settings):
    """A control for each setting, by name, set to the values of the settings."""
    swapping = [c for place in ("edge", "element") for c in criteria.names(place)]
    controls = {
        "problem": _dropdown("function", tuple(problems.functions)),
        "nodes": _dropdown("nodes", problems.names),
        "criterion": _dropdown("criterion", [(NO_SWAPS, NO_SWAPS), *map(_titled, swapping)]),
        "norm": _dropdown("norm", [(NORM_NAMES[norm], norm) for norm in norms.NORMS]),
        "min_angle": _slider(widgets.IntSlider, "min. angle (°)", max=LARGEST_ANGLE_LIMIT),
        "fraction": _slider(widgets.FloatSlider, "share", max=1.0, step=FRACTION_STEP,
                            readout_format=".0%"),
        "refine_by": _dropdown("by cost", [_titled(name) for name in criteria.names()]),
        "mark": _dropdown("mark by", MARKS),
        "split": _dropdown("split", tuple(SPLITS)),
    }
    for name, control in controls.items():
        control.value = getattr(settings, name)
    return controls


def disable_idle(controls):
    """Grey out what has no effect: limits without swaps, rules of splitting without splits."""
    for name in ("norm", "min_angle"):
        controls[name].disabled = controls["criterion"].value == NO_SWAPS
    for name in ("refine_by", "mark", "split"):
        controls[name].disabled = not controls["fraction"].value


def assembled(controls, view):
    """The controls in their groups, a switch between the stages, and the view."""
    switch = widgets.ToggleButtons(options=SHOWN, index=view.shown, style={"button_width": "8rem"})
    # Linked in the browser, so that the switch works on pages without a kernel too.
    widgets.jslink((switch, "index"), (view, "shown"))
    groups = widgets.GridBox([_group(title, [controls[name] for name in names])
                              for title, names in GROUPS.items()],
                             layout={"grid_template_columns": COLUMN, "grid_gap": "0 1.5rem"})
    return widgets.VBox([groups, switch, view], layout={"grid_gap": "0.5rem"})


def _group(title, members):
    return widgets.VBox([widgets.HTML(f"<b>{title}</b>"), *members])


def _dropdown(label, options):
    return widgets.Dropdown(options=options, description=label, layout={"width": "auto"},
                            style={"description_width": "6.5rem"})


def _slider(kind, label, **options):
    return kind(min=0, description=label, layout={"width": "auto"},
                style={"description_width": "6.5rem"}, **options)


def _titled(name):
    """Label and name of a criterion; names that abbreviate the title stand before it."""
    title = criteria.get(name).title or name
    return (title if "-" in name or title == name else f"{name.upper()}: {title}"), name
