"""Meshes and textures as the page loads them, each under the key of its content.

Keys are made when a scene is; the bytes when the page asks for them.
"""

from __future__ import annotations

import hashlib
import io
import struct
import threading
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path

import numpy as np

from gazelle.geometry import MeshPart
from gazelle.studio.http_answers import Answer

__all__ = ["Assets", "mesh_answer", "texture_answer"]

_HEAD = struct.Struct("<4I")
_HAS_UV = 1
_MAX_KEYS = 20_000
_MAX_TEXTURE_PX = 4096
_PASSED_ON = {"PNG": "image/png", "JPEG": "image/jpeg"}


def mesh_answer(assets: Assets, key: str) -> Answer | None:
    """``/mesh/<key>``."""
    return assets.get("mesh", key)


def texture_answer(assets: Assets, key: str) -> Answer | None:
    """``/texture/<key>``."""
    return assets.get("texture", key)


class Assets:
    """What scenes of a Studio refer to, oldest forgotten first."""

    def __init__(self) -> None:
        """Hold nothing."""
        self._lock = threading.Lock()
        self._made: OrderedDict[tuple[str, str], Callable[[], Answer | None]] = OrderedDict()

    def add_mesh(self, part: MeshPart) -> str:
        """Return the key of a mesh part."""
        digest = hashlib.sha256(part.vertices_m.tobytes())
        digest.update(part.faces.tobytes())
        digest.update(b"" if part.uv is None else part.uv.tobytes())
        return self._add("mesh", digest.hexdigest()[:32], lambda: _mesh(part))

    def add_texture(self, source: Path | bytes) -> str | None:
        """Return the key of a picture's file or bytes, None when it cannot be read."""
        try:
            data = source if isinstance(source, bytes) else source.read_bytes()
        except OSError:
            return None
        key = hashlib.sha256(data).hexdigest()[:32]
        answer = _texture(data)
        return None if answer is None else self._add("texture", key, lambda: answer)

    def get(self, kind: str, key: str) -> Answer | None:
        """Return what a key stands for."""
        with self._lock:
            make = self._made.get((kind, key))
        return make() if make is not None else None

    def _add(self, kind: str, key: str, make: Callable[[], Answer | None]) -> str:
        with self._lock:
            self._made[kind, key] = make
            self._made.move_to_end((kind, key))
            while len(self._made) > _MAX_KEYS:
                self._made.popitem(last=False)
        return key


def _mesh(part: MeshPart) -> Answer:
    corners = np.ascontiguousarray(part.faces, "<u4").reshape(-1)
    arrays = [
        np.ascontiguousarray(part.vertices_m, "<f4"),
        np.ascontiguousarray(part.normals, "<f4"),
    ]
    if part.uv is not None:
        arrays.append(np.ascontiguousarray(part.uv, "<f4"))
    flags = 0 if part.uv is None else _HAS_UV
    head = _HEAD.pack(len(part.vertices_m), len(corners), flags, 0)
    body = b"".join((head, *(one.tobytes() for one in arrays), corners.tobytes()))
    return Answer(body, "application/octet-stream", lasting=True, packed=False)


def _texture(data: bytes) -> Answer | None:
    """PNG and JPEG as they are, all else that Pillow reads as PNG."""
    from PIL import Image, UnidentifiedImageError

    try:
        with Image.open(io.BytesIO(data)) as image:
            passed = _PASSED_ON.get(image.format or "")
            if passed is not None and max(image.size) <= _MAX_TEXTURE_PX:
                return Answer(data, passed, lasting=True, packed=False)
            image.thumbnail((_MAX_TEXTURE_PX, _MAX_TEXTURE_PX))
            out = io.BytesIO()
            image.convert("RGBA").save(out, "PNG")
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError):
        return None
    return Answer(out.getvalue(), "image/png", lasting=True, packed=False)
