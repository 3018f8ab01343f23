"""Versions of SDF: what the ``<sdf version>`` attribute says.

Documents of 1.0 to 1.3 are brought to 1.4 by sdformat's own rules before they are read.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

if TYPE_CHECKING:
    from gazelle.description.sdformat_emulation.element import SdfElement

__all__ = ["NEWEST_VERSION", "upgraded", "version_from", "version_of"]

Version = tuple[int, int]
_OLDEST_VERSION: Version = (1, 4)
NEWEST_VERSION: Version = (1, 12)
_FORM = re.compile(r"(\d+)\.(\d+)")
# The outermost element up to SDF 1.2.
_OLD_ROOT = "gazebo"


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
    if version < _OLDEST_VERSION:
        message = f"SDF {written} is older than 1.4; it is read as 1.4"
        context.diagnostics.report("sdf.version", message, root.span)
        return _OLDEST_VERSION
    if version > NEWEST_VERSION:
        message = f"SDF {written} is newer than 1.12; what it adds to 1.12 is not understood"
        context.diagnostics.report("sdf.version", message, root.span)
    return version


def upgraded(root: Tag, context: ReadContext) -> Tag:
    """Return a document as SDF 1.4 or later, told once when it is older.

    Args:
        root: ``<sdf>`` or ``<gazebo>``; others are returned as they are.
        context: hears of the version.
    """
    written = root.attributes.get("version")
    version = version_from(written)
    is_old = version is not None and version < _OLDEST_VERSION
    if root.name not in ("sdf", _OLD_ROOT) or not (is_old or root.name == _OLD_ROOT):
        return root
    # Hardly anybody needs it, and it takes a third of a state publisher's start to import.
    from gazelle.description.sdformat_emulation.element import raw_element
    from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console
    from gazelle.description.sdformat_emulation.gz_sdf_command.version_upgrades import upgrade
    from gazelle.description.sdformat_emulation.release import Release

    shown = f"SDF {written} is older than 1.4" if is_old else "the root element is <gazebo>"
    message = f"{shown}; it is read as sdformat brings it to 1.4"
    context.diagnostics.report("sdf.version", message, root.span)
    element = raw_element(root)
    element.name = "sdf"
    if is_old:
        target: tuple[int, int] = _OLDEST_VERSION
        upgrade(element, target, Console(Release.V9))
    return _tag(element, root.span)


def _tag(element: SdfElement, whole: SourceSpan) -> Tag:
    span = SourceSpan(whole.file, element.line or whole.line, via=whole.via)
    children = tuple(_tag(child, whole) for child in element.children)
    return Tag(element.name, span, dict(element.attributes), children, element.text, element.text)
