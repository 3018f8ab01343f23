"""Colours of values: RViz's rainbow, and maps for depth pictures."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["COLORMAPS", "colormap", "parsed_colour", "rainbow"]

Table = NDArray[np.uint8]


def _gray(t: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([t, t, t], axis=1)


def _jet(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """MATLAB's jet: three trapezia."""
    return np.stack([1.5 - np.abs(4 * t - centre) for centre in (3.0, 2.0, 1.0)], axis=1)


def _hot(t: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.stack([3 * t, 3 * t - 1, 3 * t - 2], axis=1)


def _rainbow(t: NDArray[np.float64]) -> NDArray[np.float64]:
    """RViz's rainbow: from magenta over blue and green to red at 1 (its getRainbowColor)."""
    position = np.clip(t, 0.0, 1.0) * 5.0 + 1.0
    sector = np.floor(position).astype(int)
    part = position - sector
    n = np.where(sector % 2 == 0, part, 1.0 - part)
    zero, one = np.zeros_like(t), np.ones_like(t)
    rows = {
        1: (n, zero, one),
        2: (zero, n, one),
        3: (zero, one, n),
        4: (n, one, zero),
        5: (one, n, zero),
        6: (one, n, zero),
    }
    made = np.zeros((len(t), 3))
    for number, colours in rows.items():
        chosen = sector == number
        made[chosen] = np.stack(colours, axis=1)[chosen]
    return made


COLORMAPS: dict[str, Callable[[NDArray[np.float64]], NDArray[np.float64]]] = {
    "gray": _gray,
    "hot": _hot,
    "jet": _jet,
    "rainbow": _rainbow,
}
"""Names of the maps for depth."""


@lru_cache(maxsize=len(COLORMAPS))
def colormap(name: str) -> Table:
    """Return the 256 colours of a map, (256, 3)."""
    made = COLORMAPS[name](np.linspace(0.0, 1.0, 256))
    return np.round(np.clip(made, 0.0, 1.0) * 255.0).astype(np.uint8)


@lru_cache(maxsize=1)
def rainbow() -> NDArray[np.uint32]:
    """Return RViz's rainbow from magenta to red: (256,) opaque RGBA colours, R the lowest byte."""
    table = np.full((256, 4), 255, np.uint8)
    table[:, :3] = colormap("rainbow")
    return table.view("<u4").reshape(-1)


def parsed_colour(text: Any, default: tuple[int, int, int]) -> tuple[int, int, int]:
    """Return a colour of RViz's properties: ``255; 0; 0``, ``#ff0000`` or ``[255, 0, 0]``."""
    if isinstance(text, str) and text.startswith("#") and len(text) == 7:
        channels: list[Any] = [int(text[start : start + 2], 16) for start in (1, 3, 5)]
    elif isinstance(text, str):
        channels = text.replace(";", " ").replace(",", " ").split()
    elif isinstance(text, list):
        channels = text
    else:
        return default
    try:
        numbers = [min(max(int(float(channel)), 0), 255) for channel in channels]
    except (TypeError, ValueError, OverflowError):
        return default
    return (numbers[0], numbers[1], numbers[2]) if len(numbers) == 3 else default
