"""Colours of points by RViz's ``Color Transformer`` and the properties that belong to it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.studio.displays.colours import parsed_colour, rainbow
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params

__all__ = ["TRANSFORMERS", "Colouring", "flat_colour", "ramp"]

TRANSFORMERS = ("Intensity", "AxisColor", "RGB8", "FlatColor")
_AXES = {"X": 0, "Y": 1, "Z": 2}
_WHITE, _BLACK = (255, 255, 255), (0, 0, 0)

Packed = NDArray[np.uint32]
"""RGBA, red in the lowest byte."""


class Colouring(NamedTuple):
    """The properties of a points display that colour it.

    Attributes:
        transformer: of `TRANSFORMERS`, empty for whatever the points have.
        channel: field that ``Intensity`` takes.
        axis: 0…2, that ``AxisColor`` takes.
        in_fixed_frame: the axis is the fixed frame's.
        bounds: least and greatest intensity, None where they are found in each message.
        axis_bounds: the same for ``AxisColor``.
        colours: 256 packed colours from least to greatest.
        flat: packed colour of ``FlatColor``.
    """

    transformer: str
    channel: str
    axis: int
    in_fixed_frame: bool
    bounds: tuple[float, float] | None
    axis_bounds: tuple[float, float] | None
    colours: Packed
    flat: int

    @classmethod
    def read(cls, params: Params) -> Colouring:
        """Read RViz's properties; its defaults stand for what is missing.

        Raises:
            StudioError: a value is of the wrong kind.
        """
        transformer = params.text("Color Transformer", "")
        if transformer and transformer not in TRANSFORMERS:
            text = f"there is no Color Transformer '{transformer}'"
            raise StudioError(text, known=TRANSFORMERS)
        axis = params.text("Axis", "Z").upper()
        if axis not in _AXES:
            raise StudioError(f"there is no axis '{axis}'", known=_AXES)
        automatic = params.flag("Autocompute Intensity Bounds", True)
        automatic_axis = params.flag("Autocompute Value Bounds", True)
        return cls(
            transformer,
            params.text("Channel Name", "intensity"),
            _AXES[axis],
            params.flag("Use Fixed Frame", True),
            None if automatic else _bounds(params, "Intensity", (0.0, 4096.0)),
            None if automatic_axis else _bounds(params, "Value", (-10.0, 10.0)),
            _colours(params),
            flat_colour(parsed_colour(params.values.get("Color"), _WHITE)),
        )


def ramp(values: NDArray[Any], bounds: tuple[float, float] | None, colours: Packed) -> Packed:
    """Return the colour of each value between its bounds.

    Args:
        values: (N,) numbers, in the unit of `bounds`.
        bounds: values of the first and the last colour; the least and greatest finite value if
            None.
        colours: (256,) packed colours from least to greatest.

    Returns:
        (N,) packed colours.
    """
    numbers = np.ascontiguousarray(values, np.float32)
    if not len(numbers):
        return np.zeros(0, np.uint32)
    low, high = bounds or (float(numbers.min()), float(numbers.max()))
    if not (np.isfinite(low) and np.isfinite(high)):
        finite = numbers[np.isfinite(numbers)]
        low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
        numbers = np.nan_to_num(numbers, nan=low, posinf=high, neginf=low)
    factor = 255.0 / (high - low) if high > low else 0.0
    levels = (numbers - np.float32(low)) * np.float32(factor)
    if bounds is not None:
        np.clip(levels, 0.0, 255.0, out=levels)
    return np.take(colours, levels.astype(np.uint8))


def flat_colour(rgb: tuple[int, int, int]) -> int:
    """Return an opaque colour, packed."""
    red, green, blue = rgb
    return red | green << 8 | blue << 16 | 0xFF000000


def _bounds(params: Params, what: str, default: tuple[float, float]) -> tuple[float, float]:
    low, high = params.number(f"Min {what}", default[0]), params.number(f"Max {what}", default[1])
    return min(low, high), max(low, high)


def _colours(params: Params) -> Packed:
    """RViz's rainbow runs from red at the least to magenta at the greatest value."""
    if params.flag("Use rainbow", True):
        return rainbow() if params.flag("Invert Rainbow", False) else rainbow()[::-1].copy()
    low = np.array(parsed_colour(params.values.get("Min Color"), _BLACK), float)
    high = np.array(parsed_colour(params.values.get("Max Color"), _WHITE), float)
    table = np.full((256, 4), 255, np.uint8)
    table[:, :3] = np.round(low + (high - low) * np.linspace(0.0, 1.0, 256)[:, None])
    return table.view("<u4").reshape(-1)
