"""The place of what was left open, not where it shows."""

from __future__ import annotations

from pathlib import Path
from xml.parsers import expat

import pytest

from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.documents.malformed_xml import MalformedXml, malformed_xml

LINK = '<robot name="r">\n  <link name="a">\n    {}\n  </link>\n</robot>\n'


def explained(text: str | bytes) -> MalformedXml:
    data = text.encode() if isinstance(text, str) else text
    with pytest.raises(expat.ExpatError) as raised:
        expat.ParserCreate().Parse(data, True)
    return malformed_xml(data, raised.value)


@pytest.mark.parametrize(
    ("inside", "line", "column", "words", "fix"),
    [
        (
            "<visual>\n    <!-- </visual> -->",
            3, 5, "<visual> has no end before </link> of line 5", "write </visual> where it ends",
        ),
        (
            '<inertial><mass value="1">\n    </inertial>',
            3, 15, "<mass> has no end before </inertial> of line 4", "write <mass …/>",
        ),
        ("<visual></visul>", 3, 13, "</visul> ends nothing, <visual> of line 3 is open",
         "write </visual>"),
        ('<child link="b/>\n    <axis xyz="0 0 1"/>', 3, 17,
         'the value of link begins with " and has no end', 'write "b"'),
    ],
)  # fmt: skip
def test_what_is_left_open_is_the_place(
    inside: str, line: int, column: int, words: str, fix: str
) -> None:
    found = explained(LINK.format(inside))
    assert (found.line, found.column, found.fix) == (line, column, fix)
    assert words in found.message
    assert found.message.startswith("not well-formed XML: ")


def test_element_open_at_the_end_of_the_file() -> None:
    found = explained("<launch>\n  <group>\n    <node/>\n  </group>\n")
    assert found == MalformedXml(
        "not well-formed XML: no element found: <launch> has no end, and the file is over",
        1, 1, "write </launch> where it ends",
    )  # fmt: skip


def test_other_mistakes_are_told_where_the_parser_stops() -> None:
    assert explained("<a b='1' b='2'/>")[:3] == ("not well-formed XML: duplicate attribute", 1, 10)
    assert explained("<a b=1/>")[:3] == (
        "not well-formed XML: not well-formed (invalid token)", 1, 6,
    )  # fmt: skip
    assert explained("<a>\n<b></a>".encode("utf-16")).message == (
        "not well-formed XML: mismatched tag"
    )


def test_readers_tell_that_place(tmp_path: Path) -> None:
    found = Diagnostics()
    assert parse_xml(LINK.format("<visual>"), "r.urdf", found) is None
    (item,) = found
    assert str(item.span) == "r.urdf:3:5"
    assert item.fix == "write </visual> where it ends"
