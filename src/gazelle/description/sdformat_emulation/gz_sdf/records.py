"""The record of a document that was read."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.console import Console, SdfError

__all__ = ["Document"]


@dataclass(frozen=True, slots=True)
class Document:
    """What a release makes of a document.

    Attributes:
        root: ``<sdf>`` of the release's version, every value checked, everything required there;
            None when sdformat refuses the document.
        original_version: version that the document says; empty when it says none.
        errors: with numbers, as ``readFile`` returns them.
        console: lines that the library writes meanwhile.
        included_from: the ``<include>`` that an element came from, by identity of the element.
        versions: version of the file that an included element came from, by identity.
    """

    root: SdfElement | None
    original_version: str
    errors: tuple[SdfError, ...]
    console: Console
    included_from: dict[int, SdfElement] = field(default_factory=dict)
    versions: dict[int, tuple[int, ...]] = field(default_factory=dict)
