"""Files that a URDF names: meshes and textures."""

from __future__ import annotations

from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import SourceSpan
from gazelle.workspace import Resolved

__all__ = ["find_file"]


def find_file(uri: str, span: SourceSpan, context: ReadContext) -> Resolved:
    """Resolve ``package://``, ``model://``, ``file://`` and plain paths.

    A note of the workspace about a file that was found, such as that only upper and lower case
    differ, is reported.
    """
    found = context.resolve(uri)
    if found.path is not None and found.is_off_path:
        context.report_note(uri, found, span, "urdf.file-note")
    elif found.path is not None and found.note:
        message = f"'{uri}' was found as '{found.path}': {found.note}"
        context.diagnostics.report("urdf.file-note", message, span)
    return found
