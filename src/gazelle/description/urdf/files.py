"""Files that a URDF names: meshes and textures."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.context import ReadContext
from gazelle.diagnostics import SourceSpan
from gazelle.workspace import Resolved

__all__ = ["find_file"]


def find_file(uri: str, span: SourceSpan, context: ReadContext) -> Resolved:
    """Resolve ``package://``, ``model://``, ``file://`` and plain paths.

    A note of the workspace about a file that was found, such as that only upper and lower case
    differ, is reported. Without a workspace only absolute paths and paths beside the file work.
    """
    if context.workspace is None:
        return _find_beside(uri, context.base_dir)
    found = context.workspace.resolve(uri, base_dir=context.base_dir)
    if found.path is not None and found.note:
        message = f"'{uri}' was found as '{found.path}': {found.note}"
        context.diagnostics.report("urdf.file-note", message, span)
    return found


def _find_beside(uri: str, base_dir: Path | None) -> Resolved:
    scheme, separator, rest = uri.partition("://")
    if separator and scheme != "file":
        return Resolved(None, note=f"{scheme}:// needs a workspace to look in")
    path = Path(rest if separator else uri)
    path = path if path.is_absolute() or base_dir is None else base_dir / path
    return Resolved(path if path.is_file() else None, (str(path),))
