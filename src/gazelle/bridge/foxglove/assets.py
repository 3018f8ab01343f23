"""Files that a robot's description names, for viewers that draw it.

The server answers any web page, so only what a description is made of leaves this machine: files of
such kinds, inside packages and models.
"""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from urllib.parse import unquote

if TYPE_CHECKING:
    from gazelle.workspace import Workspace

__all__ = ["read_asset"]

_SCHEMES = ("package", "model")
_MESHES = frozenset({".dae", ".fbx", ".glb", ".gltf", ".mtl", ".obj", ".stl"})
_PICTURES = frozenset({".bmp", ".jpeg", ".jpg", ".png", ".tga", ".tif", ".tiff", ".webp"})
_DESCRIPTIONS = frozenset({".sdf", ".srdf", ".urdf", ".xacro"})


def read_asset(workspace: Workspace, uri: str) -> bytes | None:
    """Return a file's bytes, None when there is none, or it is none of a viewer's business.

    Args:
        workspace: finds packages and models.
        uri: ``package://…`` or ``model://…``.
    """
    scheme, _, place = uri.partition("://")
    path = PurePosixPath(unquote(place))
    if scheme not in _SCHEMES or not _stays_inside(unquote(place)):
        return None
    if path.suffix.lower() not in _MESHES | _PICTURES | _DESCRIPTIONS:
        return None
    found = workspace.resolve(uri).path
    return found.read_bytes() if found is not None and found.is_file() else None


def _stays_inside(place: str) -> bool:
    """Whether no part of a path leads out of the package that it starts with."""
    return not any(part in ("", ".", "..") or set("\\:") & set(part) for part in place.split("/"))
