"""What is wrong with a launch file is told with the user's line and the words of ROS 2."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostic, SourceSpan
from gazelle.launch.ros2 import LaunchDescription, LaunchService
from gazelle.launch.ros2.actions import IncludeLaunchDescription
from gazelle.launch.ros2.error_diagnostics import diagnose, with_diagnostic

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
_CAUGHT = "Caught exception in launch (see debug for traceback): "

Include = Callable[..., tuple[int, list[Diagnostic], str]]


@pytest.mark.parametrize(
    ("entity", "code", "message"),
    [
        ("nope", "ros2_launch.exception", "NameError: name 'nope' is not defined"),
        (
            "LogInfo(message='x')",
            "ros2_launch.exception",
            "TypeError: .*required keyword-only argument: 'msg'",
        ),
        (
            "DeclareLaunchArgument('speed', description='how fast')",
            "ros2_launch.argument-missing",
            "Included launch description missing required argument 'speed' "
            r"\(description: 'how fast'\), given: \[\]",
        ),
        (
            "DeclareLaunchArgument('x', default_value=['fa', 'st'], choices=['slow', 'quick'])",
            "ros2_launch.argument-choice",
            'Argument "x" provided value "fast" is not valid. Valid options are: ',
        ),
        (
            "LogInfo(msg=LaunchConfiguration('speed'))",
            "ros2_launch.substitution",
            "launch configuration 'speed' does not exist",
        ),
        (
            "LogInfo(msg='', condition=IfCondition('maybe'))",
            "ros2_launch.bad-condition",
            r"expected one of \[true, 1, false, 0\] but got 'maybe'",
        ),
        (
            "OpaqueFunction(function=lambda context: 1 / 0)",
            "ros2_launch.exception",
            "ZeroDivisionError: division by zero",
        ),
        (
            "OpaqueFunction(function=lambda context: LogInfo(msg='x'))",
            "ros2_launch.exception",
            "the function of OpaqueFunction returned a LogInfo; it has to return a list",
        ),
        (
            "IncludeLaunchDescription(ThisLaunchFileDir(), launch_arguments={'a': 'b'})",
            "ros2_launch.exception",
            r"has to be pairs of names and values: write \{…\}.items\(\)",
        ),
        (
            "SetLaunchConfiguration('sim', True)",
            "ros2_launch.exception",
            "when only 'str' or 'launch.Substitution' were expected. Write 'true'",
        ),
        (
            "IncludeLaunchDescription([ThisLaunchFileDir(), '/faulty.lanch.py'])",
            "ros2_launch.file-missing",
            r"No such file or directory: .*faulty.lanch.py'; did you mean 'faulty.launch.py'",
        ),
        (
            "IncludeLaunchDescription([ThisLaunchFileDir(), '/gone/a.launch.py'])",
            "ros2_launch.file-missing",
            "gone' is no folder, '.*' is",
        ),
    ],
)
def test_python_errors_show_the_users_line(
    entity: str, code: str, message: str, include: Include
) -> None:
    exit_code, found, text = include("faulty.launch.py", _HEAD.format(entity))
    (diagnostic,) = found
    assert exit_code == 1
    assert diagnostic.code == code
    assert re.search(message, diagnostic.message)
    assert diagnostic.span is not None
    included = code == "ros2_launch.argument-missing"
    assert diagnostic.span.file.endswith("conftest.py" if included else "faulty.launch.py")
    assert included or diagnostic.span.line == _LINE
    assert included or f"{_LINE} |         {entity}" in text
    assert f"[ERROR] [launch]: {_CAUGHT}" in text
    assert "Traceback" not in text


@pytest.mark.parametrize(
    ("entities", "message"),
    [
        (
            "(LogInfo(msg='x'),)",
            "its item 1 is of type tuple (a comma behind an action makes a tuple",
        ),
        ("LogInfo(msg='x'), LogInfo", "its item 2 is the class LogInfo (write () behind a class)"),
        ("[LogInfo(msg='x')]", "its item 1 is of type list (write * before a list)"),
        ("None", "its item 1 is of type NoneType (a function may lack its return)"),
        ("3", "its item 1 is of type int"),
    ],
)
def test_what_is_no_action_is_refused_where_it_stands(
    entities: str, message: str, include: Include
) -> None:
    code, found, _text = include("faulty.launch.py", _HEAD.format(entities))
    (diagnostic,) = found
    assert code == 1
    assert message in diagnostic.message
    assert diagnostic.span is not None
    assert (Path(diagnostic.span.file).name, diagnostic.span.line) == ("faulty.launch.py", 6)


def test_a_syntax_error_is_shown_with_its_column(include: Include) -> None:
    code, found, text = include("faulty.launch.py", "def generate_launch_description(:\n    pass\n")
    (diagnostic,) = found
    assert code == 1
    assert diagnostic.span is not None
    assert (diagnostic.span.line, diagnostic.span.column) == (1, 33)
    head = "Caught multiple exceptions when trying to load file of format [py]:"
    assert f"[ERROR] [launch]: {_CAUGHT}{head}" in text
    assert " - SyntaxError: " in text


@pytest.mark.parametrize(
    ("name", "text", "code", "message", "line"),
    [
        (
            "a.launch.xml",
            "<launch>\n  <lgo/>\n</launch>",
            "ros2_launch.bad-element",
            "entity of the type: lgo",
            2,
        ),
        (
            "a.launch.xml",
            '<launch>\n\n  <log message="a" colour="red"/>\n</launch>',
            "ros2_launch.bad-element",
            "Unexpected attribute.s. found in `log`: {'colour'}",
            3,
        ),
        (
            "a.launch.xml",
            "<launch>\n <log\n</launch>",
            "ros2_launch.bad-file",
            "a.launch.xml:3",
            3,
        ),
        (
            "a.launch.xml",
            '<launch>\n  <log message="$(var x)"/>\n</launch>',
            "ros2_launch.substitution",
            "launch configuration 'x' does not exist",
            2,
        ),
        (
            "a.launch.yaml",
            "launch:\n- log:\n    message: a\n- log:\n    mesage: b\n",
            "ros2_launch.bad-element",
            "log lacks its attribute message: Can not find attribute 'message' in Entity 'log'",
            4,
        ),
        (
            "a.launch.xml",
            '<launch>\n  <log mesage="a" message="b"/>\n</launch>',
            "ros2_launch.bad-element",
            "{'mesage'}; did you mean 'message'",
            2,
        ),
        (
            "a.launch.xml",
            '<launch>\n  <node pkg="a" type="b"/>\n</launch>',
            "ros2_launch.bad-element",
            "node lacks its attribute exec",
            2,
        ),
        ("a.launch.xml", "<robot/>", "ros2_launch.bad-file", "Expected 'launch' as root tag", 1),
        (
            "a.launch.xml",
            "<launch>\n  <log message=\"$(eval '1 +')\"/>\n</launch>",
            "ros2_launch.exception",
            "invalid syntax.*in the expression: 1 [+]",
            2,
        ),
        (
            "a.launch.yaml",
            "launch:\n- log:\n    message: a\n    mesage: b\n",
            "ros2_launch.bad-element",
            "{'mesage'}; did you mean 'message'",
            2,
        ),
        ("a.launch.yaml", "", "ros2_launch.bad-file", "Expected only one root", 1),
        (
            "a.launch.yaml",
            "launch:\n- log:\n    message: 3\n",
            "ros2_launch.bad-element",
            "expected to be of type '<class 'str'>', got '<class 'int'>'",
            2,
        ),
        ("a.launch.yaml", "launch:\n- log:\n\tm: a\n", "ros2_launch.bad-file", "character '.t'", 3),
        (
            "a.launch.yaml",
            "launch:\n- log:\n    message: a: b\n",
            "ros2_launch.bad-file",
            "not YAML: mapping values are not allowed here",
            3,
        ),
        (
            "a.launch.yaml",
            "launch:\n- lgo: {}\n",
            "ros2_launch.bad-element",
            "entity of the type: lgo",
            2,
        ),
        (
            "a.launch.yaml",
            "launch:\n- [\n",
            "ros2_launch.bad-file",
            "not YAML: .*while parsing a flow node",
            3,
        ),
        (
            "a.launch.yaml",
            "launch:\n- log:\n    message: $(vra x)\n",
            "ros2_launch.bad-element",
            "Unknown substitution: vra",
            2,
        ),
    ],
)
def test_markup_errors_show_the_users_line(
    name: str, text: str, code: str, message: str, line: int, include: Include
) -> None:
    exit_code, found, _text = include(name, text)
    (diagnostic,) = found
    assert exit_code == 1
    assert diagnostic.code == code
    assert re.search(message, diagnostic.message)
    assert diagnostic.span is not None
    assert (Path(diagnostic.span.file).name, diagnostic.span.line) == (name, line)


def test_a_required_argument_behind_a_condition_is_missed_when_it_is_visited(
    include: Include,
) -> None:
    entity = "GroupAction([DeclareLaunchArgument('speed')], condition=IfCondition('true'))"
    _code, found, text = include("faulty.launch.py", _HEAD.format(entity))
    (diagnostic,) = found
    assert diagnostic.code == "ros2_launch.argument-missing"
    assert diagnostic.span is not None
    assert diagnostic.span.line == _LINE
    assert f'{_CAUGHT}Required launch argument "speed" was not provided.' in text


def test_files_that_include_each_other_are_told(include: Include) -> None:
    entity = "IncludeLaunchDescription(PythonLaunchDescriptionSource(__file__))"
    source = "from launch.launch_description_sources import PythonLaunchDescriptionSource\n"
    _code, found, _text = include("faulty.launch.py", source + _HEAD.format(entity))
    (diagnostic,) = found
    assert diagnostic.code == "ros2_launch.include-cycle"


@pytest.mark.parametrize(
    ("entity", "message", "fix"),
    [
        ("cmd=['xacr']", "the program 'xacr' is not on the PATH", "did you mean 'xacro'"),
        ("cmd=['echo hello']", "'echo hello' is no program", "cmd=['echo', 'hello'], or shell"),
        ("cmd='echo hello'", "was given as one text, which is taken letter", "cmd=['echo', 'hel"),
        ("cmd=['true'], cwd='/nowhere'", "its folder '/nowhere' does not exist", "correct"),
        ("cmd=['/']", "'/' cannot be started: ", "correct"),
    ],
)
def test_processes_that_cannot_be_started(
    entity: str, message: str, fix: str, include: Include
) -> None:
    code, found, text = include("faulty.launch.py", _HEAD.format(f"ExecuteProcess({entity})"))
    (diagnostic,) = found
    assert code == 0
    assert diagnostic.code == "ros2_launch.process-not-started"
    assert message in diagnostic.message
    assert fix in diagnostic.fix
    assert diagnostic.span is not None
    assert diagnostic.span.line == _LINE
    assert "exception occurred while executing process" in text


def test_errors_may_bring_their_own_finding(include: Include) -> None:
    own = with_diagnostic(ValueError("x"), "ros2_launch.file-missing", "m", SourceSpan("f"))
    assert [(one.code, one.message) for one in diagnose(own)] == [("ros2_launch.file-missing", "m")]


def test_an_error_ends_the_processes(include: Include) -> None:
    more = "TimerAction(period=0.2, actions=[OpaqueFunction(function=lambda context: nope)])"
    entity = f"ExecuteProcess(cmd=['sleep', '60']), {more}"
    code, found, text = include("faulty.launch.py", _HEAD.format(entity))
    assert (code, [one.code for one in found]) == (1, ["ros2_launch.exception"])
    assert "sending signal 'SIGINT' to process[sleep" in text


def test_a_handler_that_fails_does_not_keep_processes_alive(include: Include) -> None:
    handler = "OnShutdown(on_shutdown=lambda *_: nope)"
    entity = f"ExecuteProcess(cmd=['sleep', '60']), RegisterEventHandler({handler}), Shutdown()"
    source = "from launch.event_handlers import OnShutdown\n"
    code, found, text = include("faulty.launch.py", source + _HEAD.format(entity))
    assert (code, [one.code for one in found]) == (1, ["ros2_launch.exception"])
    assert "process has died [pid" in text


def test_the_traceback_is_in_the_debug_log(include: Include, capsys: Any) -> None:
    service = LaunchService(debug=True)
    action = IncludeLaunchDescription("/nowhere.launch.py")
    service.include_launch_description(LaunchDescription([action]))
    assert service.run() == 1
    assert "Traceback (most recent call last)" in capsys.readouterr().out
