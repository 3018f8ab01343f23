from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.loader import load_models
from gazelle.description.xml import (
    Tag,
    attribute_holding,
    attribute_span,
    parse_xml,
    text_span,
    with_spans,
    written_attributes,
)
from gazelle.diagnostics import Diagnostics, SourceSpan

TEXT = """<?xml version="1.0"?>
<robot name="r">
  <a first = 'x &lt; ${n}'
     second="${n}&#10;ü ${m}">
    outside <b c="${m}">inside ${m}</b> <!-- ${m} --> at ${m}
  </a>
</robot>
"""


@pytest.fixture
def tag(tmp_path: Path) -> Tag:
    path = tmp_path / "r.xml"
    path.write_text(TEXT, encoding="utf-8")
    root = parse_xml(TEXT, str(path), Diagnostics())
    assert root is not None
    return root.children[0]


def _place(span: SourceSpan) -> tuple[int, int, int]:
    return span.line, span.column, span.length


def test_attributes_are_found_by_name_and_part(tag: Tag) -> None:
    assert _place(attribute_span(tag.span, "first")) == (3, 15, 11)
    assert _place(attribute_span(tag.span, "first", "${n}")) == (3, 22, 4)
    assert _place(attribute_span(tag.span, "first", "< $")) == (3, 17, 6)
    assert _place(attribute_span(tag.span, "second", "${m}")) == (4, 25, 4)
    assert _place(attribute_span(tag.span, "second", whole=True)) == (4, 6, 24)
    assert _place(attribute_span(tag.span, "second", "not there")) == (4, 14, 15)


def test_attributes_are_read_as_xml_reads_them(tag: Tag) -> None:
    assert (
        written_attributes(tag.span)
        == tag.attributes
        == {
            "first": "x < ${n}",
            "second": "${n}\nü ${m}",
        }
    )
    assert attribute_holding(tag.span, "x < ${n}") == "first"
    assert attribute_holding(tag.span, "y") == ""


def test_text_is_that_of_the_element_alone(tag: Tag) -> None:
    assert _place(text_span(tag.span, "at ${m}")) == (5, 55, 7)
    assert _place(text_span(tag.children[0].span, "${m}")) == (5, 32, 4)
    assert text_span(tag.span, "nowhere") == tag.span


def test_place_that_is_no_tag_any_more_stays(tag: Tag, tmp_path: Path) -> None:
    (tmp_path / "r.xml").write_text("<robot/>", encoding="utf-8")
    assert attribute_span(tag.span, "first") == tag.span
    gone = SourceSpan("<text>", 3, 3)
    assert attribute_span(gone, "first") == gone
    assert text_span(gone, "x") == gone


def test_places_are_given_in_document_order(tag: Tag) -> None:
    spans = [None, SourceSpan("other", 7)]
    moved = with_spans(tag, spans)
    assert moved.span == tag.span
    assert moved.children[0].span == SourceSpan("other", 7)
    assert moved.attributes == tag.attributes


def test_bad_number_is_shown_in_its_attribute(tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r"><link name="a"><visual>\n<origin rpy="0 0 0"\n  xyz="0 0,5 0"/>\n'
        '<geometry><box size="1 1 1"/></geometry></visual></link></robot>',
        encoding="utf-8",
    )
    diagnostics = Diagnostics()
    load_models(path, workspace=None, diagnostics=diagnostics)
    (found,) = diagnostics.by_code("xml.bad-number")
    assert found.span == SourceSpan(str(path), 3, 10, 3)
    assert "the decimal sign is a dot, not a comma" in found.message
