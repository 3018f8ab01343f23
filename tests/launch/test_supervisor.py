"""Nodes of a launch: how they start, end, start again, and what they see."""

from __future__ import annotations

import os
import re
import shutil
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import psutil
import pytest
from tests.launch.conftest import node as written_node
from tests.launch.conftest import write_package
from tests.patience import stretched

Launch = Callable[..., Any]


@dataclass
class _Ended:
    """A launch whose nodes have all ended.

    Attributes:
        run: the launch.
        package: with the script that its nodes run.
        ros_home: where its logs are.
    """

    run: Any
    package: Path
    ros_home: Path


@pytest.fixture(scope="module")
def ended(module_gazelle: Launch, tmp_path_factory: pytest.TempPathFactory) -> _Ended:
    """One launch for all that only look at what its nodes said and left."""
    folder = tmp_path_factory.mktemp("ended")
    file = folder / "test.launch"
    nodes = (
        written_node("fine", "exit=0"),
        written_node("bad", "exit=3"),
        written_node("quiet", "say=hello complain=trouble"),
        written_node("loud", "say=loudly", output="screen"),
        '<env name="COLOUR" value="blue"/>',
        written_node("one", "env=COLOUR cwd env=ROS_NAMESPACE", output="screen", ns="deep"),
        written_node(
            "two", "cwd env=PRE", cwd="node", output="screen", launch_prefix="env PRE=fix"
        ),
    )
    package, home = write_package(folder), folder / "ros_home"
    file.write_text(f"<launch>{''.join(nodes)}</launch>", encoding="utf-8")
    run = module_gazelle("roslaunch", str(file), cwd=folder, ROS_HOME=str(home))
    assert run.wait() == 0
    return _Ended(run, package, home)


def test_ends_of_nodes_are_told_as_roslaunch_does_and_the_last_one_ends_the_launch(
    ended: _Ended,
) -> None:
    run = ended.run
    assert re.search(
        r"\[fine-\d\] process has finished cleanly\nlog file: .*/fine-\d\*\.log", run.text
    )
    assert re.search(
        r"\[bad-\d\] process has died \[pid \d+, exit code 3, cmd .*does exit=3", run.text
    )
    assert "all processes on machine have died, roslaunch will exit" in run.text
    assert run.lines[-1] == "done"


def test_required_node_ends_the_launch(launch: Launch, node: Launch) -> None:
    run = launch(node("stays", "wait") + node("key", "exit=4", required="true"))
    assert run.wait() == 1
    assert "REQUIRED process [key-3] has died!" in run.text
    assert "exit code 4" in run.text and "Initiating shutdown!" in run.text
    assert "[stays-2] killing on exit" in run.text


def test_required_node_that_ends_well_ends_the_launch_well(launch: Launch, node: Launch) -> None:
    run = launch(node("stays", "wait") + node("key", "exit=0", required="true"))
    assert run.wait() == 0
    assert "REQUIRED process [key-3] has died!\nprocess has finished cleanly" in run.text


def test_respawn_starts_again_under_the_same_label_after_its_delay(
    launch: Launch, node: Launch
) -> None:
    run = launch(node("again", "exit=1", respawn="true", respawn_delay="0.2"))
    run.eventually(lambda: len(re.findall(r"process\[again-2\]: started", run.text)) >= 3)
    assert "[again-2] restarting process" in run.text
    assert run.stop() == 0


def test_node_sees_its_environment_folder_arguments_and_prefix(
    ended: _Ended,
) -> None:
    # Behind what the launcher has begun to write, a line may stand on the same one.
    for line in ("COLOUR is blue", "ROS_NAMESPACE is /deep", "PRE is fix",
                 f"cwd is {ended.ros_home}", f"cwd is {ended.package / 'scripts'}"):  # fmt: skip
        assert re.search(rf"{re.escape(line)}$", ended.run.text, re.MULTILINE), line


def test_log_output_goes_to_files_and_standard_error_to_the_terminal(ended: _Ended) -> None:
    assert "hello" not in ended.run.text
    for line in ("trouble", "loudly"):
        assert re.search(rf"{line}$", ended.run.text, re.MULTILINE), line
    (file,) = (ended.ros_home / "log" / "latest").glob("quiet-*-stdout.log")
    assert file.read_text(encoding="utf-8") == "hello\n"


def test_screen_and_log_options_override_the_file(launch: Launch, node: Launch) -> None:
    run = launch(node("quiet", "say=hello"), "--screen")
    assert run.wait() == 0
    assert "hello" in run.lines
    run = launch(node("loud", "say=hello", output="screen"), "--log")
    assert run.wait() == 0
    assert "hello" not in run.lines


def test_stubborn_nodes_get_stronger_signals(launch: Launch, node: Launch) -> None:
    # The mule dies of SIGTERM, for which a busy machine needs a while.
    nodes = {"mule": "ignore=SIGINT", "rock": "ignore=SIGINT ignore=SIGTERM"}
    run = launch(
        "".join(node(name, f"{ignored} say={name}_ready wait", output="screen")
                for name, ignored in nodes.items()),
        "--sigint-timeout=0.2", f"--sigterm-timeout={stretched(1.0)}",
    )  # fmt: skip
    for name in nodes:
        run.wait_for_line(f"^{name}_ready$")
    assert run.stop() == 0
    told = re.findall(r"\[(mule|rock)-\d\] escalating to (\w+)", run.text)
    assert dict(told) == {"mule": "SIGTERM", "rock": "SIGKILL"}
    assert run.processes() == {}


