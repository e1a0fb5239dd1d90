"""The controls of the explorer where a kernel is: standard ipywidgets, linked to the view."""

from ..errors import missing_extra
from .controls import MENU

try:
    import ipywidgets
except ImportError as error:
    raise missing_extra("ipywidgets", "widgets") from error

COLUMNS = "repeat(auto-fit, minmax(min(19rem, 100%), 1fr))"
STAGES = "start mesh", "adapted mesh"
TICK = 350  # milliseconds between frames of a film, as in controls.js
LABEL = {"description_width": "6.5rem"}


def build(controls, settings):
    """A widget for each control, by name, set to the settings."""
    return {control.name: _widget(control, settings[control.name]) for control in controls}


def _widget(control, value):
    options = list(zip(control.texts, control.options, strict=True))
    kind = ipywidgets.Dropdown if control.kind == MENU else ipywidgets.SelectionSlider
    return kind(
        options=options, value=value, description=control.label, style=LABEL, layout={"width": "auto"}
    )


def film(exploration, view):
    """The widget that chooses the frame, and all that belongs to it.

    Linked in the browser, so that no kernel is asked for a frame.
    """
    if not exploration.film:
        switch = ipywidgets.ToggleButtons(options=STAGES, index=1, style={"button_width": "8rem"})
        ipywidgets.jslink((switch, "index"), (view, "frame"))
        return switch, [switch]
    frames = ipywidgets.IntSlider(max=0, description=exploration.film, style=LABEL, layout={"width": "auto"})
    play = ipywidgets.Play(interval=TICK)
    for trait in ("max", "value"):  # what is first leads at the start
        ipywidgets.jslink((frames, trait), (play, trait))
    ipywidgets.jslink((frames, "value"), (view, "frame"))
    return frames, [frames, play]


def assembled(controls, film, view):
    """The controls side by side, the film, and the view below."""
    grid = ipywidgets.GridBox(
        [*controls.values(), *film], layout={"grid_template_columns": COLUMNS, "grid_gap": "0 1.5rem"}
    )
    return ipywidgets.VBox([grid, view], layout={"grid_gap": "0.5rem"})
