"""XML with places: what URDF, SDF, SRDF and launch files are read from."""

from __future__ import annotations

from gazelle.description.xml.numbers import bool_from, float_from, floats_from, int_from
from gazelle.description.xml.reader import parse_xml, read_xml, remembering_documents
from gazelle.description.xml.spans import (
    attribute_holding,
    attribute_span,
    text_span,
    with_spans,
    written_attributes,
)
from gazelle.description.xml.tag import Tag

__all__ = [
    "Tag",
    "attribute_holding",
    "attribute_span",
    "bool_from",
    "float_from",
    "floats_from",
    "int_from",
    "parse_xml",
    "read_xml",
    "remembering_documents",
    "text_span",
    "with_spans",
    "written_attributes",
]
