"""What the XML reader refuses for its size."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

import pytest

from gazelle.description.xml import parse_xml, read_xml
from gazelle.diagnostics import Diagnostics


def _errors(text: str | bytes) -> list[str]:
    diagnostics = Diagnostics()
    assert parse_xml(text, "f.urdf", diagnostics) is None
    return [str(item).partition("\n")[0] for item in diagnostics]


def test_million_links_are_refused_at_once() -> None:
    text = "<robot>" + '<link name="a"/>' * 1_000_000 + "</robot>"
    start = time.thread_time()
    assert _errors(text) == [
        "f.urdf: error: the document has 1000001 elements, the limit is 500000 [limits.elements]"
    ]
    assert time.thread_time() - start < 10.0


def test_limit_is_raised_by_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.description.xml.reader._MAX_ELEMENTS", 10)
    text = "<robot>" + "<link/>" * 20 + "</robot>"
    assert _errors(text)
    monkeypatch.setenv("GAZELLE_LIMITS", "2.1")
    root = parse_xml(text, "f.urdf", Diagnostics())
    assert root is not None
    assert len(root.children) == 20


def test_elements_in_utf_16_are_counted_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gazelle.description.xml.reader._MAX_ELEMENTS", 10)
    text = ("<robot>" + "<link/>" * 20 + "</robot>").encode("utf-16")
    assert "f.urdf:1:72: error: the document has more than 10 elements" in _errors(text)[0]


def test_nesting_has_a_limit() -> None:
    for depth in (101, 400_000):
        assert _errors("<a>" * depth) == [
            "f.urdf:1:301: error: <a> is nested deeper than 100 elements [limits.elements]"
        ]
    assert parse_xml("<a>" * 100 + "</a>" * 100, "f", Diagnostics()) is not None


def test_attributes_have_a_limit() -> None:
    many = " ".join(f'a{number}=""' for number in range(100_000))
    assert "<robot> has 100000 attributes, the limit is 1000 [" in _errors(f"<robot {many}/>")[0]


def test_open_comments_without_end_take_no_time() -> None:
    start = time.thread_time()
    assert "[xml.malformed]" in _errors("<a>" + "<!-- " * 200_000)[0]
    assert "[xml.malformed]" in _errors("<a>" + " <?xml x" * 200_000)[0]
    assert time.thread_time() - start < 10.0


@pytest.mark.parametrize(
    ("data", "text"),
    [
        ("<a>\ud800</a>", "not well-formed (invalid token)"),
        (b'<?xml version="1.0" encoding="utf-7"?><a/>', "multi-byte encodings are not supported"),
        (b'<?xml version="1.0" encoding="klingon"?><a/>', "unknown encoding: klingon"),
        ('<a b="\x00"/>', "not well-formed (invalid token)"),
    ],
)
def test_texts_that_are_no_characters_are_malformed(data: str | bytes, text: str) -> None:
    assert text in _errors(data)[0]
    assert "[xml.malformed]" in _errors(data)[0]


@pytest.mark.skipif(os.name == "nt", reason="devices and pipes are files elsewhere")
def test_devices_and_pipes_are_no_trap(tmp_path: Path) -> None:
    diagnostics = Diagnostics()
    assert read_xml(Path("/dev/zero"), diagnostics) is None
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    assert read_xml(pipe, diagnostics) is None
    assert [str(item).partition("\n")[0] for item in diagnostics] == [
        "/dev/zero: error: '/dev/zero' is not read: it is a device, not a file [limits.file-size]",
        f"{pipe}:1:1: error: not well-formed XML: no element found [xml.malformed]",
    ]


@pytest.mark.skipif(os.name == "nt", reason="there are no pipes in folders")
def test_pipe_of_a_shell_is_read_to_its_end(tmp_path: Path) -> None:
    reading, writing = os.pipe()

    def write() -> None:
        for part in (b"<robot ", b"name='r'", b"/>"):
            os.write(writing, part)
        os.close(writing)

    writer = threading.Thread(target=write)
    writer.start()
    root = read_xml(Path(f"/dev/fd/{reading}"), Diagnostics())
    writer.join()
    os.close(reading)
    assert root is not None
    assert root.attributes == {"name": "r"}


def test_enormous_file_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "a.urdf"
    with path.open("wb") as stream:
        stream.truncate(100 << 20)
    diagnostics = Diagnostics()
    assert read_xml(path, diagnostics) is None
    (found,) = diagnostics
    assert found.code == "limits.file-size"
    assert "it has 104857600 bytes, the limit is 64 MiB" in found.message
    assert "GAZELLE_LIMITS=10" in found.fix
