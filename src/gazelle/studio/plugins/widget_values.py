"""Which values a widget takes, from the panel's code and from the page; pictures too."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import Any

import numpy as np

from gazelle.studio.displays.image_encodings import PictureSettings, encoded_picture
from gazelle.studio.http_answers import Answer
from gazelle.studio.json_text import finite_number, json_text
from gazelle.studio.plugins.widgets import (
    Button,
    Checkbox,
    Choice,
    Image,
    Label,
    Number,
    Plot,
    Slider,
    Table,
    TextInput,
    Widget,
)

__all__ = [
    "accepted",
    "check_sendable",
    "checked_picture",
    "chosen",
    "first_value",
    "picture_answer",
    "refitted",
]

_SETTINGS = PictureSettings(quality=85)
_FILES = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}
_MAX_ROWS = 1000

_EVENTS = (Slider, Number, Checkbox, Choice, TextInput, Button)
"""Kinds that a person acts on."""


def checked_picture(value: Any) -> Any:
    """Return a picture that can be shown; an array is copied, its owner goes on drawing.

    Raises:
        TypeError: it is none.
    """
    if hasattr(value, "data") and (hasattr(value, "encoding") or hasattr(value, "format")):
        return value
    if isinstance(value, bytes) and _type_of(value):
        return value
    if isinstance(value, np.ndarray) and value.dtype == np.uint8:
        if value.ndim == 2 or (value.ndim == 3 and value.shape[2] in (1, 3, 4)):
            return value.squeeze(2).copy() if value.shape[2:] == (1,) else value.copy()
        raise TypeError(f"an array of shape {value.shape} is no picture: (H, W), (H, W, 3 or 4)")
    kind = f"an array of {value.dtype}" if isinstance(value, np.ndarray) else type(value).__name__
    raise TypeError(
        f"{kind} is no picture: an Image or CompressedImage message, an array of uint8, "
        "or the bytes of a PNG or JPEG file"
    )


def picture_answer(value: Any) -> Answer:
    """Return the file of a picture.

    Raises:
        StudioError: the message's encoding is not known, or the data do not fit the size.
    """
    if isinstance(value, bytes):
        return Answer(value, _type_of(value), packed=False)
    if isinstance(value, np.ndarray):
        from PIL import Image

        data = io.BytesIO()
        Image.fromarray(value).save(data, "PNG", compress_level=1)
        return Answer(data.getvalue(), "image/png", packed=False)
    return Answer(encoded_picture(value, _SETTINGS).jpeg, "image/jpeg", packed=False)


def first_value(widget: Widget) -> Any:
    """Return what a widget shows at the start."""
    match widget:
        case Slider():
            return widget.min if widget.value is None else accepted(widget, widget.value)
        case Choice():
            return widget.value or next(iter(widget.options), "")
        case Number() | Checkbox() | TextInput() | Label() | Table():
            return accepted(widget, widget.value)
        case _:
            return None


def accepted(widget: Widget, value: Any) -> Any:
    """Return a value as the widget keeps it.

    Raises:
        TypeError: it is of another kind than the widget shows.
        ValueError: it is out of limits or none of the options.
    """
    match widget:
        case Slider() | Number():
            return _within(widget, _number(widget, value))
        case Checkbox():
            return bool(value)
        case Choice():
            return _option(widget, value)
        case TextInput():
            return str(value)
        case Label():
            return _plain(value) if isinstance(value, int | float | np.generic) else str(value)
        case Table():
            return _rows(widget, value)
        case Plot():
            raise TypeError(f"'{widget.name}' is a plot: use add('{widget.name}', …)")
        case Image() if not widget.topic:
            return checked_picture(value)
        case Image():
            raise TypeError(f"'{widget.name}' shows the topic {widget.topic}; it takes no picture")
        case _:
            raise TypeError(f"'{widget.name}' is a {type(widget).__name__} and shows no value")


def chosen(widget: Widget, value: Any) -> Any:
    """Return what a person chose; numbers are brought within the limits.

    Raises:
        TypeError: the widget is not of a kind that a person acts on, or the value not of its kind.
        ValueError: it is none of the options.
    """
    if not isinstance(widget, _EVENTS):
        raise TypeError(f"'{widget.name}' is a {type(widget).__name__}: nobody acts on it")
    if isinstance(widget, Button):
        return None
    if isinstance(widget, Slider | Number):
        return _number(widget, min(max(_number(widget, value), widget.min), widget.max))
    return accepted(widget, value)


def check_sendable(value: Any) -> None:
    """Check that a value can go to the page.

    Raises:
        TypeError: it cannot.
    """
    try:
        json_text(value)
    except (TypeError, ValueError) as error:
        text = "only texts, numbers, booleans, None, lists, dicts of them, arrays and messages can "
        raise TypeError(f"{text}go to the page, not {value!r} ({error})") from None


def refitted(widget: Widget, value: Any) -> Any:
    """Return a value that a widget had as one that fits it now."""
    if isinstance(widget, Choice):
        return value if value in widget.options else first_value(widget)
    if isinstance(widget, Slider | Number):
        return chosen(widget, value)
    return value


def _type_of(data: bytes) -> str:
    return next((kind for start, kind in _FILES.items() if data.startswith(start)), "")


def _number(widget: Slider | Number, value: Any) -> float:
    number = finite_number(_plain(value))
    if number is None:
        raise TypeError(f"'{widget.name}' takes a number, not {value!r}")
    return round(number) if _is_whole(widget) else number


def _is_whole(widget: Slider | Number) -> bool:
    if isinstance(widget, Number):
        return isinstance(widget.value, int)
    return isinstance(widget.step, int)


def _within(widget: Slider | Number, value: float) -> float:
    if not widget.min <= value <= widget.max:
        limits = f"{widget.min:g} to {widget.max:g}"
        raise ValueError(f"'{widget.name}' goes from {limits}; {value:g} is outside")
    return value


def _option(widget: Choice, value: Any) -> str:
    if value not in widget.options:
        options = ", ".join(widget.options) or "there are none"
        raise ValueError(f"'{widget.name}' has no option {value!r}; its options: {options}")
    return str(value)


def _rows(widget: Table, value: Any) -> list[list[Any]]:
    if isinstance(value, Mapping):
        value = value.items()
    rows = [[_cell(cell) for cell in row] for row in value]
    wrong = next((row for row in rows if len(row) != len(widget.columns)), None)
    if wrong is not None:
        text = f"'{widget.name}' has {len(widget.columns)} columns, not {len(wrong)}: {wrong}"
        raise ValueError(text)
    return rows[:_MAX_ROWS]


def _cell(value: Any) -> Any:
    value = _plain(value)
    return value if isinstance(value, int | float | str) else str(value)


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value
