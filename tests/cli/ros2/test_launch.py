"""``ros2 launch``: which file, its options, its arguments, and what goes wrong."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import psutil
import pytest

from gazelle.cli.ros2.launch import launch_arguments, main
from gazelle.cli.ros_tool import ToolError
from gazelle.launch.ros2 import logging
from gazelle.workspace.ament_index import known_workspace

Run = Callable[..., Any]
_HEAD = """
from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

def generate_launch_description():
"""
_ECHO = """    return LaunchDescription([
        DeclareLaunchArgument('word', default_value='hello', description='what is said'),
        DeclareLaunchArgument('name', description='who says it'),
        GroupAction([DeclareLaunchArgument('more', default_value=['a', 'b'])],
                    condition=IfCondition('false')),
        ExecuteProcess(cmd=['sh', '-c', ['echo ', LaunchConfiguration('word'), ' $GZ_LAUNCHED']]),
    ])
"""


@pytest.fixture
def ros2(gazelle: Run, tmp_path: Path) -> Run:
    """Runs ``ros2 launch WORDS…`` in a workspace with package ``bringup``."""
    folder = tmp_path / "ws" / "src" / "bringup"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package format='3'><name>bringup</name></package>")
    for name, body in {
        "say.launch.py": _ECHO,
        "wrong.launch.py": "    robot = {}\n    return LaunchDescription([robot['arm']])\n",
        "node.launch.py": "    node = Node(package='bringup', executable='no')\n"
        "    return LaunchDescription([node])\n",
        "dies.launch.py": "    return LaunchDescription([\n        ExecuteProcess(cmd=['sh', '-c', "
        "'echo bad >&2; exit 3'], name='sick', output='screen'),\n        ExecuteProcess(cmd=["
        "'sleep', '60'], name='healthy')])\n",
    }.items():
        (folder / "launch" / name).write_text(_HEAD + body)
    (folder / "launch" / "say.launch.xml").write_text(
        '<launch><arg name="word" default="hello"/><log message="xml says $(var word)"/></launch>'
    )

    def run(*words: str, **options: Any) -> Any:
        return gazelle("ros2", "launch", *words, cwd=tmp_path / "ws", **options)

    return run


class Ran(NamedTuple):
    """The command, run in the test's own process: exit code and text of the terminal."""

    code: int
    text: str


@pytest.fixture
def here(
    ros2: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Callable[..., Ran]]:
    """Runs ``ros2 launch WORDS…`` in this process, which is ten times as fast as a new one."""
    before = dict(os.environ)
    monkeypatch.chdir(tmp_path / "ws")
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    monkeypatch.setattr(sys, "path", list(sys.path))
    monkeypatch.setattr(sys, "meta_path", list(sys.meta_path))

    def run(*words: str) -> Ran:
        known_workspace.cache_clear()
        logging.reset()
        code = main(list(words))
        shown = capsys.readouterr()
        return Ran(code, shown.out + shown.err)

    yield run
    logging.reset()
    known_workspace.cache_clear()
    os.environ.clear()
    os.environ.update(before)


def test_arguments_reach_the_file_wherever_it_is_named(
    ros2: Run, here: Callable[..., Ran], tmp_path: Path
) -> None:
    ran = ros2("bringup", "say.launch.py", "name:=me", "word:=a", "word:=good day", "-a")
    assert ran.wait() == 0
    # With -a all output is shown.
    assert "[sh-1] good day" in ran.text
    file = str(tmp_path / "ws/src/bringup/launch/say.launch.py")
    assert here("--noninteractive", file, "name:=me").code == 0
    xml = here("bringup", "say.launch.xml", "word:=this")
    assert xml.code == 0
    assert "[INFO] [launch.user]: xml says this" in xml.text


def test_arguments_are_listed_with_defaults_and_conditions(here: Callable[..., Ran]) -> None:
    shown = here("bringup", "say.launch.py", "--show-args")
    assert shown.code == 0
    assert shown.text.splitlines() == [
        "Arguments (pass arguments as '<name>:=<value>'):", "",
        "    'word':", "        what is said", "        (default: 'hello')", "",
        "    'name':", "        who says it", "",
        "    'more':*", "        no description given", "        (default: 'a' + 'b')", "",
        "* argument(s) which are only used if specific conditions occur",
    ]  # fmt: skip


def test_tree_is_printed_and_nothing_is_started(here: Callable[..., Ran]) -> None:
    shown = here("bringup", "say.launch.py", "-p")
    assert shown.code == 0
    assert "LaunchDescription object at" in shown.text.splitlines()[0]
    assert "ExecuteProcess(cmd=['sh', '-c', 'echo ' + LaunchConfig('word') + " in shown.text
    assert "process started" not in shown.text


def test_prefix_goes_before_what_its_filter_finds(here: Callable[..., Ran]) -> None:
    prefix = ("--launch-prefix", "env GZ_LAUNCHED=prefixed")
    ran = here("bringup", "say.launch.py", "name:=me", "-a", *prefix)
    assert ran.code == 0 and "] hello prefixed" in ran.text
    filtered = here("bringup", "say.launch.py", "name:=me", "-a", *prefix,
                    "--launch-prefix-filter", "bash")  # fmt: skip
    assert filtered.code == 0 and "prefixed" not in filtered.text
    refused = here("bringup", "say.launch.py", "--launch-prefix-filter", "x")
    assert refused.code == 1
    assert "--launch-prefix must be specified if --launch-prefix-filter is" in refused.text


