from __future__ import annotations

import errno
import io
import os
import sys

import pytest

from gazelle.graph.console import Level, LogRecord, format_record, level_of, print_record
from gazelle.log_files import GAPS

RECORD = LogRecord(Level.INFO, "hello", "/ns/talker", 12_000_000_345, None, "", "a.py", "main", 7)


def test_layouts_of_roscpp_and_rospy() -> None:
    assert format_record(RECORD, environ={}) == "[ INFO] [12.000000345]: hello"
    assert format_record(RECORD, padded=False, environ={}) == "[INFO] [12.000000]: hello"


def test_simulated_time_stands_beside_wall_time() -> None:
    record = LogRecord(Level.WARN, "x", "/n", 12_500_000_000, 3_250_000_000)
    assert format_record(record, environ={}) == "[ WARN] [12.500000000, 3.250000000]: x"


def test_rosconsole_format_is_followed() -> None:
    pattern = "${severity}|${message}|${node}|${file}:${line}|${function}|${walltime}|${bad}"
    line = format_record(RECORD, padded=False, environ={"ROSCONSOLE_FORMAT": pattern})
    assert line == "INFO|hello|/ns/talker|a.py:7|main|12.000000|${bad}"
    year = format_record(RECORD, environ={"ROSCONSOLE_FORMAT": "${time:%Y}"})
    assert year == "1970"


@pytest.mark.parametrize(("word", "level"), [("warning", 4), ("WARN", 4), (8, 8), ("fatal", 16)])
def test_levels_have_words_and_numbers(word: str | int, level: int) -> None:
    assert level_of(word) == level


def test_warnings_go_to_stderr_the_rest_to_stdout(capsys: pytest.CaptureFixture[str]) -> None:
    print_record(RECORD)
    print_record(LogRecord(Level.ERROR, "bad", "/n", 0))
    out, err = capsys.readouterr()
    assert out == "[ INFO] [12.000000345]: hello\n"
    assert err == "[ERROR] [0.000000000]: bad\n"


def test_terminals_get_colours(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    print_record(LogRecord(Level.WARN, "careful", "/n", 0))
    assert capsys.readouterr().err == "\033[33m[ WARN] [0.000000000]: careful\033[0m\n"


def test_a_full_disk_ends_nobody_who_writes_to_a_file(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Full(io.StringIO):
        def flush(self) -> None:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    GAPS.reset()
    monkeypatch.setattr(sys, "stdout", Full())
    for _ in range(2):
        print_record(LogRecord(Level.INFO, "here", "/node", wall_ns=0))
    assert capsys.readouterr().err == (
        "warning: standard output: No space left on device; "
        "what cannot be written is missing there\n"
    )
