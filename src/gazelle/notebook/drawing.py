"""Lines, dots and words on a sheet, written as SVG or painted as pixels.

SVG takes the colour of the text around it, so a sheet is legible on light and dark pages.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["INK", "Dots", "Label", "Raster", "Sheet", "Stroke", "painted", "svg_of"]

INK = ""
"""The colour of the text around."""

Floats = NDArray[np.float64]
_SAMPLES = 2
_PAPER_INK, _PAPER = "#222222", "#ffffff"


@dataclass(frozen=True, slots=True, eq=False)
class Stroke:
    """A line through points (N, 2), pixels; it is interrupted where a point is not finite."""

    points: Floats
    colour: str = INK
    width: float = 1.5
    opacity: float = 1.0


@dataclass(frozen=True, slots=True, eq=False)
class Dots:
    """Points (N, 2), pixels, each a disc."""

    points: Floats
    colour: str = INK
    radius: float = 1.5
    opacity: float = 1.0


@dataclass(frozen=True, slots=True)
class Label:
    """Words; `anchor` is ``start``, ``middle`` or ``end``."""

    x: float
    y: float
    text: str
    anchor: str = "start"
    colour: str = INK
    size: float = 11.0
    opacity: float = 0.8


@dataclass(frozen=True, slots=True, eq=False)
class Raster:
    """A picture, (H, W, 3 or 4) uint8, stretched over a rectangle: left, top, width, height."""

    pixels: NDArray[np.uint8]
    box: tuple[float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """What is drawn, from the bottom to the top.

    Attributes:
        width, height: pixels.
        items: what is on it.
    """

    width: float
    height: float
    items: tuple[Stroke | Dots | Label | Raster, ...]


def svg_of(sheet: Sheet, *, attributes: str = "", on_paper: bool = False) -> str:
    """Return a sheet as an ``<svg>`` element.

    Args:
        sheet: what is drawn.
        attributes: more attributes of the element.
        on_paper: as a file that stands for itself: dark on white.
    """
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {sheet.width:g} {sheet.height:g}" '
        f'width="{sheet.width:g}" height="{sheet.height:g}" font-family="system-ui,sans-serif" '
        f'style="max-width:100%;height:auto{f";color:{_PAPER_INK}" if on_paper else ""}"'
        f"{' ' if attributes else ''}{attributes}>"
    )
    paper = f'<rect width="100%" height="100%" fill="{_PAPER}"/>' if on_paper else ""
    return f"{head}{paper}{''.join(map(_element, sheet.items))}</svg>"


def painted(sheet: Sheet) -> Image:
    """Return a sheet as a picture, dark on white."""
    from PIL import Image, ImageDraw, ImageFont

    size = (round(sheet.width * _SAMPLES), round(sheet.height * _SAMPLES))
    image = Image.new("RGB", size, _PAPER)
    for item in sheet.items:
        if isinstance(item, Raster):
            _paste(image, item)
            continue
        draw = ImageDraw.Draw(image)
        ink = _mixed(item.colour, item.opacity)
        if isinstance(item, Stroke):
            for run in _runs(item.points * _SAMPLES):
                width = max(1, round(item.width * _SAMPLES))
                draw.line([*map(tuple, run.tolist())], fill=ink, width=width, joint="curve")
        elif isinstance(item, Dots):
            reach = item.radius * _SAMPLES
            for x, y in (item.points[np.isfinite(item.points).all(axis=1)] * _SAMPLES).tolist():
                draw.ellipse((x - reach, y - reach, x + reach, y + reach), fill=ink)
        else:
            font = ImageFont.load_default(item.size * _SAMPLES)
            anchor = {"start": "ls", "middle": "ms", "end": "rs"}[item.anchor]
            place = (item.x * _SAMPLES, item.y * _SAMPLES)
            draw.text(place, item.text, fill=ink, font=font, anchor=anchor)
    return image


def _element(item: Stroke | Dots | Label | Raster) -> str:
    if isinstance(item, Raster):
        left, top, width, height = item.box
        return (
            f'<image x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" '
            'preserveAspectRatio="none" style="image-rendering:pixelated" '
            f'href="data:image/png;base64,{_png(item.pixels)}"/>'
        )
    colour = escape(item.colour, quote=True) or "currentColor"
    faint = f' opacity="{item.opacity:g}"' if item.opacity < 1 else ""
    if isinstance(item, Label):
        return (
            f'<text x="{item.x:.1f}" y="{item.y:.1f}" fill="{colour}" font-size="{item.size:g}" '
            f'text-anchor="{item.anchor}"{faint}>{escape(item.text)}</text>'
        )
    if isinstance(item, Stroke):
        path = "".join("M" + "L".join(_pairs(run)) for run in _runs(item.points))
        width = item.width
    else:
        finite = item.points[np.isfinite(item.points).all(axis=1)]
        path = "".join(f"M{pair}h0" for pair in _pairs(finite))
        width = 2 * item.radius
    return (
        f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}" '
        f'stroke-linecap="round" stroke-linejoin="round"{faint}/>'
    )


def _pairs(points: Floats) -> list[str]:
    return [f"{x:.1f} {y:.1f}" for x, y in points.tolist()]


def _runs(points: Floats) -> Iterator[Floats]:
    """Yield the pieces of a line between points that are not finite."""
    finite = np.isfinite(points).all(axis=1)
    edges = np.flatnonzero(np.diff(finite.astype(np.int8), prepend=0, append=0))
    for first, last in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        # One point alone is a line to itself, so that it is seen.
        yield points[first:last] if last - first > 1 else points[[first, first]]


def _paste(image: Image, item: Raster) -> None:
    from PIL import Image as Images

    left, top, width, height = (round(value * _SAMPLES) for value in item.box)
    picture = Images.fromarray(item.pixels).convert("RGBA")
    picture = picture.resize((max(1, width), max(1, height)), Images.Resampling.NEAREST)
    image.paste(picture, (left, top), picture)


def _png(pixels: NDArray[Any]) -> str:
    from PIL import Image

    data = io.BytesIO()
    Image.fromarray(pixels).save(data, "PNG")
    return base64.b64encode(data.getvalue()).decode("ascii")


def _mixed(colour: str, opacity: float) -> tuple[int, int, int]:
    """Return a colour as it looks on the paper."""
    from PIL import ImageColor

    channels = ImageColor.getrgb(colour or _PAPER_INK)[:3]
    red, green, blue = (round(255 + (one - 255) * opacity) for one in channels)
    return red, green, blue
