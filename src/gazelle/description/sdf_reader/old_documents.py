"""SDF 1.0 to 1.3, brought to 1.4 by sdformat's own rules before it is read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.versions import OLDEST_VERSION, version_from
from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

if TYPE_CHECKING:
    from gazelle.description.sdformat_emulation.element import SdfElement

__all__ = ["OLD_ROOT", "upgraded"]

# The outermost element up to SDF 1.2.
OLD_ROOT = "gazebo"


def upgraded(root: Tag, context: ReadContext) -> Tag:
    """Return a document as SDF 1.4 or later, told once when it is older.

    Args:
        root: ``<sdf>`` or ``<gazebo>``; others are returned as they are.
        context: hears of the version.
    """
    written = root.attributes.get("version")
    version = version_from(written)
    is_old = version is not None and version < OLDEST_VERSION
    if root.name not in ("sdf", OLD_ROOT) or not (is_old or root.name == OLD_ROOT):
        return root
    # Hardly anybody needs it, and it takes a third of a state publisher's start to import.
    from gazelle.description.sdformat_emulation.gz_sdf.console import Console
    from gazelle.description.sdformat_emulation.gz_sdf.raw import raw_element
    from gazelle.description.sdformat_emulation.gz_sdf.version_upgrades import upgrade
    from gazelle.description.sdformat_emulation.release import Release

    shown = f"SDF {written} is older than 1.4" if is_old else "the root element is <gazebo>"
    message = f"{shown}; it is read as sdformat brings it to 1.4"
    context.diagnostics.report("sdf.version", message, root.span)
    element = raw_element(root)
    element.name = "sdf"
    if is_old:
        target: tuple[int, int] = OLDEST_VERSION
        upgrade(element, target, Console(Release.V9))
    return _tag(element, root.span)


def _tag(element: SdfElement, whole: SourceSpan) -> Tag:
    span = SourceSpan(whole.file, element.line or whole.line, via=whole.via)
    children = tuple(_tag(child, whole) for child in element.children)
    return Tag(element.name, span, dict(element.attributes), children, element.text, element.text)
