"""Words of a command line that are far too long, too deep or wrong in a place far away."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.cli import dynparam
from gazelle.cli.error_text import error_text
from gazelle.graph import Node
from gazelle.graph.ros2_node_parameters import NodeParameters
from gazelle.interfaces import ros1_service_type, service_type

_DEPTH = "lists and mappings are nested deeper than 64"
_LONG = "x" * 100_000
# One word may have 128 kB on Linux; what has more comes from files and standard input.
_DEEP = [letter * 100_000 for letter in "[{"]
_TOOLS = [
    ("rostopic", "pub", "-1", "/a", "std_msgs/String"),
    ("rosservice", "call", "/ros1"),
    ("rosparam", "set", "/a"),
    ("ros2", "topic", "pub", "-1", "-w", "0", "/a", "std_msgs/msg/String"),
    ("ros2", "service", "call", "/ros2", "std_srvs/srv/SetBool"),
    ("ros2", "param", "set", "/robot", "p"),
    ("ros2", "action", "send_goal", "/act", "example_interfaces/action/Fibonacci"),
]
_ids = " ".join


@pytest.fixture(autouse=True)
def _servers(robot: Node) -> None:
    robot.create_service("/ros1", ros1_service_type("std_srvs/SetBool"), print)
    robot.create_service("/ros2", service_type("std_srvs/srv/SetBool"), print)
    NodeParameters(robot, "/robot", {"p": 1})


@pytest.mark.parametrize("word", _DEEP, ids="[{")
@pytest.mark.parametrize("words", _TOOLS, ids=_ids)
def test_a_word_of_brackets_only_is_one_short_error(
    run: Any, words: tuple[str, ...], word: str
) -> None:
    found = run(*words, word)
    assert found.code == 1
    assert found.out == ""
    assert found.err.count(_DEPTH) == 1
    assert "Traceback" not in found.err
    assert len(found.err) < 2000


@pytest.mark.parametrize("words", [words for words in _TOOLS if "set" not in words], ids=_ids)
def test_a_long_name_of_no_field_is_not_told_whole(run: Any, words: tuple[str, ...]) -> None:
    found = run(*words, f"{{? {_LONG} : 1}}")
    assert found.code == 1
    assert "has no field 'xxxxx" in found.err
    assert "characters) … xxx" in found.err
    assert len(found.err) < 2000


@pytest.mark.parametrize("text", _DEEP, ids="[{")
@pytest.mark.usefixtures("graph")
def test_files_of_brackets_only_are_one_short_error(
    run: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str
) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(text, encoding="utf-8")
    found = run("rosparam", "load", str(path))
    assert (found.code, found.err.count(_DEPTH)) == (1, 1)
    assert len(found.err) < 2000
    assert dynparam.main(["load", "/robot", str(path)]) == 1
    shown = capsys.readouterr()
    assert shown.err.startswith(f"ERROR: '{path}' is not a YAML dictionary of parameters: {_DEPTH}")
    assert len(shown.err) < 2000
    assert dynparam.main(["set", "/robot", text]) == 1
    shown = capsys.readouterr()
    assert shown.err.startswith(f"ERROR: Argument error: {_DEPTH}")
    assert len(shown.err) < 2000


@pytest.mark.usefixtures("graph")
def test_a_file_of_one_long_text_is_not_told_whole(
    run: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "p.yaml"
    path.write_text("x" * 400_000, encoding="utf-8")
    found = run("rosparam", "load", str(path))
    assert found.code == 1
    assert found.err.startswith(f"ERROR: [{path}] must hold 'name: value' pairs, it holds 'xxx")
    assert len(found.err) < 2000
    assert dynparam.main(["load", "/robot", str(path)]) == 1
    shown = capsys.readouterr()
    assert shown.err.startswith(f"ERROR: '{path}' is not a YAML dictionary of parameters: ")
    assert len(shown.err) < 2000


@pytest.mark.usefixtures("graph")
def test_a_file_without_end_is_no_parameters(capsys: pytest.CaptureFixture[str]) -> None:
    assert dynparam.main(["load", "/robot", "/dev/zero"]) == 1
    assert capsys.readouterr().err == (
        "ERROR: cannot read '/dev/zero': it is a device, not a file\n"
    )


@pytest.mark.parametrize("words", [("load",), ("set", "-t")], ids=_ids)
@pytest.mark.usefixtures("graph")
def test_files_that_are_no_text_or_too_large_are_no_parameters(
    run: Any, tmp_path: Path, words: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "p.yaml"
    path.write_bytes(b"a: \xff")
    name = ["/a"] if words[0] == "set" else []
    found = run("rosparam", *words, str(path), *name)
    assert found == (1, "", f"ERROR: cannot read [{path}]: it is not UTF-8 text\n")
    monkeypatch.setenv("GAZELLE_LIMITS", "0.015625")
    with path.open("wb") as file:
        file.truncate((1 << 20) + 1)
    assert run("rosparam", *words, str(path), *name) == (
        1,
        "",
        f"ERROR: cannot read [{path}]: it has 1048577 bytes, the limit is 1 MiB (if the file "
        "means it, set the environment variable GAZELLE_LIMITS=10 for ten times)\n",
    )


def test_an_error_keeps_its_lines_and_both_ends_of_the_long_ones() -> None:
    assert error_text("one\n  two") == "one\n  two"
    assert error_text("a" * 1000) == "a" * 1000
    shown = error_text(f"field '{'x' * 400_000}' does not exist\n  did you mean 'data'?")
    first, second = shown.split("\n")
    assert first.startswith("field 'xxx")
    assert " … (399523 characters) … " in first
    assert first.endswith("xxx' does not exist")
    assert len(first) < 1000
    assert second == "  did you mean 'data'?"
