"""SDF documents read, upgraded, completed, printed and judged as sdformat does."""

from __future__ import annotations

from gazelle.description.sdformat.document.console import Console, SdfError
from gazelle.description.sdformat.document.documents import (
    normalised,
    read_document,
    read_document_file,
)
from gazelle.description.sdformat.document.printing import to_text
from gazelle.description.sdformat.document.records import Document

__all__ = [
    "Console",
    "Document",
    "SdfError",
    "normalised",
    "read_document",
    "read_document_file",
    "to_text",
]
