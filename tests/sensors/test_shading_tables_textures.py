"""Textures and their reduced copies."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from gazelle.diagnostics import Diagnostics
from gazelle.sensors.shading_tables import TextureAtlas


def _png(pixels: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "PNG")
    return buffer.getvalue()


def test_reduced_copies_keep_the_mean_colour() -> None:
    pixels = np.random.default_rng(0).integers(0, 255, (64, 16, 3), np.uint8)
    atlas = TextureAtlas(Diagnostics())
    assert atlas.add(_png(pixels)) == 0
    texels, levels, counts = atlas.packed()
    assert counts.tolist() == [7]
    assert levels[0, 0].tolist() == [0, 16, 64]
    assert levels[0, 6, 1:].tolist() == [1, 1]
    last = texels[levels[0, 6, 0] :][:3]
    assert np.abs(last - pixels.reshape(-1, 3).mean(axis=0)).max() < 1


def test_pictures_are_brought_to_powers_of_two_and_kept_once() -> None:
    atlas = TextureAtlas(Diagnostics())
    data = _png(np.full((5, 100, 3), 77, np.uint8))
    assert (atlas.add(data), atlas.add(data), atlas.add(None)) == (0, 0, -1)
    texels, levels, _ = atlas.packed()
    assert levels[0, 0].tolist() == [0, 128, 8]
    assert np.unique(texels).tolist() == [77]


def test_unreadable_embedded_picture_is_reported() -> None:
    diagnostics = Diagnostics()
    assert TextureAtlas(diagnostics).add(b"nothing") == -1
    (found,) = diagnostics.by_code("sensors.unreadable-texture")
    assert "embedded in a mesh" in found.message
