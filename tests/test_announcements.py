"""What is said once in a process, and to whom."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from gazelle import announcements
from gazelle.announcements import announce, announce_by, announced_by


@pytest.fixture(autouse=True)
def nothing_said(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(announcements, "_process", [])
    yield


def test_a_text_is_said_once_on_the_standard_error(capsys: pytest.CaptureFixture[str]) -> None:
    announce("compiling")
    announce("compiling")
    assert capsys.readouterr().err == "gazelle: compiling\n"


def test_texts_of_one_key_are_one(capsys: pytest.CaptureFixture[str]) -> None:
    announce("the disk is full", key="disk")
    announce("the disk is still full", key="disk")
    assert capsys.readouterr().err == "gazelle: the disk is full\n"


def test_a_node_says_it_in_its_log_and_a_block_where_it_wants() -> None:
    log: list[str] = []
    own: list[str] = []
    announce_by(log.append)
    with announced_by(own.append):
        announce("a")
    announce("b")
    assert (own, log) == (["a"], ["b"])


def test_nobody_ends_since_nobody_could_be_told() -> None:
    def closed(text: str) -> None:
        raise RuntimeError(text)

    announce_by(closed)
    announce("a")
