"""The picture that turtles walk on: background, lines, and the turtles themselves."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import LaunchError
from gazelle.nodes.turtlesim.turtle import SIZE_PX, Stroke, Turtle

__all__ = ["BACKGROUND", "Canvas", "write_png"]

Picture = NDArray[np.uint8]

BACKGROUND = (0x45, 0x56, 0xFF)

# Shell, skin: one row for each kind of turtle.
_KINDS = (
    ((60, 120, 60), (130, 180, 90)),
    ((150, 110, 60), (190, 200, 120)),
    ((40, 110, 140), (120, 190, 190)),
    ((130, 70, 120), (200, 160, 200)),
    ((190, 120, 40), (220, 200, 120)),
)
_OUTLINE = (35, 45, 35)
# Ellipses of a turtle that looks along +x, in pixels: centre, half axes, and which colour of its
# kind (0 shell, 1 skin). Later ones lie above.
_LIMBS = (
    ((-17.0, 0.0), (5.0, 2.0), 1),
    ((10.0, 12.0), (6.5, 4.0), 1),
    ((10.0, -12.0), (6.5, 4.0), 1),
    ((-10.0, 12.0), (5.5, 4.0), 1),
    ((-10.0, -12.0), (5.5, 4.0), 1),
    ((17.5, 0.0), (5.5, 4.5), 1),
    ((0.0, 0.0), (15.0, 12.5), 0),
    ((0.0, 0.0), (8.0, 6.0), 1),
    ((0.0, 0.0), (6.5, 4.5), 0),
)
_REACH_PX = 26


class Canvas:
    """What was drawn, 500 × 500 pixels, rows from the top."""

    def __init__(self, background: tuple[int, int, int] = BACKGROUND) -> None:
        """Begin empty."""
        self._image = np.empty((SIZE_PX, SIZE_PX, 3), np.uint8)
        self._drawn = np.zeros((SIZE_PX, SIZE_PX), bool)
        self.clear(background)

    def clear(self, background: tuple[int, int, int]) -> None:
        """Wipe all lines off."""
        self._drawn[:] = False
        self._image[:] = background

    def paint_background(self, background: tuple[int, int, int]) -> None:
        """Change the colour below the lines."""
        self._image[~self._drawn] = background

    def draw(self, strokes: Iterable[Stroke]) -> None:
        """Draw lines; their ends are square, half a width longer than the line."""
        for stroke in strokes:
            self._draw(stroke)

    def color_at(self, place_px: tuple[float, float]) -> tuple[int, int, int]:
        """Return the colour of the pixel at a place of the world."""
        # Qt rounds halves up.
        column, row = (math.floor(value + 0.5) for value in place_px)
        red, green, blue = self._image[row, column].tolist()
        return red, green, blue

    def picture(self, turtles: Iterable[tuple[int, Turtle]] = ()) -> Picture:
        """Return the picture with turtles on it, each with the number of its kind."""
        image = self._image.copy()
        for kind, turtle in turtles:
            _paint_turtle(image, turtle, _KINDS[kind % len(_KINDS)])
        return image

    def _draw(self, stroke: Stroke) -> None:
        (x0, y0), (x1, y1) = stroke.start_px, stroke.end_px
        half = max(stroke.pen.width_px, 1) / 2
        rows, columns = _around(min(x0, x1), max(x0, x1), min(y0, y1), max(y0, y1), 2 * half)
        if rows.size == 0 or columns.size == 0:
            return
        length = math.hypot(x1 - x0, y1 - y0)
        along_x, along_y = ((x1 - x0) / length, (y1 - y0) / length) if length else (1.0, 0.0)
        dx, dy = columns[None, :] - x0, rows[:, None] - y0
        along = dx * along_x + dy * along_y
        aside = np.abs(dy * along_x - dx * along_y)
        inside = (aside <= half) & (along >= -half) & (along <= length + half)
        window = np.ix_(rows, columns)
        self._drawn[window] |= inside
        self._image[window] = np.where(inside[..., None], stroke.pen.color, self._image[window])


def write_png(picture: Picture, path: Path) -> None:
    """Write a picture.

    Raises:
        LaunchError: the file cannot be written.
    """
    from PIL import Image

    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(picture, "RGB").save(path, format="PNG")
    except OSError as error:
        raise LaunchError(f"the picture cannot be written to '{path}': {error.strerror}") from error


def _around(
    left: float, right: float, top: float, bottom: float, margin: float
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the rows and columns of the picture within a margin of a box."""
    rows = np.arange(max(0, math.floor(top - margin)), min(SIZE_PX, math.ceil(bottom + margin) + 1))
    columns = np.arange(
        max(0, math.floor(left - margin)), min(SIZE_PX, math.ceil(right + margin) + 1)
    )
    return rows, columns


def _paint_turtle(
    image: Picture, turtle: Turtle, kind: tuple[tuple[int, int, int], tuple[int, int, int]]
) -> None:
    x, y = turtle.place_px
    rows, columns = _around(x, x, y, y, _REACH_PX)
    cos, sin = math.cos(turtle.theta_rad), math.sin(turtle.theta_rad)
    dx, dy = columns[None, :] - x, y - rows[:, None]
    ahead, aside = dx * cos + dy * sin, dy * cos - dx * sin
    window = np.ix_(rows, columns)
    patch = image[window]
    for (centre_x, centre_y), (half_x, half_y), color in _LIMBS:
        for grown, paint in ((1.0, _OUTLINE), (0.0, kind[color])):
            inside = ((ahead - centre_x) / (half_x + grown)) ** 2 + (
                (aside - centre_y) / (half_y + grown)
            ) ** 2 <= 1
            patch[inside] = paint
    image[window] = patch
