"""SDF documents read, upgraded, completed, printed and judged as sdformat does."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.document_reader import (
    normalised,
    read_document,
    read_document_file,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.element_reader import Document
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import to_text

__all__ = [
    "Console",
    "Document",
    "SdfError",
    "normalised",
    "read_document",
    "read_document_file",
    "to_text",
]
