"""Meshes and textures of a replay: small, and told once however often they are used."""

from __future__ import annotations

import hashlib
import io
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.documents.images import PictureError, opened_picture
from gazelle.geometry import MeshPart
from gazelle.studio.replay.packing import Pack
from gazelle.studio.scenes.assets import Assets

__all__ = ["PackedAssets"]

_STEPS = 4095
"""Of a mesh's longest side: of a robot of half a metre one is 0.12 mm."""

_FINE_STEPS = 65535
_LARGE_M = 3.0
_UV_STEPS = 4096
_NORMAL_STEPS = 63
_MAX_TEXTURE_PX = 512
_QUALITY = 80


class PackedAssets(Assets):
    """What a scene of a replay refers to, written into a pack.

    Attributes:
        meshes: by key, where its arrays are.
        textures: by key, where its picture is.
    """

    def __init__(self, pack: Pack) -> None:
        """Write into a pack."""
        super().__init__()
        self._pack = pack
        self.meshes: dict[str, dict[str, Any]] = {}
        self.textures: dict[str, list[int]] = {}

    def add_mesh(self, part: MeshPart) -> str:
        """Return the key of a mesh part."""
        digest = hashlib.sha256(part.vertices_m.tobytes())
        digest.update(part.faces.tobytes())
        digest.update(b"" if part.uv is None else part.uv.tobytes())
        key = digest.hexdigest()[:12]
        if key not in self.meshes:
            self.meshes[key] = self._packed(part)
        return key

    def add_texture(self, source: Path | bytes) -> str | None:
        """Return the key of a picture's file or bytes, None when it cannot be read."""
        data = _reduced(source)
        if data is None:
            return None
        key = hashlib.sha256(data).hexdigest()[:12]
        if key not in self.textures:
            self.textures[key] = self._pack.raw(data)
        return key

    def _packed(self, part: MeshPart) -> dict[str, Any]:
        vertices = np.asarray(part.vertices_m, np.float64)
        low = vertices.min(axis=0) if len(vertices) else np.zeros(3)
        side = float(np.ptp(vertices, axis=0).max()) if len(vertices) else 0.0
        step = max(side, 1e-9) / (_FINE_STEPS if side > _LARGE_M else _STEPS)
        value = {
            "low": low.tolist(),
            "step": step,
            "vertices": self._pack.integers(np.rint((vertices - low) / step)),
            "normals": self._pack.integers(_octahedral(np.asarray(part.normals, np.float64))),
            "corners": self._pack.integers(np.asarray(part.faces).reshape(-1)),
        }
        if part.uv is not None:
            value["uv"] = self._pack.integers(np.rint(np.asarray(part.uv) * _UV_STEPS))
        return value


def _octahedral(normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unit vectors as two whole numbers each: folded onto a square."""
    length = np.abs(normals).sum(axis=1, keepdims=True)
    unit = normals / np.where(length > 0.0, length, 1.0)
    x, y = unit[:, 0], unit[:, 1]
    below = unit[:, 2] < 0.0
    folded_x = np.where(below, (1.0 - np.abs(y)) * np.where(x >= 0.0, 1.0, -1.0), x)
    folded_y = np.where(below, (1.0 - np.abs(x)) * np.where(y >= 0.0, 1.0, -1.0), y)
    square = np.stack([folded_x, folded_y], axis=1)
    return np.asarray(np.rint(square * _NORMAL_STEPS))


def _reduced(source: Path | bytes) -> bytes | None:
    """Return a picture as WebP of 512 pixels at most."""
    try:
        with opened_picture(source) as image:
            plain = image.convert("RGBA" if image.mode in ("RGBA", "LA", "P") else "RGB")
            plain.thumbnail((_MAX_TEXTURE_PX, _MAX_TEXTURE_PX))
            out = io.BytesIO()
            plain.save(out, "WEBP", quality=_QUALITY)
    except (OSError, PictureError):
        return None
    return out.getvalue()
