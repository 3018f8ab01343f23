"""Loops launch their entities once a round, and lines have levels."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.ros2 import LaunchDescription
from gazelle.launch.ros2.actions import (
    ForEach,
    ForLoop,
    IncludeLaunchDescription,
    Log,
    LogError,
    LogInfo,
    LogWarning,
)
from gazelle.launch.ros2.frontend import Parser
from gazelle.launch.ros2.launch_description_sources import AnyLaunchDescriptionSource

_XML = """<launch>
  <arg name="robots" default="{name: a, id: 1};{name: b}"/>
  <for_each values="$(var robots)">
    <log_info message="robot $(for-var name) $(for-var id 9)"/>
  </for_each>
  <for len="2" name="i"><for len="2" name="j"><log message="$(index i)$(index j)"/></for></for>
  <log level="warning" message="careful"/>
</launch>
"""
_YAML = """launch:
- for_each:
    values: "{name: a}"
    children:
    - log_error: {message: "is $(for-var name)"}
"""


def _lines(ran: Any) -> list[str]:
    return [line.split("[launch.user]: ")[1] for line in ran.lines if "[launch.user]: " in line]


def test_loops_of_xml_have_their_values(run: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "loops.launch.xml"
    file.write_text(_XML, encoding="utf-8")
    ran = run(LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(str(file)))]))
    assert ran.code == 0, ran.text
    assert _lines(ran) == ["robot a 1", "robot b 9", "00", "01", "10", "11", "careful"]
    assert "[WARNING] [launch.user]: careful" in ran.text


def test_loops_of_yaml_have_their_values(run: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "loops.launch.yaml"
    file.write_text(_YAML, encoding="utf-8")
    ran = run(LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(str(file)))]))
    assert "[ERROR] [launch.user]: is a" in ran.text


def test_loops_of_python_call_their_function(run: Callable[..., Any]) -> None:
    each = ForEach("{a: 1};{a: 2, b: x}", function=lambda a, b="": [LogInfo(msg=f"{a}{b}")])
    ran = run(LaunchDescription([each, ForLoop("2", function=lambda i: [LogWarning(msg=f"i{i}")])]))
    assert _lines(ran) == ["1", "2x", "i0", "i1"]


def test_values_that_are_no_sets_are_told(run: Callable[..., Any]) -> None:
    ran = run(LaunchDescription([ForEach("{a: 1};b", function=lambda a: [])]))
    assert ran.code == 1
    nothing = run(LaunchDescription([ForEach("", function=lambda: [LogError(msg="x")])]))
    assert "no input values: will not iterate" in nothing.text and _lines(nothing) == []


def test_levels_that_do_not_exist_are_told(run: Callable[..., Any]) -> None:
    with pytest.raises(TypeError):
        Log(msg="x")  # type: ignore[call-arg]
    assert run(LaunchDescription([Log(msg="x", level="loud")])).code == 1


@pytest.mark.parametrize(
    ("tag", "kind"),
    [
        ('<log message="x"/>', LogInfo),
        ('<log level="warning" message="x"/>', Log),
        ('<log_error message="x"/>', LogError),
    ],
)
def test_lines_of_xml_become_the_action_of_their_level(tag: str, kind: type[Log]) -> None:
    root, parser = Parser.load(io.StringIO(f"<launch>{tag}</launch>"))
    (made,) = parser.parse_description(root).entities
    assert type(made) is kind
