"""The front of ros2, and the commands that only answer."""

from __future__ import annotations

from typing import Any

import pytest


def test_help_lists_the_commands_in_the_layout_of_ros2cli(run: Any) -> None:
    code, text, _ = run("ros2", "-h")
    assert code == 0
    assert text.startswith(
        "usage: ros2 [-h] [--use-python-default-buffering]\n"
        "            Call `ros2 <command> -h` for more detailed usage. ...\n\n"
        "ros2 is an extensible command-line tool for ROS 2.\n"
    )
    assert "  topic      Various topic related sub-commands\n" in text
    assert text.endswith("  Call `ros2 <command> -h` for more detailed usage.\n")
    assert run("ros2").out == text


def test_unknown_commands_and_verbs_are_told_with_the_nearest(run: Any) -> None:
    code, _, error = run("ros2", "topci")
    assert code == 2
    assert "invalid choice: 'topci' (did you mean 'topic'?)" in error
    code, _, error = run("ros2", "topic", "lst")
    assert code == 2
    assert error.startswith("ros2 topic: no command 'lst'; did you mean 'list'?\n")
    assert "invalid choice: 'lst'" in error
    assert "Package 'pkg' not found" in run("ros2", "launch", "pkg", "a.launch.py").err


def test_command_without_a_verb_prints_its_help(run: Any) -> None:
    code, text, _ = run("ros2", "--use-python-default-buffering", "topic")
    assert code == 0
    assert "Commands:\n  bw     Display bandwidth used by topic\n" in text


@pytest.mark.parametrize(
    ("verb", "text"),
    [
        ("start", "The daemon is already running\n"),
        ("status", "The daemon is not running\n"),
        ("stop", "The daemon is not running\n"),
    ],
)
def test_daemon_answers_that_none_is_needed(run: Any, verb: str, text: str) -> None:
    code, out, error = run("ros2", "daemon", verb)
    assert (code, out) == (0, text)
    assert "Gazelle needs no daemon" in error


@pytest.mark.parametrize("verb", ["receive", "send"])
def test_multicast_answers_that_it_is_not_used(run: Any, verb: str) -> None:
    code, out, error = run("ros2", "multicast", verb)
    assert (code, out) == (0, "")
    assert "find each other by its own sockets" in error