def test_debug_tells_of_every_event(here: Callable[..., Ran]) -> None:
    ran = here("bringup", "say.launch.py", "name:=me", "-d")
    assert ran.code == 0
    assert "[DEBUG] [launch]: processing event: '<" in ran.text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["bringupp", "say.launch.py"], "Package 'bringupp' not found: package 'bringupp' not"),
        (["bringupp", "say.launch.py"], "did you mean 'bringup'"),
        (["bringup", "sai.launch.py"], "file 'sai.launch.py' was not found in the share direct"),
        (["bringup", "sai.launch.py"], "did you mean 'say.launch.py'"),
        (["bringup", "launch/say.launch.py"], "fix: ros2 launch bringup say.launch.py"),
        (["bringup"], "No launch file name supplied; package 'bringup' has: dies.launch.py, "),
        (["nothing"], "'nothing' is neither a launch file nor a package"),
        (["src/bringup/launch/sai.launch.py"], "does not exist; did you mean 'src/bringup/launch"),
        (["bringup", "say.launch.py", "word:="], "malformed launch argument 'word:=', expected"),
        (["bringup", "say.launch.py", "word=x"], "fix: word:=x"),
    ],
)
def test_mistakes_of_the_command_line_are_told(
    words: list[str], message: str, here: Callable[..., Ran]
) -> None:
    ran = here(*words)
    assert ran.code == 1
    assert message in ran.text


@pytest.mark.parametrize(
    ("words", "messages"),
    [
        (
            ["say.launch.py", "nam:=x"],
            ["missing required argument 'name' (description: 'who says", "did you mean 'nam'?"],
        ),
        (["node.launch.py"], ["Cannot locate node of type [no] in package [bringup]"]),
    ],
)
def test_mistakes_of_the_launch_are_told(
    here: Callable[..., Ran], words: list[str], messages: list[str]
) -> None:
    ran = here("bringup", *words)
    assert ran.code == 1
    assert [text for text in messages if text not in ran.text] == []
    assert "Traceback" not in ran.text


def test_exception_in_a_launch_file_is_shown_at_its_line(here: Callable[..., Ran]) -> None:
    ran = here("bringup", "wrong.launch.py")
    assert ran.code == 1
    assert "wrong.launch.py:10: error: KeyError: 'arm' [ros2_launch.exception]" in ran.text
    assert "return LaunchDescription([robot['arm']])" in ran.text
    assert "/gazelle/" not in ran.text


def test_death_of_a_process_is_told_and_others_go_on(ros2: Run) -> None:
    ran = ros2("bringup", "dies.launch.py")
    line = ran.wait_for_line(r"\[ERROR\] \[sick-1\]: process has died")
    assert "exit code 3, cmd 'sh -c echo bad >&2; exit 3']." in line
    assert "[sick-1] bad" in ran.lines
    assert ran.stop(signal.SIGTERM) == 0
    assert ran.processes() == {}


def test_killed_process_is_told_and_leaves_no_zombie(ros2: Run) -> None:
    ran = ros2("bringup", "dies.launch.py")
    line = ran.wait_for_line(r"\[INFO\] \[healthy-2\]: process started with pid")
    pid = int(line.partition("pid [")[2].partition("]")[0])
    # The launch must not be over when the process is looked for: nothing else runs in it.
    ran.wait_for_line(r"\[ERROR\] \[sick-1\]: process has died")
    os.kill(pid, signal.SIGKILL)
    line = ran.wait_for_line(r"\[ERROR\] \[healthy-2\]: process has died")
    assert f"process has died [pid {pid}, exit code -9, cmd 'sleep 60']." in line
    ran.eventually(lambda: not psutil.pid_exists(pid))


def test_launcher_that_is_killed_leaves_nothing(ros2: Run) -> None:
    ran = ros2("bringup", "dies.launch.py")
    ran.wait_for_line("process has died")
    ran.stop(signal.SIGKILL)
    ran.eventually(lambda: not ran.processes())


def test_files_of_one_name_are_both_named(here: Callable[..., Ran], tmp_path: Path) -> None:
    folder = tmp_path / "ws/src/bringup"
    (folder / "old").mkdir()
    (folder / "old" / "say.launch.py").write_text("")
    ran = here("bringup", "say.launch.py")
    assert ran.code == 1
    assert "was found more than once" in ran.text
    assert f"fix: ros2 launch {folder}/launch/say.launch.py" in ran.text


def test_one_file_at_two_places_is_no_second_file(here: Callable[..., Ran], tmp_path: Path) -> None:
    folder = tmp_path / "ws/src/bringup"
    (folder / "old").mkdir()
    (folder / "old" / "say.launch.py").symlink_to(folder / "launch/say.launch.py")
    ran = here("bringup", "say.launch.py", "--show-args")
    assert ran.code == 0
    assert "more than once" not in ran.text


def test_arguments_may_hold_the_sign_themselves() -> None:
    assert launch_arguments(["a:=b:=c", "d:=e", "a:=x"]) == [("a", "x"), ("d", "e")]
    assert launch_arguments(["cmd:=x:=1"]) == [("cmd", "x:=1")]
    for word in (":=x", "x:=", "x"):
        with pytest.raises(ToolError, match="malformed launch argument"):
            launch_arguments([word])
