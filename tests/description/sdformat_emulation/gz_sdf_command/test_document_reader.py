"""Documents that real programs cannot be asked about."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.sdformat_emulation import Release, SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command import normalised, read_document, to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.checks import check
from gazelle.description.sdformat_emulation.gz_sdf_command.document_reader import read_document_file
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics


def test_made_elements_are_completed() -> None:
    joint = SdfElement("joint", {"name": "j", "type": "ball"})
    joint.add("parent", "world")
    parts = [SdfElement("link", {"name": "a"}), joint]
    model = SdfElement("model", {"name": "m"}, children=parts)
    root = SdfElement("sdf", {"version": "1.9"}, children=[model])
    found = normalised(root, Release.V12)
    assert found is not None
    joint = found.children[0].children[1]
    assert [child.name for child in joint.children] == ["parent", "child"]
    assert joint.children[1].text == "__default__"


@pytest.mark.parametrize("release", list(Release))
def test_printed_text_is_read_back_unchanged(release: Release) -> None:
    text = (
        "<sdf version='1.7'><model name='a &amp; b'><link name=\"it's\"/>"
        "<plugin name='p' filename='f'><x>1 &lt; 2</x></plugin></model></sdf>"
    )
    first = read_document(text, release=release, file="<text>", find=lambda _uri: None)
    assert first.root is not None
    printed = to_text(first.root, release)
    assert parse_xml(printed, "printed", Diagnostics()) is not None
    again = read_document(printed, release=release, file="<text>", find=lambda _uri: None)
    assert again.root is not None
    assert to_text(again.root, release) == printed


def test_files_that_include_each_other_are_told(tmp_path: Path) -> None:
    file = tmp_path / "m.sdf"
    file.write_text(
        "<sdf version='1.9'><model name='m'><link name='l'/><include><uri>m.sdf</uri></include>"
        "</model></sdf>",
        encoding="utf-8",
    )
    document = read_document_file(str(file), release=Release.V12, find=lambda _uri: file)
    assert "files include each other in a circle" in "".join(document.console.lines)
    assert document.errors[0].message == f"Unable to read file[{file}]"


_MODEL = '<sdf version="1.6">{}<model name="m"><link name="l"/></model></sdf>'


@pytest.mark.parametrize(
    ("text", "line", "value"),
    [
        ('<!-- c -->\n<?xml version="1.0" ?>\n' + _MODEL.format(""), 2, 'xml version="1.0" '),
        (_MODEL.format('<?xml version="1.0"?>'), 1, 'xml version="1.0"'),
        ('<?xml version="1.0"?>\n' + _MODEL.format("<?foo bar?>"), 2, "foo bar"),
    ],
)
def test_late_declaration_ends_sdformat_12_and_not_9(text: str, line: int, value: str) -> None:
    """As ign sdf 12.3 and gz sdf 9.10 do."""
    document = read_document(text, release=Release.V12, file="f", find=lambda _uri: None)
    assert document.root is None
    printed = "".join(document.console.lines)
    assert f"ErrorID=11 (0xb) Line number={line}: XMLDeclaration value={value}" in printed
    old = read_document(text, release=Release.V9, file="f", find=lambda _uri: None)
    assert old.root is not None


def test_declarations_may_be_named_in_comments() -> None:
    text = '<?xml version="1.0"?><?a b?><!-- <?xml?> -->' + _MODEL.format("<!-- <?b?> -->")
    document = read_document(text, release=Release.V12, file="f", find=lambda _uri: None)
    assert document.root is not None


def test_errors_have_numbers() -> None:
    text = "<sdf version='1.9'><model name='m'/></sdf>"
    document = read_document(text, release=Release.V12, file="<text>", find=lambda _uri: None)
    assert [error.code for error in check(document)][:1] == [16]
