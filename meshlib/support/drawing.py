"""Pictures of objects that themselves know nothing of pictures."""

from importlib import import_module
from typing import Any


def drawn(function: str, what: object, ax: Any, options: dict[str, Any]) -> Any:
    """Have a function of `meshlib.plotting` draw an object; returns the axes.

    Meshes and interpolants lie below the pictures that show them.  Their method ``plot``
    therefore asks for the function by its name, when it is called.

    Parameters
    ----------
    function : str
        Name of the function, which takes axes, the object and the options.
    what : object
    ax : matplotlib.axes.Axes or None
        None for those of a new figure.
    options : dict
    """
    plotting = import_module("meshlib.plotting")
    if ax is None:
        _, (ax,) = plotting.panels()
    getattr(plotting, function)(ax, what, **options)
    return ax
