"""What a running panel shows: its widgets as they are now, and their values."""

from __future__ import annotations

import inspect
import threading
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, replace
from typing import Any, TypedDict

from gazelle.diagnostics import did_you_mean
from gazelle.studio.plugins.panel import Panel
from gazelle.studio.plugins.widget_values import accepted, check_sendable, first_value, refitted
from gazelle.studio.plugins.widgets import (
    Button,
    Choice,
    Column,
    Handler,
    Image,
    Part,
    Plot,
    Row,
    Widget,
    all_widgets,
)

__all__ = ["PanelState", "State", "checked_layout", "handler_of"]

_KEPT_POINTS = 2000
_NOT_SENT = ("on_change", "on_press", "value")


class PanelState(TypedDict):
    """Everything that a panel shows.

    Attributes:
        layout: its parts: widgets, and rows and columns with `children`.
        values: by the widgets' names.
        points: of its plots: `[t, value…]` each.
    """

    layout: list[dict[str, Any]]
    values: dict[str, Any]
    points: dict[str, list[Any]]


def checked_layout(panel: type[Panel]) -> tuple[Part, ...]:
    """Return a class's widgets.

    Raises:
        TypeError: something in them is no widget, a name is there twice, or a method that one
            names is missing; all that is wrong is told.
    """
    layout = tuple(panel.widgets) if isinstance(panel.widgets, list | tuple) else (panel.widgets,)
    problems: list[str] = []
    seen: set[str] = set()
    for part in all_widgets(layout):
        if not isinstance(part, Widget):
            hint = "; write Row(a, b)" if isinstance(part, list | tuple) else ""
            problems.append(f"{part!r} is no widget{hint}")
            continue
        if not part.name or part.name in seen:
            problems.append(f"{type(part).__name__} '{part.name}': the name is empty or used twice")
        seen.add(part.name)
        problems += _handler_problems(panel, part) + _value_problems(part)
    if problems:
        raise TypeError(f"widgets of {panel.__name__}: " + "; ".join(problems))
    return layout


def handler_of(panel: Panel, widget: Widget) -> Callable[..., Any] | None:
    """Return what a widget calls, None when there is nothing."""
    wanted = _wanted(widget)
    if callable(wanted):
        return lambda *values: wanted(panel, *values)
    found: Callable[..., Any] | None = getattr(panel, wanted or f"on_{widget.name}", None)
    return found


class State:
    """The widgets of one panel and what they show."""

    def __init__(self, layout: tuple[Part, ...], tell: Callable[[str, str, Any], None]) -> None:
        """Begin with the values that the widgets have.

        Args:
            layout: of the panel's class.
            tell: told ``(what, widget, value)`` of every change.
        """
        self._layout = layout
        self._tell = tell
        self.widgets = {one.name: one for one in all_widgets(layout) if isinstance(one, Widget)}
        self.values = {name: first_value(widget) for name, widget in self.widgets.items()}
        self.versions: dict[str, int] = {}
        self._points: dict[str, deque[list[float]]] = {}
        self._lock = threading.RLock()

    def widget(self, name: str) -> Widget:
        """Return a widget.

        Raises:
            LookupError: there is none of this name; the message names the nearest.
        """
        found = self.widgets.get(name)
        if found is None:
            text = f"there is no widget '{name}'"
            raise LookupError(_with_nearest(text, name, self.widgets))
        return found

    def value(self, name: str) -> Any:
        """Return a widget's value."""
        self.widget(name)
        return self.values[name]

    def set(self, name: str, value: Any) -> None:
        """Show a value."""
        fitting = accepted(self.widget(name), value)
        with self._lock:
            self.values[name] = fitting
            self.versions[name] = self.versions.get(name, 0) + 1
            self._tell("set", name, self._shown(name))

    def add(self, name: str, values: Iterable[float], time_s: float) -> None:
        """Add a point to a plot."""
        widget = self.widget(name)
        if not isinstance(widget, Plot):
            raise TypeError(f"'{name}' is a {type(widget).__name__}, not a plot")
        point = [time_s, *(float(value) for value in values)]
        if len(point) != len(widget.curves) + 1:
            curves = ", ".join(widget.curves)
            raise ValueError(
                f"'{name}' has the curves {curves}; {len(point) - 1} values were given"
            )
        with self._lock:
            self._points.setdefault(name, deque(maxlen=_KEPT_POINTS)).append(point)
            self._tell("add", name, point)

    def change(self, name: str, properties: Mapping[str, Any]) -> None:
        """Replace a widget's properties; a value that does not fit any more is made to fit."""
        old = self.widget(name)
        known = [one.name for one in fields(old) if one.name not in ("name", "value")]
        for key in properties:
            if key not in known:
                text = f"a {type(old).__name__} has no property '{key}'"
                raise TypeError(_with_nearest(text, key, known))
        if isinstance(old, Choice) and "options" in properties:
            old = replace(old, value="")
        new = replace(old, **properties)
        check_sendable(_widget_value(new))
        with self._lock:
            self.widgets[name] = new
            self._tell("widget", name, _widget_value(new))
        fitting = refitted(new, self.values[name])
        if fitting != self.values[name]:
            self.set(name, fitting)

    def show_to(self, tell: Callable[[str, str, Any], None]) -> None:
        """Tell everything that a page needs which begins to show the panel."""
        with self._lock:
            whole: PanelState = {
                "layout": [self._part(part) for part in self._layout],
                "values": {name: self._shown(name) for name in self.widgets},
                "points": {name: list(points) for name, points in self._points.items()},
            }
            tell("state", "", whole)

    def _shown(self, name: str) -> Any:
        """A picture is fetched by its number."""
        if isinstance(self.widgets[name], Image):
            return self.versions.get(name, 0)
        return self.values[name]

    def _part(self, part: Part) -> dict[str, Any]:
        if isinstance(part, Row | Column):
            children = [self._part(child) for child in part.children]
            return {"kind": _kind(part), "title": part.title, "children": children}
        return _widget_value(self.widgets[part.name])


def _widget_value(widget: Widget) -> dict[str, Any]:
    names = (one.name for one in fields(widget) if one.name not in _NOT_SENT)
    value = {name: _finite(getattr(widget, name)) for name in names}
    return {"kind": _kind(widget), **value}


def _finite(value: Any) -> Any:
    return None if value in (float("inf"), float("-inf")) else value


def _kind(part: object) -> str:
    return type(part).__name__.lower()


def _value_problems(widget: Widget) -> list[str]:
    try:
        check_sendable([_widget_value(widget), first_value(widget)])
    except (TypeError, ValueError) as error:
        return [f"{type(widget).__name__} '{widget.name}': {error}"]
    return []


def _with_nearest(text: str, name: str, known: Iterable[str]) -> str:
    nearest = did_you_mean(name, known)
    return f"{text}; {nearest}" if nearest else text


def _wanted(widget: Widget) -> Handler:
    found: Handler = getattr(widget, "on_press", "") or getattr(widget, "on_change", "")
    return found


def _handler_problems(panel: type[Panel], widget: Widget) -> list[str]:
    wanted = _wanted(widget)
    if isinstance(wanted, str) and wanted and not callable(getattr(panel, wanted, None)):
        methods = [name for name, _ in inspect.getmembers(panel, callable) if name[0] != "_"]
        text = f"'{widget.name}' names the method '{wanted}', which is not there"
        return [_with_nearest(text, wanted, methods)]
    if isinstance(widget, Button) and not wanted and not hasattr(panel, f"on_{widget.name}"):
        return [f"button '{widget.name}' does nothing; write a method on_{widget.name}(self)"]
    return []
