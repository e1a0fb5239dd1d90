"""A live explorer: change a setting, and mesh, error and quality follow at once.

The mathematics (`engine`), the controls (`controls`) and the view (`view`) know
nothing of each other; `Explorer` joins them.
"""
import base64

from .engine import Settings, State, state

__all__ = ["Explorer", "Settings", "State", "state"]


class Explorer:
    """Controls for function, nodes and adaptation, and a view that follows at once.

    Edges are swapped first, then elements are refined.

    Parameters
    ----------
    problem : str
        Name in `meshlib.problems.functions`.
    nodes : str
        Name in `meshlib.problems.names`.
    criterion : str
        Cost that swaps are to lower, or ``"none"`` for no swaps.
    norm : {1, 2, "max", "lexicographic"}
    min_angle : int
        Swaps that create an angle below this many degrees, 0 to 30, are refused.
    fraction : float
        Share of the elements to refine, from 0 to 1.
    refine_by : str
        Cost that chooses them.
    mark : {"element", "edge", "node", "density"}
    split : {"red-green", "centroid", "longest-edge"}
        See `meshlib.refined`.

    Attributes
    ----------
    state : State
        What is shown: settings, start stage and adapted stage.
    controls : dict of ipywidgets.Widget
        By setting; to set one's ``value`` is to use it by hand.
    view : anywidget.AnyWidget
        Draws the packed state.
    widget : ipywidgets.VBox
        All of it, to place among other widgets.

    Raises
    ------
    MeshError
        If a name is not known or a number out of range.
    ImportError
        If ipywidgets or anywidget is not installed.

    Examples
    --------
    >>> explorer = Explorer(problem="SR1", nodes="33")
    >>> explorer
    Explorer(SR1 on 33 nodes, JND-L2: 88 edges, 17 swaps, L2 error 0.0170)
    >>> explorer.controls["criterion"].value = "none"
    >>> explorer
    Explorer(SR1 on 33 nodes: 88 edges, 0 swaps, L2 error 0.0216)
    """

    def __init__(self, problem="SR1", nodes="33", criterion="jnd", norm=2, min_angle=0,
                 fraction=0.0, refine_by="abn", mark="element", split="centroid"):
        settings = Settings(problem, nodes, criterion, norm, min_angle, fraction, refine_by, mark,
                            split)
        from . import controls
        from .view import View
        self.controls, self.view = controls.build(settings), View()
        self.widget = controls.assembled(self.controls, self.view)
        for control in self.controls.values():
            control.observe(self._follow, "value")
        self._follow()

    def _follow(self, _=None):
        """Bring state and view up to date with the controls."""
        from .controls import disable_idle
        from .view import packed
        disable_idle(self.controls)
        self.state = state(Settings(**{name: c.value for name, c in self.controls.items()}))
        self.view.state = packed(self.state)

    def __repr__(self):
        return f"Explorer({self.state})"

    def _repr_mimebundle_(self, include=None, exclude=None):
        """Live where widgets are, a picture where they are not, a line of text elsewhere."""
        bundle = self.widget._repr_mimebundle_(include=include, exclude=exclude)
        return bundle | {"text/plain": repr(self)} | self._picture()

    def _picture(self):
        from .picture import png
        try:
            return {"image/png": base64.b64encode(png(self.state)).decode()}
        except ImportError:  # without matplotlib there is no picture; the live view needs none
            return {}
