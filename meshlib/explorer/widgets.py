"""The controls of the explorer where a kernel is: standard ipywidgets, linked to the view."""

from typing import Any

from ..errors import missing_extra
from .controls import MENU, Control, Exploration

try:
    import ipywidgets
except ImportError as error:
    raise missing_extra("ipywidgets", "widgets") from error

COLUMNS = "repeat(auto-fit, minmax(min(19rem, 100%), 1fr))"
STAGES = "start mesh", "adapted mesh"
TICK = 350  # milliseconds between frames of a film, as in controls.js
LABEL = {"description_width": "6.5rem"}


def build(controls: tuple[Control, ...], settings: dict[str, Any]) -> dict[str, Any]:
    """A widget for each control, by name, set to the settings."""
    return {control.name: _widget(control, settings[control.name]) for control in controls}


def _widget(control: Control, value: Any) -> Any:
    options = [(text, option) for option, text in control.texts_by_value.items()]
    kind = ipywidgets.Dropdown if control.kind == MENU else ipywidgets.SelectionSlider
    return kind(
        options=options, value=value, description=control.label, style=LABEL, layout={"width": "auto"}
    )


def film(exploration: Exploration, view: Any) -> tuple[Any, list[Any]]:
    """The widget that chooses the frame, and it with all widgets that belong to it.

    They are linked in the browser, so that no kernel is asked for a frame.
    """
    if not exploration.film:
        switch = ipywidgets.ToggleButtons(options=STAGES, index=1, style={"button_width": "8rem"})
        ipywidgets.jslink((switch, "index"), (view, "frame"))
        return switch, [switch]
    frames = ipywidgets.IntSlider(max=0, description=exploration.film, style=LABEL, layout={"width": "auto"})
    play = ipywidgets.Play(interval=TICK)
    for trait in ("max", "value"):  # the first of a pair gives the value at the start
        ipywidgets.jslink((frames, trait), (play, trait))
    ipywidgets.jslink((frames, "value"), (view, "frame"))
    return frames, [frames, play]


def assembled(controls: dict[str, Any], film: list[Any], view: Any) -> Any:
    """The controls side by side, the film, and the view below."""
    grid = ipywidgets.GridBox(
        [*controls.values(), *film], layout={"grid_template_columns": COLUMNS, "grid_gap": "0 1.5rem"}
    )
    return ipywidgets.VBox([grid, view], layout={"grid_gap": "0.5rem"})
