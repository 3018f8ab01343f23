"""Errors that newcomers make in launch files are explained: what to write, at their own line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostic

ROOT = Path(__file__).parents[3]

_HEAD = """from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.substitutions import *
def generate_launch_description():
    return LaunchDescription([
        {}
    ])
"""
_LINE = 7
_NODE = "__import__('launch_ros.actions').actions.Node(package='rviz2', executable='rviz2', "

Include = Callable[..., tuple[int, list[Diagnostic], str]]


@pytest.mark.parametrize(
    ("source", "line", "code", "message", "fix"),
    [
        (
            "def generate_launch_description():\n    raise TypeError('Unexpected key of mine')",
            2,
            "ros2_launch.exception",
            "TypeError: Unexpected key of mine",
            "mend it at the place",
        ),
        (
            "import os\nMODEL = os.environ['GZ_NOT_SET']",
            2,
            "ros2_launch.exception",
            "environment variable GZ_NOT_SET is not set",
            "export GZ_NOT_SET=",
        ),
        (
            "def generate_launch_description():\n    return LaunchDescription([])",
            2,
            "ros2_launch.exception",
            "name 'LaunchDescription' is not",
            "from launch import LaunchDesc",
        ),
        (
            "speed = 1\nprint(sped)",
            2,
            "ros2_launch.exception",
            "NameError: name 'sped' is not defined",
            "did you mean 'speed' or",
        ),
        (
            "import launch_ros.actions\nfrom launch.actions import Node",
            2,
            "ros2_launch.import",
            "cannot import name 'Node' from 'launch.actions'",
            "from launch_ros.actions ",
        ),
        (
            "from launch.actions import ExecuteProces",
            1,
            "ros2_launch.import",
            "name 'ExecuteProces' from 'launch.actions'",
            "did you mean 'ExecuteProcess'",
        ),
        (
            "from launch.action import LogInfos",
            1,
            "ros2_launch.import",
            "cannot import name 'LogInfos' from 'launch.action'",
            "correct the name",
        ),
        (
            "import launch_rso",
            1,
            "ros2_launch.import",
            "No module named 'launch_rso'",
            "did you mean 'launch_ros'",
        ),
        (
            "import launch.actionz",
            1,
            "ros2_launch.import",
            "'launch.actionz'",
            "or 'launch.actions'",
        ),
        (
            "import my_robot_utils",
            1,
            "ros2_launch.import",
            "No module named 'my_robot",
            "into the workspace's src",
        ),
        (
            "import qqxyzzy",
            1,
            "ros2_launch.import",
            "No module named 'qqxyzzy'",
            "pip install qqxyzzy",
        ),
        (
            "import realsense2_camera",
            1,
            "ros2_launch.import",
            "No module",
            "the driver of a real camera",
        ),
        (
            "from ament_index_python import get_package_prefix\nget_package_prefix('robot_x')",
            2,
            "ros2_launch.package-missing",
            "package 'robot_x' not found",
            "correct the name, or put",
        ),
        (
            "from ament_index_python import get_package_prefix\nget_package_prefix('rplidar_ros')",
            2,
            "ros2_launch.package-missing",
            "package 'rplidar_ros' not found",
            "driver of a real laser scanner",
        ),
        (
            "def generate_launch_descripton(): pass",
            0,
            "ros2_launch.bad-file",
            "required function",
            "write it, or",
        ),
        (
            "def generate_launch_description(): pass",
            1,
            "ros2_launch.bad-file",
            "a return missing?",
            "end it with",
        ),
        (
            "\ndef generate_launch_description(c): 0",
            2,
            "ros2_launch.bad-file",
            "missing 1 required",
            "OpaqueFunct",
        ),
        (
            "if True:\nx = 1",
            2,
            "ros2_launch.bad-file",
            "IndentationError: expected an indented",
            "mend it at",
        ),
    ],
)
def test_what_newcomers_get_wrong_in_python_is_explained(
    source: str, line: int, code: str, message: str, fix: str, include: Include
) -> None:
    exit_code, found, _text = include("faulty.launch.py", source + "\n")
    (diagnostic,) = found
    assert (exit_code, diagnostic.code) == (1, code)
    assert message in diagnostic.message
    assert fix in diagnostic.fix
    assert diagnostic.span is not None
    assert (Path(diagnostic.span.file).name, diagnostic.span.line) == ("faulty.launch.py", line)
    # The folder of this clone may have the name.
    assert "gazelle" not in diagnostic.message.replace(str(ROOT), "")


@pytest.mark.parametrize(
    ("entity", "code", "message", "fix"),
    [
        (
            "LogInfo(msg=PythonExpression(['1 + ', 'abc']))",
            "ros2_launch.exception",
            "name 'abc' is not defined, in the expression: 1 + abc",
            "put quotes around",
        ),
        (
            "LogInfo(msg=PythonExpression('1 +'))",
            "ros2_launch.exception",
            "SyntaxError: invalid syntax",
            "mend it",
        ),
        (
            "LogInfo(msg=LaunchConfiguration('robot'))",
            "ros2_launch.substitution",
            "'robot' does not exist",
            "DeclareLaunchArgument('robot', default",
        ),
        (
            "LogInfo(msg=EnvironmentVariable('GZ_NOT_SET'))",
            "ros2_launch.substitution",
            "'GZ_NOT_SET' does not exist",
            "export GZ_NOT_SET=… in the shell",
        ),
        (
            "LogInfo(msg=Command(['sh', '/nowhere']))",
            "ros2_launch.substitution",
            "file not found: ",
            "write 'sh ', with a blank behind it",
        ),
        (
            "LogInfo(msg=Command('ls /nowhere'))",
            "ros2_launch.substitution",
            "the command failed with exit code 2: ls /nowhere: ls: ",
            "run it by hand",
        ),
        (
            "LogInfo(msg=Command('ls -d / /nowhere', on_stderr='capture'))",
            "ros2_launch.substitution",
            "the command failed with exit code 2: ls",
            "run it by hand: ls -d",
        ),
        (
            _NODE + "namespace='my robot')",
            "ros2_launch.bad-name",
            "'my_robot' would do",
            "correct the name",
        ),
        (
            _NODE + "parameters=[{'text': TextSubstitution(text='[a: ')}])",
            "ros2_launch.parameter-value",
            "Unable to parse the value of parameter text as yaml.",
            "ParameterValue(…, value_type=str)",
        ),
    ],
)
def test_substitutions_say_what_to_write(
    entity: str, code: str, message: str, fix: str, include: Include, monkeypatch: Any
) -> None:
    monkeypatch.delenv("GZ_NOT_SET", raising=False)
    exit_code, found, _text = include("faulty.launch.py", _HEAD.format(entity))
    (diagnostic,) = found
    assert (exit_code, diagnostic.code) == (1, code)
    assert message in diagnostic.message
    assert fix in diagnostic.fix
    assert diagnostic.span is not None
    assert diagnostic.span.line == _LINE


def test_an_error_of_xacro_names_the_xacro_file(include: Include, tmp_path: Path) -> None:
    space = "xmlns:xacro='http://www.ros.org/wiki/xacro'"
    (tmp_path / "a.xacro").write_text(f"<robot name='r' {space}>\n<link name='${{nope}}'/></robot>")
    entity = f"LogInfo(msg=xacro.process_file({str(tmp_path / 'a.xacro')!r}).toxml())"
    _code, found, _text = include("faulty.launch.py", _HEAD.format(entity) + "\nimport xacro\n")
    (diagnostic,) = found
    assert "name 'nope' is not defined" in diagnostic.message
    assert f"in '{tmp_path}/a.xacro'" in diagnostic.message
    assert diagnostic.fix == f"`xacro {tmp_path}/a.xacro` shows the place"


def test_an_error_in_an_included_file_is_shown_there(include: Include, tmp_path: Path) -> None:
    inner = "def generate_launch_description():\n    return {}['arm']\n"
    (tmp_path / "inner.launch.py").write_text(inner)
    (tmp_path / "wants.launch.py").write_text(_HEAD.format("DeclareLaunchArgument('robot_name')"))
    entity = "IncludeLaunchDescription([ThisLaunchFileDir(), '/inner.launch.py'])"
    _code, found, _text = include("outer.launch.py", _HEAD.format(entity))
    (diagnostic,) = found
    assert diagnostic.span is not None
    assert (Path(diagnostic.span.file).name, diagnostic.span.line) == ("inner.launch.py", 2)
    given = "launch_arguments={'robotname': 'x'}.items()"
    entity = f"IncludeLaunchDescription(ThisLaunchFileDir(), {given})".replace(
        "ThisLaunchFileDir()", f"{str(tmp_path / 'wants.launch.py')!r}"
    )
    _code, found, _text = include("outer.launch.py", _HEAD.format(entity))
    (diagnostic,) = found
    assert "required argument 'robot_name'" in diagnostic.message
    assert "given: [robotname]; did you mean 'robotname'?" in diagnostic.message
    assert diagnostic.span is not None
    assert (Path(diagnostic.span.file).name, diagnostic.span.line) == ("outer.launch.py", _LINE)
