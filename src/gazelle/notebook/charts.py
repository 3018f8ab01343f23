"""Charts: lines over time, and shapes in a plane with equal axes."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.notebook.drawing import INK, Label, Sheet, Stroke, painted, svg_of
from gazelle.notebook.html_parts import figure, png_text
from gazelle.notebook.scripts import script_tag
from gazelle.rich_display import Bundle

__all__ = [
    "COLOURS",
    "Line",
    "Plane",
    "chart_bundle",
    "chart_sheet",
    "plane_of",
    "scale_bar",
    "sheet_bundle",
    "sheet_png",
]

COLOURS = (
    "#3b82f6", "#f97316", "#10b981", "#ef4444", "#a855f7", "#06b6d4", "#d4a106", "#ec4899",
)  # fmt: skip
"""Of lines in turn; legible on white and on black."""

TIME = "time, s"

Floats = NDArray[np.float64]
_WIDTH, _HEIGHT = 720.0, 270.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 62.0, 12.0, 10.0, 36.0
_LEGEND_PX = 17.0
_MAX_LINES = 24
_MAX_BINS, _ALL_BINS = 500, 3000
_MARGIN = 0.06


class Line(NamedTuple):
    """A line of a chart: numbers over time, in order of time."""

    name: str
    times_s: Floats
    values: Floats


class Plane(NamedTuple):
    """A part of a plane on a sheet, with x to the right and y upwards.

    Attributes:
        left, top: pixels of its upper left corner.
        px_per_m: scale.
        x_m, y_m: what is at that corner.
    """

    left: float
    top: float
    px_per_m: float
    x_m: float
    y_m: float

    def place(self, points_m: ArrayLike) -> Floats:
        """Return pixels (N, 2) of points (N, 2)."""
        points = np.asarray(points_m, np.float64).reshape(-1, 2)
        x = self.left + (points[:, 0] - self.x_m) * self.px_per_m
        y = self.top + (self.y_m - points[:, 1]) * self.px_per_m
        return np.stack([x, y], axis=1)


class _Axis(NamedTuple):
    low: float
    high: float
    ticks: tuple[float, ...]
    digits: int


def chart_bundle(
    lines: Sequence[Line], *, x_label: str = TIME, y_label: str = "", caption: str = ""
) -> Bundle:
    """Return lines over time as a notebook shows them; with the values under the mouse."""
    sheet, frame = _chart(lines, x_label, y_label)
    mark = hashlib.sha256(svg_of(sheet).encode()).hexdigest()[:12]
    svg = svg_of(sheet, attributes=f'data-gazelle-chart="{mark}"')
    hover = script_tag("chart_hover", mark=mark, chart=frame)
    return {
        "text/html": figure(svg + hover, caption),
        "image/png": png_text(sheet_png(sheet)),
    }


def chart_sheet(lines: Sequence[Line], y_label: str = "") -> Sheet:
    """Return the sheet of lines over time."""
    return _chart(lines, TIME, y_label)[0]


def sheet_bundle(sheet: Sheet, caption: str = "") -> Bundle:
    """Return a sheet as a notebook shows it."""
    return {
        "text/html": figure(svg_of(sheet), caption),
        "image/png": png_text(sheet_png(sheet)),
    }


def sheet_png(sheet: Sheet) -> bytes:
    """Return the PNG of a sheet."""
    import io

    data = io.BytesIO()
    painted(sheet).save(data, "PNG", optimize=False)
    return data.getvalue()


def plane_of(
    points_m: ArrayLike, *, size_px: float = 420.0, top: float = 8.0, margin: float = _MARGIN
) -> tuple[Plane, float, float]:
    """Return a plane that all finite points (N, 2) lie in, and its sheet's width and height.

    Args:
        points_m: x, y.
        size_px: of the longer side.
        top: room above.
        margin: around, as a share of the longer side.
    """
    points = np.asarray(points_m, np.float64).reshape(-1, 2)
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        points = np.zeros((1, 2))
    low, high = points.min(axis=0), points.max(axis=0)
    reach = max(float((high - low).max()), 1e-3)
    low, high = low - margin * reach, high + margin * reach
    scale = size_px / float((high - low).max())
    width, height = ((high - low) * scale).tolist()
    plane = Plane(8.0, top, scale, float(low[0]), float(high[1]))
    return plane, max(width, 60.0) + 16.0, max(height, 40.0) + top + 8.0


def scale_bar(plane: Plane, width: float, height: float) -> tuple[Stroke | Label, ...]:
    """Return a bar of a round length in the lower left corner."""
    length_m = _round_step(90.0 / plane.px_per_m)
    right = 12.0 + length_m * plane.px_per_m
    bar = np.array([[12.0, height - 10.0], [right, height - 10.0]])
    return (
        Stroke(bar, INK, 2.0, 0.8),
        Label(right + 6.0, height - 6.5, f"{length_m:g} m"),
    )


def _chart(lines: Sequence[Line], x_label: str, y_label: str) -> tuple[Sheet, dict[str, Any]]:
    left_out = max(0, len(lines) - _MAX_LINES)
    bins = max(50, min(_MAX_BINS, _ALL_BINS // max(1, min(len(lines), _MAX_LINES))))
    shown = [_thinned(line, bins) for line in lines[:_MAX_LINES]]
    x = _axis([line.times_s for line in shown], 8)
    y = _axis([line.values for line in shown], 5, margin=0.05)
    legend, top = _legend(shown, left_out)
    bottom = top + _HEIGHT - _TOP - _BOTTOM
    box = (_LEFT, top, _WIDTH - _RIGHT, bottom)
    items: list[Any] = [*_grid(x, y, box, (x_label, y_label)), *legend]
    for number, line in enumerate(shown):
        points = np.stack(
            [
                np.interp(line.times_s, (x.low, x.high), (box[0], box[2])),
                bottom + (line.values - y.low) / (y.high - y.low) * (top - bottom),
            ],
            axis=1,
        )
        items.append(Stroke(points, COLOURS[number % len(COLOURS)], 1.6))
    frame = {
        "box": box,
        "x": (x.low, x.high),
        "lines": [
            {
                "name": line.name,
                "colour": COLOURS[number % len(COLOURS)],
                "times": [float(f"{value:.6g}") for value in line.times_s.tolist()],
                "values": [_json_number(value) for value in line.values.tolist()],
            }
            for number, line in enumerate(shown)
        ],
    }
    return Sheet(_WIDTH, bottom + _BOTTOM, tuple(items)), frame


def _legend(lines: Sequence[Line], left_out: int) -> tuple[list[Any], float]:
    """Return names of lines with their colours, and where the chart below begins."""
    items: list[Any] = []
    x, y = _LEFT, _TOP + 8.0
    names = [line.name for line in lines]
    if left_out:
        names.append(f"… and {left_out} more")
    for number, name in enumerate(names):
        width = 22.0 + 6.6 * len(name)
        if x + width > _WIDTH - _RIGHT and x > _LEFT:
            x, y = _LEFT, y + _LEGEND_PX
        if number < len(lines):
            dash = np.array([[x, y - 4.0], [x + 12.0, y - 4.0]])
            items.append(Stroke(dash, COLOURS[number % len(COLOURS)], 3.0))
        items.append(Label(x + 16.0, y, name))
        x += width
    return items, (y + 8.0 if names else _TOP)


def _grid(x: _Axis, y: _Axis, box: tuple[float, ...], labels: tuple[str, str]) -> list[Any]:
    left, top, right, bottom = box
    items: list[Any] = []
    for tick in y.ticks:
        place = bottom + (tick - y.low) / (y.high - y.low) * (top - bottom)
        items.append(Stroke(np.array([[left, place], [right, place]]), INK, 0.6, 0.2))
        items.append(Label(left - 6.0, place + 4.0, f"{tick:.{y.digits}f}", "end"))
    for tick in x.ticks:
        place = left + (tick - x.low) / (x.high - x.low) * (right - left)
        items.append(Stroke(np.array([[place, top], [place, bottom]]), INK, 0.6, 0.12))
        items.append(Label(place, bottom + 15.0, f"{tick:.{x.digits}f}", "middle"))
    items.append(Label(right, bottom + 30.0, labels[0], "end"))
    if labels[1]:
        items.append(Label(left, bottom + 30.0, labels[1]))
    return items


def _axis(arrays: Sequence[Floats], count: int, margin: float = 0.0) -> _Axis:
    finite = [array[np.isfinite(array)] for array in arrays]
    values = np.concatenate(finite) if finite else np.zeros(0)
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    if high - low < 1e-9 * max(1.0, abs(high), abs(low)):
        reach = max(abs(high), 1.0) * (0.5 if margin else 1.0)
        low, high = (low - reach, high + reach) if margin else (low, low + reach)
    low, high = low - margin * (high - low), high + margin * (high - low)
    step = _round_step((high - low) / count)
    first = math.ceil(low / step - 1e-9)
    ticks = tuple(step * number for number in range(first, math.floor(high / step + 1e-9) + 1))
    return _Axis(low, high, ticks, max(0, -math.floor(math.log10(step) + 1e-9)))


def _round_step(wanted: float) -> float:
    """Return 1, 2 or 5 times a power of ten, not below what is wanted."""
    power = 10.0 ** math.floor(math.log10(max(wanted, 1e-12)))
    return next(power * one for one in (1.0, 2.0, 5.0, 10.0) if power * one >= wanted * 0.999)


def _thinned(line: Line, bins: int) -> Line:
    """Keep the least and the greatest value of each of so many spans: peaks stay."""
    count = len(line.times_s)
    if count <= 2 * bins:
        return line
    edges = np.linspace(0, count, bins + 1).astype(int)
    kept: list[int] = [0, count - 1]
    for first, last in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        part = line.values[first:last]
        if np.isnan(part).all():
            kept.append(first)
            continue
        kept += [first + int(np.nanargmin(part)), first + int(np.nanargmax(part))]
    chosen = np.unique(kept)
    return Line(line.name, line.times_s[chosen], line.values[chosen])


def _json_number(value: float) -> float | None:
    return float(f"{value:.5g}") if math.isfinite(value) else None
