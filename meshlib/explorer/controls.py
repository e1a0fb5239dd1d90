"""What can be chosen in an explorer, as data, for widgets in Jupyter and on a page alike."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

from .. import checks

MENU, SLIDER = "menu", "slider"


@dataclass(frozen=True)
class Control:
    """One setting: its values, and how it is shown.

    Attributes
    ----------
    name : str
        Of the argument that it sets.
    label : str
    options : tuple
        All values that a kernel can compute.
    texts : tuple of str
        What readers see of them.
    kind : {"menu", "slider"}
    on_page : tuple
        The values for which states are precomputed; by default all.
    """

    name: str
    label: str
    options: tuple
    texts: tuple
    kind: str = MENU
    on_page: tuple = ()

    @property
    def paged(self):
        """The values on a page without a kernel."""
        return self.on_page or self.options

    def text(self, value):
        """What readers see of a value."""
        return self.texts[self.options.index(value)]


def menu(name, label, options, on_page=()):
    """A menu; ``options`` maps each value to its text, or is a sequence of texts."""
    texts = options if isinstance(options, dict) else {value: str(value) for value in options}
    return Control(name, label, tuple(texts), tuple(texts.values()), MENU, tuple(on_page))


def slider(name, label, values, text=str, on_page=()):
    """A slider over some values in ascending order."""
    values = tuple(values)
    return Control(name, label, values, tuple(map(text, values)), SLIDER, tuple(on_page))


@dataclass(frozen=True)
class Exploration:
    """What an explorer is about: its controls, and the scene for each of their settings.

    Attributes
    ----------
    name : str
        Also of its file in the book.
    controls : tuple of Control
    scene : callable
        Takes a keyword for each control and returns the `Scene`.
    initial : dict
        A value for each control.
    film : str
        What a frame of the film is, such as ``"sweep"``; empty if only start and adapted
        mesh are to be told apart.
    """

    name: str
    controls: tuple
    scene: Callable
    initial: dict
    film: str = ""

    def checked(self, settings):
        """The settings, completed by the initial ones.

        Raises
        ------
        MeshError
            If a name or a value is not known.
        """
        for name in settings:
            checks.choice(name, tuple(self.initial), "setting")
        found = self.initial | settings
        for control in self.controls:
            checks.choice(found[control.name], control.options, control.label)
        return found

    def computed(self, settings):
        """The scene for a dict with a value for each control."""
        return self.scene(**settings)

    def pages(self):
        """All settings on a page, the last control the fastest."""
        names = [control.name for control in self.controls]
        return [
            dict(zip(names, values, strict=True))
            for values in product(*(control.paged for control in self.controls))
        ]
