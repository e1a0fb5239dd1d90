"""A live explorer: change a setting, and mesh, error and quality follow at once.

What can be chosen (`controls`) and what is to be seen (`scene`) are data. In Jupyter they
become widgets (`widgets`) and one view (`view`); a page without a kernel has them computed
beforehand (`atlas`), and draws them with the same scripts (`scripts`).
"""

import base64
from typing import Any

from .controls import Control, Exploration, menu, slider
from .scene import Scene

__all__ = ["Control", "Exploration", "Explorer", "Scene", "menu", "slider"]


class Explorer:
    """Controls for the settings of an exploration, and a view that follows at once.

    Parameters
    ----------
    exploration : Exploration
    **settings
        Values of some controls, in place of the initial ones.

    Attributes
    ----------
    scene : Scene
        What is shown.
    controls : dict of ipywidgets.Widget
        By setting; to assign to the ``value`` of one is like using it by hand.
    frames : ipywidgets.Widget
        Chooses the frame.
    view : anywidget.AnyWidget
        Draws the frame.
    widget : ipywidgets.VBox
        Controls and view, to place among other widgets.

    Raises
    ------
    MeshError
        If a setting is not known or its value not among the options.
    ImportError
        If ipywidgets or anywidget is not installed.

    Examples
    --------
    >>> from meshlib.thesis.explorers import SWAPS
    >>> explorer = Explorer(SWAPS, function="SR1", nodes="33")
    >>> explorer
    Explorer(SR1 on 33 nodes, JND-L2: 88 edges, 17 swaps, L2 error 0.0170)
    >>> explorer.controls["norm"].value = 1
    >>> explorer
    Explorer(SR1 on 33 nodes, JND-L1: 88 edges, 26 swaps, L2 error 0.0125)
    """

    def __init__(self, exploration: Exploration, **settings: Any) -> None:
        from . import widgets
        from .view import View

        self.exploration = exploration
        self.controls = widgets.build(exploration.controls, exploration.checked(settings))
        self.view = View()
        self.frames, film = widgets.film(exploration, self.view)
        self.widget = widgets.assembled(self.controls, film, self.view)
        for control in self.controls.values():
            control.observe(self._follow, "value")
        self._follow()

    def _follow(self, _: Any = None) -> None:
        """Show the scene of the settings: its last frame, if the last one was shown, else the same frame."""
        from .atlas import packed

        self.scene = self.exploration.scene(**{name: c.value for name, c in self.controls.items()})
        self.view.atlas = packed(self.exploration, [self.scene])
        if self.exploration.film:
            last = self.frames.value == self.frames.max
            self.frames.max = self.scene.frames - 1
            self.frames.value = self.frames.max if last else min(self.frames.value, self.frames.max)
        self.view.frame = self.frames.value if self.exploration.film else self.frames.index

    def __repr__(self) -> str:
        return f"Explorer({self.scene})"

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, Any]:
        """The live view where widgets run, a picture where they do not, a line of text elsewhere."""
        bundle = self.widget._repr_mimebundle_(include=include, exclude=exclude)
        return bundle | {"text/plain": repr(self)} | self._picture()

    def _picture(self) -> dict[str, str]:
        from .picture import png

        try:
            return {"image/png": base64.b64encode(png(self.scene)).decode()}
        except ImportError:  # without matplotlib there is no picture; the live view needs none
            return {}
