"""Launches and simulators join a real ROS that runs, unless they are told not to."""

from __future__ import annotations

import contextlib
import shutil
import socket
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import psutil
import pytest
from tests.bridge.ros1.real import Ros1
from tests.patience import stretched

from gazelle.launch import real_ros as module
from gazelle.launch.real_ros import RealRos, join, real_ros

Run = Callable[..., Any]
_WORLD = '<sdf version="1.6"><world name="w"/></sdf>'


@pytest.fixture
def other_port(next_port: Callable[[], int]) -> int:
    """A port for another graph."""
    return next_port()


@pytest.fixture
def master(gazelle: Run, other_port: int, next_port: Callable[[], int]) -> Any:
    """A master of ROS 1 with a graph of its own behind it."""
    number = str(next_port())
    run = gazelle("bridge", "ros1", "--port", number, port=other_port)
    run.wait_for_line("the bridge is the master at")
    run.uri = f"http://127.0.0.1:{number}"
    return run


def test_a_launch_joins_the_master_it_finds(launch: Run, node: Run, master: Any) -> None:
    master.graph.parameters.set("/run_id", "run-of-the-master")
    master.graph.parameters.set("/x", 1)
    body = '<param name="x" value="3"/>' + node("n", "node=n")
    run = launch(body, ROS_MASTER_URI=master.uri)
    run.wait_for_line(rf"a ROS 1 master runs at {master.uri}/ \(pid {master.popen.pid}\): gazelle")
    run.wait_for_line("the bridge has joined the master")
    run.wait_for_line("every user of this machine can reach it: ROS 1 asks nobody for a password")
    master.eventually(lambda: "/n" in master.graph.node_names())
    # What the launch sets counts, as with roslaunch.
    master.eventually(lambda: master.graph.parameters.get("/x") == 3)
    assert "/log/run-of-the-master/roslaunch-" in run.lines[0]
    assert "setting /run_id" not in run.text
    second = launch(node("m", "node=m"), ROS_MASTER_URI=master.uri)
    master.eventually(lambda: "/m" in master.graph.node_names())
    assert "gazelle bridge" not in second.text
    assert second.stop() == run.stop() == 0
    assert run.processes() == {}


@pytest.mark.parametrize("way", ["option", "variable"])
def test_a_launch_keeps_apart_when_told(launch: Run, node: Run, master: Any, way: str) -> None:
    words = ("--no-bridge",) if way == "option" else ()
    variables = {} if way == "option" else {"GAZELLE_BRIDGE": "no"}
    run = launch(
        node("n", "say=alone", output="screen"), *words, ROS_MASTER_URI=master.uri, **variables
    )
    assert run.wait() == 0
    assert "alone" in run.lines
    assert "ROS 1 master" not in run.text


@pytest.mark.parametrize("words", [("gazebo",), ("rosrun", "gazebo_ros", "gzserver")])
def test_a_simulator_joins_and_takes_the_bridge_along(
    gazelle: Run, master: Any, words: tuple[str, ...], tmp_path: Path
) -> None:
    (tmp_path / "w.world").write_text(_WORLD, encoding="utf-8")
    run = gazelle(*words, "w.world", ROS_MASTER_URI=master.uri)
    run.wait_for_line("gazelle bridge ros1 joins it")
    master.eventually(lambda: "/gazebo" in master.graph.node_names())
    assert run.stop() == 0
    run.eventually(lambda: run.processes() == {})


def test_a_bridge_that_has_ended_is_not_waited_for() -> None:
    class Supervisor:
        def start(self, spec: Any, executable: Any, *, core: bool) -> bool:
            return True

        def runs(self, spec: Any) -> bool:
            return False

    lines: list[str] = []

    class Console:
        plain = warning = lines.append

    class NoParameters:
        def has(self, name: str) -> bool:
            return False

    graph: Any = type("Graph", (), {"parameters": NoParameters()})
    supervisor: Any = Supervisor()
    console: Any = Console()
    join([RealRos("ros1", "a ROS 1 master runs", run_id="r")], supervisor, graph, console)
    assert lines[-1] == "the bridge to ros1 is not ready; the launch goes on"


def test_what_is_no_master_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_ANSWER_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        uri = f"http://127.0.0.1:{silent.getsockname()[1]}"
        assert real_ros({"ROS_MASTER_URI": uri}, tuple) == []
    assert real_ros({"ROS_MASTER_URI": uri}, tuple) == []
    assert real_ros({"ROS_MASTER_URI": "localhost"}, tuple) == []
    assert real_ros({}, tuple) == []


@contextlib.contextmanager
def _real_core(ros1: Ros1, port: int) -> Iterator[subprocess.Popen[str]]:
    with ros1.running("/usr/bin/roscore", "-p", str(port)) as core:
        assert core.stdout is not None
        for line in core.stdout:
            if "started core service [/rosout]" in line:
                break
        yield core


def test_the_real_roscore_is_joined(
    launch: Run, node: Run, tmp_path: Path, other_port: int
) -> None:
    if not shutil.which("roscore", path="/usr/bin"):
        pytest.skip("ROS 1 is not installed (apt-get install ros-core)")
    uri = f"http://localhost:{other_port}"
    ros1 = Ros1(uri, tmp_path)
    with _real_core(ros1, other_port):
        run = launch('<param name="x" value="3"/>' + node("n", "node=n"), ROS_MASTER_URI=uri)
        run.wait_for_line("the bridge has joined the master")
        run.eventually(lambda: "/n" in ros1("/usr/bin/rosnode", "list").split())
        assert ros1("/usr/bin/rosparam", "get", "/x") == "3\n"
        # The log is gathered by the real one alone.
        assert ros1("/usr/bin/rosnode", "list").split() == ["/n", "/rosout"]
        assert run.stop() == 0


def test_nodes_come_back_to_a_real_roscore_that_was_killed(
    launch: Run, node: Run, tmp_path: Path, other_port: int
) -> None:
    if not shutil.which("roscore", path="/usr/bin"):
        pytest.skip("ROS 1 is not installed (apt-get install ros-core)")
    uri = f"http://localhost:{other_port}"
    ros1 = Ros1(uri, tmp_path)

    def here() -> list[str]:
        # Who asks a master that is coming up may find none, one time in ten.
        with contextlib.suppress(AssertionError):
            return ros1("/usr/bin/rosnode", "list").split()
        return []

    with _real_core(ros1, other_port) as core:
        run = launch(node("n", "node=n"), ROS_MASTER_URI=uri)
        run.wait_for_line("the bridge has joined the master")
        run.eventually(lambda: "/n" in here())
        (master,) = [
            one for one in psutil.Process(core.pid).children() if "rosmaster" in one.name()
        ]
        master.kill()
        core.wait(stretched())
    with _real_core(ros1, other_port):
        # Ours comes back and the core's own comes up, each in its time, topic by topic.
        run.eventually(lambda: here() == ["/n", "/rosout"])
        run.eventually(lambda: "* /n " in ros1("/usr/bin/rostopic", "info", "/rosout"))
        assert run.stop() == 0
