"""Nothing that is printed is lost to a test that looks again and again."""

from __future__ import annotations

import os
import sys
import threading
from typing import Any

import pytest

_LINES = 3_000


@pytest.mark.parametrize("fixture", ["capfd", "capsys"])
def test_looking_while_others_print_loses_nothing(
    request: pytest.FixtureRequest, fixture: str
) -> None:
    capture: Any = request.getfixturevalue(fixture)

    def write() -> None:
        for number in range(_LINES):
            print(f"über {number}", file=sys.stderr, flush=True)

    thread = threading.Thread(target=write)
    thread.start()
    seen: list[str] = []
    while thread.is_alive():
        seen.append(capture.readouterr().err)
    seen.append(capture.readouterr().err)
    assert "".join(seen).splitlines() == [f"über {number}" for number in range(_LINES)]


def test_each_look_gives_what_is_new_of_both(capfd: pytest.CaptureFixture[str]) -> None:
    os.write(1, "a ü".encode()[:-1])
    assert capfd.readouterr() == ("a ", "")
    os.write(1, "ü".encode()[1:])
    os.write(2, b"b\r\n")
    assert capfd.readouterr() == ("ü", "b\r\n")
    assert capfd.readouterr() == ("", "")


@pytest.fixture
def printed_before(capfd: pytest.CaptureFixture[str]) -> None:
    print("read", flush=True)
    assert capfd.readouterr().out == "read\n"
    print("left", flush=True)


def test_what_a_fixture_printed_is_seen_once(
    printed_before: None, capfd: pytest.CaptureFixture[str]
) -> None:
    print("now", flush=True)
    assert capfd.readouterr().out == "left\nnow\n"