def test_interrupt_while_nodes_are_started_ends_those_that_are_there(
    launch: Launch, node: Launch
) -> None:
    """No more are started then, and the launch ends as well as later."""
    run = launch("".join(node(f"n{number}", "wait") for number in range(60)))
    run.wait_for_line(r"process\[n0-\d\]: started with pid")
    assert run.stop() == 0, run.text
    assert len(re.findall(r"process\[n\d+-\d+\]: started", run.text)) < 60
    assert "... shutting down processing monitor complete" in run.text
    assert run.processes() == {}


def test_broken_arguments_are_told_and_the_rest_starts(launch: Launch, node: Launch) -> None:
    run = launch(node("torn", "'open") + node("fine", "say=hi", output="screen"))
    assert run.wait() == 1
    assert "cannot start [torn-2]: No closing quotation" in run.text
    assert "hi" in run.lines


def test_killed_launcher_leaves_nothing_behind(launch: Launch, node: Launch) -> None:
    """Not even a deaf grandchild, which no parent-death signal reaches."""
    run = launch(
        node("parent", "child ignore=SIGTERM wait", output="screen")
        + node("ros", "node=ros")
        + '<node pkg="tf2_ros" type="static_transform_publisher" name="tf" args="0 0 0 0 0 0 a b"/>'
    )
    run.wait_for_line("child is there")
    run.eventually(lambda: {"/ros", "/tf"} <= set(run.graph.node_names()))
    assert len(run.processes()) >= 6  # launcher, guard, host, parent, child, ros
    run.popen.kill()
    run.eventually(lambda: run.processes() == {})


def test_killed_user_node_is_reported_and_leaves_the_graph(launch: Launch, node: Launch) -> None:
    run = launch(node("ros", "node=ros") + node("stays", "wait"))
    run.eventually(lambda: "/ros" in run.graph.node_names())
    pid = int(re.search(r"process\[ros-2\]: started with pid \[(\d+)\]", run.text)[1])
    os.kill(pid, signal.SIGKILL)
    run.wait_for_line(r"\[ros-2\] process has died .* signal SIGKILL, exit code -9")
    # Gone, and no zombie: the launch has asked for its exit code.
    run.eventually(lambda: not psutil.pid_exists(pid))
    run.eventually(lambda: "/ros" not in run.graph.node_names())
    assert run.popen.poll() is None
    assert run.stop() == 0


def test_killed_process_of_light_nodes_is_replaced(launch: Launch) -> None:
    run = launch(
        '<node pkg="tf2_ros" type="static_transform_publisher" name="tf" args="0 0 1 0 0 0 a b"/>'
    )
    pid = int(re.search(r"\[(\d+)\]", run.wait_for_line(r"process\[tf-2\]: started"))[1])
    run.eventually(lambda: "/tf" in run.graph.node_names())
    os.kill(pid, signal.SIGKILL)
    run.wait_for_line(rf"the process of the built-in nodes \[pid {pid}\] has died")
    (message,) = run.messages({"/tf_static": 1})["/tf_static"]
    assert message.transforms[0].transform.translation.z == 1.0
    assert run.stop() == 0
    assert run.processes() == {}


def test_killed_simulator_is_reported_and_comes_back_when_the_file_says_so(
    gazelle: Launch,
) -> None:
    run = gazelle("roslaunch", "gazebo_ros", "empty_world.launch", "respawn_gazebo:=true",
                  "gui:=false")  # fmt: skip
    pid = int(re.search(r"\[(\d+)\]", run.wait_for_line(r"process\[gazebo-2\]: started"))[1])
    run.messages({"/clock": 1})
    os.kill(pid, signal.SIGKILL)
    run.wait_for_line(r"\[gazebo-2\] process has died .*signal SIGKILL")
    run.wait_for_line(r"\[gazebo-2\] restarting process")
    run.messages({"/clock": 1})
    assert run.stop() == 0
    assert run.processes() == {}


def test_a_node_starts_again_where_its_logs_were_removed(
    launch: Launch, node: Launch, tmp_path: Path
) -> None:
    """``rosclean purge`` beside a launch."""
    run = launch(node("stays", "say=here wait", respawn="true"))
    started = r"process\[stays-2\]: started with pid \[(\d+)\]"
    found = re.search(started, run.wait_for_line(started))
    assert found
    shutil.rmtree(tmp_path / "ros_home" / "log")
    os.kill(int(found[1]), signal.SIGKILL)
    run.eventually(lambda: len(re.findall(started, run.text)) == 2)
    logs = tmp_path / "ros_home" / "log"
    run.eventually(lambda: [one for one in logs.rglob("stays-2-stdout.log") if one.read_text()])
    assert run.stop() == 0
