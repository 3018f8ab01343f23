"""Textures with their reduced copies (mip-maps), packed for the kernels."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.documents.images import PictureError, opened_picture

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["LEVELS", "TextureAtlas"]

LEVELS = 13
_MAX_PX = 1 << (LEVELS - 1)


class TextureAtlas:
    """Collects textures and lays them out one after the other.

    Attributes:
        diagnostics: told about images that cannot be read.
    """

    def __init__(self, diagnostics: Diagnostics) -> None:
        self.diagnostics = diagnostics
        self._numbers: dict[object, int] = {}
        self._chains: list[list[NDArray[np.uint8]]] = []

    def add(self, source: Path | bytes | None) -> int:
        """Return a texture's number, -1 for none or one that cannot be read."""
        if source is None:
            return -1
        if source not in self._numbers:
            pixels = self._read(source)
            self._numbers[source] = -1 if pixels is None else len(self._chains)
            if pixels is not None:
                self._chains.append(_reduced_copies(pixels))
        return self._numbers[source]

    def width_px(self, number: int) -> int:
        """Return a texture's full width."""
        return int(self._chains[number][0].shape[1])

    def packed(
        self,
    ) -> tuple[NDArray[np.uint8], NDArray[np.int64], NDArray[np.int64]]:
        """Return texels, (T, LEVELS, 3) offset, width, height of each level, (T,) counts."""
        levels = np.zeros((max(1, len(self._chains)), LEVELS, 3), np.int64)
        counts = np.ones(max(1, len(self._chains)), np.int64)
        offset = 0
        for number, chain in enumerate(self._chains):
            counts[number] = len(chain)
            for level, pixels in enumerate(chain):
                levels[number, level] = (offset, pixels.shape[1], pixels.shape[0])
                offset += pixels.size
        flat = [pixels.ravel() for chain in self._chains for pixels in chain]
        return np.concatenate(flat) if flat else np.zeros(12, np.uint8), levels, counts

    def _read(self, source: Path | bytes) -> NDArray[np.uint8] | None:
        try:
            with opened_picture(source) as image:
                return np.asarray(_power_of_two(image.convert("RGB")))
        except (OSError, PictureError) as error:
            name = "embedded in a mesh" if isinstance(source, bytes) else f"'{source}'"
            place = None if isinstance(source, bytes) else SourceSpan(str(source))
            self.diagnostics.report(
                "sensors.unreadable-texture",
                f"texture {name} cannot be read ({error}); the plain colour is shown",
                place,
            )
            return None


def _power_of_two(image: Image) -> Image:
    from PIL.Image import Resampling

    sides = [min(_MAX_PX, 1 << (side - 1).bit_length()) for side in image.size]
    size = (sides[0], sides[1])
    return image if image.size == size else image.resize(size, Resampling.BICUBIC)


def _reduced_copies(pixels: NDArray[np.uint8]) -> list[NDArray[np.uint8]]:
    chain = [np.ascontiguousarray(pixels)]
    exact: NDArray[np.floating] = pixels.astype(np.float32)
    while max(exact.shape[:2]) > 1:
        if exact.shape[0] > 1:
            exact = (exact[0::2] + exact[1::2]) / 2
        if exact.shape[1] > 1:
            exact = (exact[:, 0::2] + exact[:, 1::2]) / 2
        chain.append(np.round(exact).astype(np.uint8))
    return chain
