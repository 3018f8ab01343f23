"""What a panel is made of: widgets, and rows and columns of them.

Widgets are values: a panel's code changes what they show, not them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any

__all__ = [
    "Button",
    "Checkbox",
    "Choice",
    "Column",
    "Handler",
    "Image",
    "Label",
    "Number",
    "Part",
    "Plot",
    "Row",
    "Slider",
    "Table",
    "TextInput",
    "Widget",
    "all_widgets",
]

Handler = str | Callable[..., Any]
"""Name of a method, or a function that takes the panel first; empty for ``on_<widget>``."""


@dataclass(frozen=True, slots=True)
class Widget:
    """What all widgets have.

    Attributes:
        name: by which the panel's code knows it, unique in the panel.
        text: what stands beside it; the name when empty.
        help: shown when the pointer rests on it.
        enabled: False greys it.
        hidden: True takes it out of sight.
    """

    name: str
    text: str = field(default="", kw_only=True)
    help: str = field(default="", kw_only=True)
    enabled: bool = field(default=True, kw_only=True)
    hidden: bool = field(default=False, kw_only=True)


@dataclass(frozen=True, slots=True)
class Slider(Widget):
    """A number within limits, with a slider.

    Attributes:
        min, max: its limits.
        value: at the start, `min` when None.
        step: between two values; a thousandth of the range when None, 1 for whole numbers.
        unit: shown behind it.
        on_change: called with the new value.
    """

    min: float = field(kw_only=True)
    max: float = field(kw_only=True)
    value: float | None = field(default=None, kw_only=True)
    step: float | None = field(default=None, kw_only=True)
    unit: str = field(default="", kw_only=True)
    on_change: Handler = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _check_range(self.name, self.min, self.max)
        if self.step is not None and self.step <= 0:
            raise ValueError(f"slider '{self.name}': step is {self.step}, not above 0")


@dataclass(frozen=True, slots=True)
class Number(Widget):
    """A number that is typed.

    Attributes:
        value: at the start; a whole one (``0``, not ``0.0``) takes whole numbers only.
        min, max: its limits.
        step: of the arrows at its side.
        unit: shown behind it.
        on_change: called with the new value.
    """

    value: float = field(default=0.0, kw_only=True)
    min: float = field(default=-math.inf, kw_only=True)
    max: float = field(default=math.inf, kw_only=True)
    step: float | None = field(default=None, kw_only=True)
    unit: str = field(default="", kw_only=True)
    on_change: Handler = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        _check_range(self.name, self.min, self.max)


@dataclass(frozen=True, slots=True)
class Checkbox(Widget):
    """Yes or no.

    Attributes:
        value: at the start.
        on_change: called with True or False.
    """

    value: bool = field(default=False, kw_only=True)
    on_change: Handler = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class Choice(Widget):
    """One of some texts.

    Attributes:
        options: the texts; `Panel.change` may give others later.
        value: at the start, the first option when empty.
        on_change: called with the text that was chosen.
    """

    options: tuple[str, ...] = field(kw_only=True)
    value: str = field(default="", kw_only=True)
    on_change: Handler = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "options", tuple(str(option) for option in self.options))
        if self.value and self.value not in self.options:
            text = f"choice '{self.name}': value '{self.value}' is none of its options "
            raise ValueError(text + ", ".join(self.options))


@dataclass(frozen=True, slots=True)
class TextInput(Widget):
    """A line of text.

    Attributes:
        value: at the start.
        placeholder: shown while it is empty.
        on_change: called with the text when Enter is pressed or the line is left.
    """

    value: str = field(default="", kw_only=True)
    placeholder: str = field(default="", kw_only=True)
    on_change: Handler = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class Button(Widget):
    """Something to press.

    Attributes:
        on_press: called without a value.
    """

    on_press: Handler = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class Label(Widget):
    """Text or a number to read.

    Attributes:
        value: at the start.
        unit: shown behind it.
    """

    value: str | float = field(default="", kw_only=True)
    unit: str = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class Plot(Widget):
    """Curves over time; `Panel.add` adds to them.

    Attributes:
        curves: their names.
        window_s: how much of the past is shown.
        unit: of the values.
    """

    curves: tuple[str, ...] = field(default=("value",), kw_only=True)
    window_s: float = field(default=30.0, kw_only=True)
    unit: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "curves", tuple(str(curve) for curve in self.curves))
        if not self.curves or not self.window_s > 0:
            raise ValueError(f"plot '{self.name}' needs curves, and a window_s above 0")


@dataclass(frozen=True, slots=True)
class Image(Widget):
    """A picture: of a topic, or what the panel's code gives.

    Attributes:
        topic: of ``sensor_msgs/Image`` or ``CompressedImage``, shown without any code.
    """

    topic: str = field(default="", kw_only=True)


@dataclass(frozen=True, slots=True)
class Table(Widget):
    """Rows of texts and numbers.

    Attributes:
        columns: their headings.
        value: the rows at the start.
    """

    columns: tuple[str, ...] = field(kw_only=True)
    value: tuple[tuple[Any, ...], ...] = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "columns", tuple(str(column) for column in self.columns))


@dataclass(frozen=True, slots=True, init=False)
class Row:
    """Widgets beside each other.

    Attributes:
        children: widgets, rows and columns.
        title: shown above them.
    """

    children: tuple[Part, ...]
    title: str

    def __init__(self, *children: Part, title: str = "") -> None:
        object.__setattr__(self, "children", children)
        object.__setattr__(self, "title", title)


@dataclass(frozen=True, slots=True, init=False)
class Column:
    """Widgets below each other; with a title, a group.

    Attributes:
        children: widgets, rows and columns.
        title: shown above them.
    """

    children: tuple[Part, ...]
    title: str

    def __init__(self, *children: Part, title: str = "") -> None:
        object.__setattr__(self, "children", children)
        object.__setattr__(self, "title", title)


def all_widgets(parts: Iterable[object]) -> Iterator[object]:
    """Yield everything inside rows and columns, in order; what is no widget too."""
    for part in parts:
        if isinstance(part, Row | Column):
            yield from all_widgets(part.children)
        else:
            yield part


def _check_range(name: str, least: float, most: float) -> None:
    if not least < most:
        raise ValueError(f"widget '{name}': min {least:g} is not below max {most:g}")


Part = Widget | Row | Column
