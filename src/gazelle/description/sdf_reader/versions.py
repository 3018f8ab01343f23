"""SDF versions: what the ``<sdf version>`` attribute says."""

from __future__ import annotations

import re

from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag

__all__ = ["NEWEST_VERSION", "OLDEST_VERSION", "version_from", "version_of"]

Version = tuple[int, int]
OLDEST_VERSION: Version = (1, 4)
NEWEST_VERSION: Version = (1, 12)
_FORM = re.compile(r"(\d+)\.(\d+)")


def version_from(text: str | None) -> Version | None:
    """Return ``1.6`` as (1, 6); None when the text is no version."""
    match = _FORM.match(text.strip()) if text else None
    return (int(match[1]), int(match[2])) if match else None


def version_of(root: Tag, context: ReadContext) -> Version:
    """Return a document's version; tell when it is missing, older than 1.4 or newer than 1.12."""
    written = root.attributes.get("version")
    version = version_from(written)
    if version is None:
        shown = f"the version '{written}' is no version" if written else "there is no version"
        message = f"{shown}; the file is read as SDF 1.6"
        context.diagnostics.report("sdf.version", message, root.span)
        return (1, 6)
    if version < OLDEST_VERSION:
        message = f"SDF {written} is older than 1.4; it is read as 1.4"
        context.diagnostics.report("sdf.version", message, root.span)
        return OLDEST_VERSION
    if version > NEWEST_VERSION:
        message = f"SDF {written} is newer than 1.12; what it adds to 1.12 is not understood"
        context.diagnostics.report("sdf.version", message, root.span)
    return version
