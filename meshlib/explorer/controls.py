"""What can be chosen in an explorer, as data, for widgets in Jupyter and for pages alike."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias

from .. import checks
from .scene import Scene

MENU, SLIDER = "menu", "slider"

Options: TypeAlias = Mapping[Any, str] | Iterable[Any]
"""Values by which a control is set, with what readers see of them unless it is their own text."""


@dataclass(frozen=True)
class Control:
    """One setting: its values, and how it is shown.

    Made by `menu` and `slider`.

    Attributes
    ----------
    name : str
        The argument of the exploration that it sets.
    label : str
    given : mapping, iterable or callable
        The values, or a function that returns them whenever they are asked for.
    kind : {"menu", "slider"}
    given_on_page : iterable or callable
        The values for which states are precomputed, or a function that returns them; none
        stands for all.
    """

    name: str
    label: str
    given: Options | Callable[[], Options]
    kind: str = MENU
    given_on_page: Iterable[Any] | Callable[[], Iterable[Any]] = ()

    @property
    def texts_by_value(self) -> dict[Any, str]:
        """What readers see of each value that a kernel can compute."""
        options = _now(self.given)
        return dict(options) if isinstance(options, Mapping) else {value: str(value) for value in options}

    @property
    def options(self) -> tuple[Any, ...]:
        """All values that a kernel can compute."""
        return tuple(self.texts_by_value)

    @property
    def paged(self) -> tuple[Any, ...]:
        """The values on a page without a kernel."""
        return tuple(_now(self.given_on_page)) or self.options


def _now(given: Any) -> Any:
    """What was given, or what the function that was given returns now."""
    return given() if callable(given) else given


def _kept(given: Any) -> Any:
    """What was given in a form that can be read again and again."""
    return given if callable(given) or isinstance(given, Mapping) else tuple(given)


def menu(
    name: str,
    label: str,
    options: Options | Callable[[], Options],
    on_page: Iterable[Any] | Callable[[], Iterable[Any]] = (),
) -> Control:
    """A menu.

    Parameters
    ----------
    name, label : str
    options : mapping, iterable or callable
        The text of each value, or texts that are their own values, or a function that
        returns either whenever the menu is built.
    on_page : iterable or callable, optional
        The values for which states are precomputed, or a function that returns them; by
        default all.

    Returns
    -------
    Control

    Examples
    --------
    >>> menu("norm", "norm", {1: "L1", 2: "L2"}, on_page=[2]).options
    (1, 2)
    """
    return Control(name, label, _kept(options), MENU, _kept(on_page))


def slider(
    name: str,
    label: str,
    values: Iterable[Any],
    text: Callable[[Any], str] = str,
    on_page: Iterable[Any] = (),
) -> Control:
    """A slider over some values in ascending order.

    Parameters
    ----------
    name, label : str
    values : iterable
    text : callable, optional
        What readers see of a value.
    on_page : iterable, optional
        The values for which states are precomputed; by default all.

    Returns
    -------
    Control

    Examples
    --------
    >>> slider("percentage", "share", range(0, 30, 10), "{}%".format).texts_by_value
    {0: '0%', 10: '10%', 20: '20%'}
    """
    return Control(name, label, {value: text(value) for value in values}, SLIDER, tuple(on_page))


@dataclass(frozen=True)
class Exploration:
    """What an explorer is about: its controls, and the scene for each of their settings.

    Attributes
    ----------
    name : str
        Also the name of its file in the book.
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
    controls: tuple[Control, ...]
    scene: Callable[..., Scene]
    initial: dict[str, Any]
    film: str = ""

    def checked(self, settings: Mapping[str, Any]) -> dict[str, Any]:
        """The settings, completed by the initial ones.

        Raises
        ------
        MeshError
            If a name or a value is not known.
        """
        for name in settings:
            checks.choice(name, tuple(self.initial), "setting")
        found = self.initial | dict(settings)
        for control in self.controls:
            checks.choice(found[control.name], control.options, control.label)
        return found

    def computed(self, settings: Mapping[str, Any]) -> Scene:
        """The scene for a dict with a value for each control."""
        return self.scene(**settings)

    def pages(self) -> list[dict[str, Any]]:
        """All settings on a page, the last control the fastest."""
        names = [control.name for control in self.controls]
        values = product(*(control.paged for control in self.controls))
        return [dict(zip(names, row, strict=True)) for row in values]
