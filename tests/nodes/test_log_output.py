"""Logs of built-in nodes: everything in files, the terminal as the launch says."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.graph import Level
from gazelle.graph.console import LogRecord
from gazelle.graph.log_output import LogFile, keep_log, print_ros2
from gazelle.interfaces import ros1_message_type
from gazelle.nodes.rosout import line_of


def _record(level: Level, text: str) -> LogRecord:
    return LogRecord(level, text, "/node", 1_500_000_000, 250_000_000)


def test_file_gets_everything_and_the_terminal_what_is_grave_enough(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "run" / "node-2.log"
    log = LogFile(path, terminal=Level.WARN)
    log(_record(Level.INFO, "hello"))
    log(_record(Level.WARN, "look"))
    log.close()
    log(_record(Level.ERROR, "too late"))
    assert path.read_text(encoding="utf-8").splitlines() == [
        "[ INFO] [1.500000000, 0.250000000]: hello",
        "[ WARN] [1.500000000, 0.250000000]: look",
    ]
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.splitlines() == [
        "[ WARN] [1.500000000, 0.250000000]: look",
        "[ERROR] [1.500000000, 0.250000000]: too late",
    ]


def test_rosout_lines_have_ros_1s_layout() -> None:
    message = ros1_message_type("rosgraph_msgs/Log")(
        level=4, name="/talker", msg="careful", file="talker.py", function="main", line=12,
        topics=["/rosout", "/chatter"],
    )  # fmt: skip
    message.header.stamp.secs, message.header.stamp.nsecs = 7, 5_000_000
    assert line_of(message) == (
        "7.005000000 WARN /talker [talker.py:12(main)] [topics: /rosout, /chatter] careful"
    )


def test_rosout_line_of_a_long_message_is_cut_and_says_how_long_it_was() -> None:
    message = ros1_message_type("rosgraph_msgs/Log")(level=2, name="/a", msg="x" * 2_000_000)
    line = line_of(message)
    assert len(line) < 1_100_000
    assert line.endswith("xxx… (2000000 characters in all)")


def test_a_file_keeps_the_style_of_the_terminal(
    bench, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bench.node.console = print_ros2
    keep_log(bench.node, str(tmp_path / "node.log"))
    bench.node.log("info", "hello")
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("[INFO] [")
    assert printed.err.endswith("] [test]: hello\n")
    assert "hello" in (tmp_path / "node.log").read_text()
