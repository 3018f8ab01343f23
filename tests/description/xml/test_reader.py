from __future__ import annotations

from pathlib import Path

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.xml import Tag, parse_xml, read_xml, remembering_documents
from gazelle.diagnostics import Diagnostics, Severity

TESTS = Path(__file__).parents[2]


def parse(text: str | bytes) -> tuple[Tag | None, Diagnostics]:
    diagnostics = Diagnostics()
    return parse_xml(text, "a.urdf", diagnostics), diagnostics


def test_tags_know_their_line_and_column():
    root, diagnostics = parse(
        '<?xml version="1.0"?>\n<robot name="r">\n  <link name="a"/>\n</robot>'
    )
    assert not len(diagnostics)
    link = root.find("link")
    assert (str(root.span), str(link.span)) == ("a.urdf:2:1", "a.urdf:3:3")
    assert link.span.length == len("<link")
    assert link.attributes == {"name": "a"}


def test_blank_lines_before_the_declaration_are_forgiven_and_counted():
    root, diagnostics = parse('\n\n<?xml version="1.0"?>\n<a>\n<b></a>')
    assert root is None
    (found,) = diagnostics
    assert found.span.line == 5
    root, _ = parse('\n\n<?xml version="1.0"?>\n<a/>')
    assert root.span.line == 4


def test_text_is_stripped_and_joined_around_children():
    root, _ = parse("<a>\n one <b/> two\n</a>")
    assert root.text == "one two"
    assert root.raw_text == "\n one  two\n"


def test_undeclared_prefixes_are_kept():
    root, diagnostics = parse('<r><controller:diff name="c"/></r>')
    assert root.children[0].name == "controller:diff"
    assert not len(diagnostics)


def test_the_declared_encoding_counts_for_bytes_only():
    text = '<?xml version="1.0" encoding="latin-1"?><a name="ä"/>'
    assert parse(text.encode("latin-1"))[0].attributes["name"] == "ä"
    assert parse(text)[0].attributes["name"] == "ä"


@pytest.mark.parametrize(
    ("text", "reason", "span"),
    [
        ("<a><b></a>", "mismatched tag", "a.urdf:1:4"),
        ("<a name=b/>", "not well-formed", "a.urdf:1:9"),
        ("<a/><b/>", "junk after document element", "a.urdf:1:5"),
        ("", "no element found", "a.urdf:1:1"),
        ("<a>", "no element found", "a.urdf:1:1"),
        ("<a>&undefined;</a>", "undefined entity", "a.urdf:1:4"),
    ],
)
def test_malformed_text_is_one_error_with_its_place(text, reason, span):
    root, diagnostics = parse(text)
    assert root is None
    (found,) = diagnostics.by_code("xml.malformed")
    assert reason in found.message
    assert str(found.span) == span
    assert found.phrase == "XML parsing error"


@pytest.mark.parametrize(
    "declaration",
    ['<!ENTITY x "y">', '<!ENTITY x SYSTEM "file:///etc/passwd">', '<!ENTITY % x "y">'],
)
def test_entities_are_refused(declaration):
    root, diagnostics = parse(f"<!DOCTYPE a [\n{declaration}]><a/>")
    assert root is None
    (found,) = diagnostics.by_code("xml.entity")
    assert found.message == "entity 'x' is refused"
    assert found.span.line == 2


def test_a_missing_file_is_reported(tmp_path):
    diagnostics = Diagnostics()
    assert read_xml(tmp_path / "gone.urdf", diagnostics) is None
    (found,) = diagnostics.by_code("xml.unreadable")
    assert "No such file" in found.message
    assert found.phrase == "Unable to open file"


def test_a_file_is_read_under_its_path(tmp_path):
    path = tmp_path / "a.urdf"
    path.write_text("<a/>")
    assert read_xml(path, Diagnostics()).span.file == str(path)


@pytest.mark.parametrize(
    ("folder", "more_than"),
    [
        (TESTS.parent / "examples", 10),
        (TESTS / "workspaces", 12),
        *shared_cases((SHARED / "workspaces", 40)),
    ],
)
def test_every_file_of_a_workspace_parses(folder, more_than):
    diagnostics = Diagnostics()
    patterns = ("*.urdf", "*.sdf", "*.launch", "*.world", "*.xacro", "package.xml")
    files = [path for pattern in patterns for path in sorted(folder.rglob(pattern))]
    assert len(files) > more_than
    for path in files:
        assert read_xml(path, diagnostics) is not None
    assert not len(diagnostics)


@pytest.mark.parametrize(
    "comment", ["<!-- gz sim --levels w.sdf -->", "<!-- a --->", "<!----- line ----->"]
)
def test_dashes_in_a_comment_are_forgiven_as_by_gazebo(comment: str) -> None:
    root, diagnostics = parse(f"<a>\n{comment}\n  <b/></a>")
    assert str(root.find("b").span) == "a.urdf:3:3"
    (found,) = diagnostics
    assert (found.code, found.severity, found.span.line) == ("xml.lenient", Severity.INFO, 2)


def test_bare_ampersand_is_forgiven_as_by_gazebo() -> None:
    root, diagnostics = parse("<a t='x &amp; y'>Bed & Breakfast &#65;</a>")
    assert (root.text, root.attributes["t"]) == ("Bed & Breakfast A", "x & y")
    assert [item.code for item in diagnostics] == ["xml.lenient"]


def test_real_mistake_beside_a_dashed_comment_is_the_error() -> None:
    root, diagnostics = parse("<a>\n<!-- -- -->\n<b></a>")
    assert root is None
    (found,) = diagnostics
    assert (found.code, found.span.line) == ("xml.malformed", 3)


def test_licence_before_the_declaration_is_forgiven_as_by_gazebo() -> None:
    root, diagnostics = parse("<!--\n free -->\n<?xml version='1.0'?>\n<a><b/></a>")
    assert str(root.find("b").span) == "a.urdf:4:4"
    assert [item.code for item in diagnostics] == ["xml.lenient"]


def test_a_document_is_parsed_once_where_documents_are_remembered(tmp_path):
    file = tmp_path / "a.urdf"
    file.write_text("<a><!-- a -- b --><b/></a>")
    diagnostics = [Diagnostics(), Diagnostics()]
    with remembering_documents():
        first, second = (read_xml(file, found) for found in diagnostics)
        other = parse_xml(file.read_bytes(), "other", Diagnostics())
        file.write_text("<a/>")
        changed = read_xml(file, Diagnostics())
    assert first is second
    assert [[item.code for item in found] for found in diagnostics] == [["xml.lenient"]] * 2
    assert other.span.file == "other"
    assert changed.children == ()
    assert read_xml(file, Diagnostics()) is not read_xml(file, Diagnostics())


def test_errors_of_remembered_documents_are_told_each_time():
    found = [Diagnostics(), Diagnostics()]
    with remembering_documents():
        assert [parse_xml("<a>", "f", item) for item in found] == [None, None]
    assert [item.code for one in found for item in one] == ["xml.malformed"] * 2


def test_few_documents_are_remembered(monkeypatch):
    monkeypatch.setattr("gazelle.description.xml.reader._REMEMBERED_BYTES", 10)
    with remembering_documents():
        assert parse_xml("<a></a>", "f", Diagnostics()) is parse_xml("<a></a>", "f", Diagnostics())
        large = f"<a>{'x' * 20}</a>"
        assert parse_xml(large, "f", Diagnostics()).text == "x" * 20
        assert parse_xml(large, "f", Diagnostics()) is not parse_xml(large, "f", Diagnostics())
