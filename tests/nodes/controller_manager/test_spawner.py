"""Spawners of both generations against a manager in a paused world."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.control.manager_world import manager_world
from tests.patience import stretched

from gazelle.errors import LaunchError
from gazelle.graph import Graph, LogRecord
from gazelle.interfaces import message_type, service_type
from gazelle.nodes.arguments import read_arguments
from gazelle.nodes.controller_manager import spawner as controller_spawner
from gazelle.nodes.controller_manager import spawner_ros2 as controller_spawner_ros2
from gazelle.nodes.controller_manager.client import ManagerClient

Run = Callable[..., int]


class Spawner:
    """A spawner in a thread of its own."""

    def __init__(self, graph: Graph, run: Run, words: list[str], namespace: str = "/mira") -> None:
        self.stop, self.is_ready = threading.Event(), threading.Event()
        self.code: int | None = None
        arguments = read_arguments(words, "spawner", namespace=namespace, ready=self.is_ready.set)

        def target() -> None:
            self.code = run(arguments, graph, self.stop)

        self.thread = threading.Thread(target=target)
        self.thread.start()

    def end(self) -> int | None:
        """Ask it to end; return its exit code."""
        self.stop.set()
        return self.join()

    def join(self) -> int | None:
        """Wait for its end."""
        self.thread.join(stretched(20))
        assert not self.thread.is_alive()
        return self.code


@pytest.fixture
def lines() -> list[str]:
    """What nodes have said."""
    return []


@pytest.fixture
def graph(free_port: int, lines: list[str]) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:

        def keep(record: LogRecord, **_options: Any) -> None:
            lines.append(f"{record.level.name}: {record.text}")

        graph.console = keep
        yield graph


def _states(manager: Any) -> dict[str, str]:
    return {name: one.ros1_word for name, one in manager.controllers.items()}


def test_ros1_spawner_starts_stays_and_unloads_at_the_end(graph, monkeypatch, lines):
    with manager_world(graph, monkeypatch) as manager:
        spawner = Spawner(graph, controller_spawner.run, ["left", "right"])
        assert spawner.is_ready.wait(stretched(30)), lines
        assert _states(manager) == {"left": "running", "right": "running"}
        assert spawner.thread.is_alive()
        assert spawner.end() == 0
        assert not manager.controllers
    said = [line.removeprefix("INFO: ") for line in lines]
    start = said.index("Controller Spawner: Waiting for service controller_manager/load_controller")
    assert said[start + 3 : start + 7] == [
        "Loading controller: left",
        "Loading controller: right",
        "Controller Spawner: Loaded controllers: left, right",
        "Started controllers: left, right",
    ]
    assert said[start + 7 :] == [
        "Shutting down spawner. Stopping and unloading controllers...",
        "Stopping all controllers...",
        "Unloading all loaded controllers...",
        "Trying to unload right",
        "Succeeded in unloading right",
        "Trying to unload left",
        "Succeeded in unloading left",
    ]


def test_ros1_spawner_in_the_root_names_the_namespace(graph, monkeypatch):
    with manager_world(graph, monkeypatch) as manager:
        words = ["--namespace=/mira", "--stopped", "left"]
        spawner = Spawner(graph, controller_spawner.run, words, namespace="/")
        assert spawner.is_ready.wait(stretched(30))
        assert _states(manager) == {"left": "initialized"}
        spawner.end()


def test_ros1_spawner_goes_on_with_what_can_be_loaded(graph, monkeypatch, lines):
    with manager_world(graph, monkeypatch) as manager:
        spawner = Spawner(graph, controller_spawner.run, ["lefd", "right"])
        assert spawner.is_ready.wait(stretched(30))
        assert _states(manager) == {"right": "running"}
        spawner.end()
    assert "ERROR: Failed to load lefd" in lines
    assert any("because the type was not specified" in line for line in lines)
    assert "INFO: Started controllers: right" in lines


def test_ros1_spawner_loads_the_parameters_of_a_file(graph, monkeypatch, tmp_path):
    file = tmp_path / "controllers.yaml"
    file.write_text("third: {type: test_controllers/Recorder, joint: left, gain: 2.0}\n")
    with manager_world(graph, monkeypatch) as manager:
        spawner = Spawner(graph, controller_spawner.run, [str(file)])
        assert spawner.is_ready.wait(stretched(30))
        assert _states(manager) == {"third": "running"}
        assert manager.controllers["third"].controller.gain == 2.0
        spawner.end()


def test_ros1_spawner_waits_for_true_on_a_topic(graph, monkeypatch):
    kind = message_type("std_msgs/Bool")
    with manager_world(graph, monkeypatch) as manager:
        spawner = Spawner(graph, controller_spawner.run, ["--wait-for", "/go", "left"])
        publisher = graph.create_node("test").create_publisher("/go", kind)
        assert graph.discovery.wait_for(lambda _known: publisher.matched, 10)
        publisher.publish(kind(data=False))
        assert not manager.controllers
        spawner.is_ready.clear()
        publisher.publish(kind(data=True))
        assert spawner.is_ready.wait(stretched(30))
        assert _states(manager) == {"left": "running"}
        spawner.end()


def test_a_manager_that_is_elsewhere_is_named_when_the_time_is_up(graph, monkeypatch, lines):
    with manager_world(graph, monkeypatch):
        spawner = Spawner(graph, controller_spawner.run, ["--timeout", "0.2", "left"], "/")
        assert spawner.join() == 0
    (line,) = [line for line in lines if line.startswith("WARN")]
    assert "couldn't find the expected controller_manager ROS interface" in line
    assert "controller managers are: /mira/controller_manager" in line


def test_a_paused_simulation_never_times_out(graph, monkeypatch, lines):
    graph.parameters.set("/use_sim_time", True)
    graph.create_node("other").create_publisher("/clock", message_type("rosgraph_msgs/Clock"))
    monkeypatch.setattr(controller_spawner, "_PATIENCE_S", 0.05)
    monkeypatch.setattr(controller_spawner, "_QUIET_TIMES", 1)
    spawner = Spawner(graph, controller_spawner.run, ["--timeout", "0.01", "left"])
    # Time is asked for: whoever holds it back lets it go on.
    assert spawner.is_ready.wait(stretched(30))
    assert spawner.thread.is_alive()
    assert spawner.end() == 0
    assert "INFO: Waiting for /clock to be available..." in lines
    assert any("there is no controller manager at all" in line for line in lines)


def test_without_a_clock_the_time_is_the_walls(graph, lines):
    graph.parameters.set("/use_sim_time", True)
    graph.create_node("other")
    spawner = Spawner(graph, controller_spawner.run, ["--timeout", "0.2", "left"])
    assert spawner.join() == 0
    assert any("couldn't find the expected controller_manager ROS" in line for line in lines)


def test_a_simulator_that_loads_its_world_is_waited_for(graph, monkeypatch, lines):
    graph.parameters.set("/use_sim_time", True)
    simulator = graph.create_node("gazebo")
    monkeypatch.setattr(controller_spawner, "_PATIENCE_S", 0.05)
    monkeypatch.setattr(controller_spawner, "_QUIET_TIMES", 1)
    spawner = Spawner(graph, controller_spawner.run, ["--timeout", "0.01", "left"])
    assert spawner.is_ready.wait(stretched(30))
    assert spawner.thread.is_alive()
    simulator.shutdown()
    assert spawner.join() == 0
    assert any("couldn't find the expected controller_manager ROS" in line for line in lines)


def test_a_manager_that_still_comes_is_not_taken_for_the_other_generations(graph, monkeypatch):
    node = graph.create_node("cm")
    load, configure = (
        service_type(f"controller_manager_msgs/{one}Controller") for one in ("Load", "Configure")
    )
    client = ManagerClient(graph.create_node("asking"), "/cm")
    look = graph.has_service

    def look_and_go_on(name):
        found = look(name)
        node.create_service("/cm/configure_controller", configure, lambda _request: None)
        return found

    node.create_service("/cm/load_controller", load, lambda _request: None)
    monkeypatch.setattr(graph, "has_service", look_and_go_on)
    assert client.ros_version == 2
    assert ManagerClient(node, "/nowhere", ros_version=2).ros_version == 2


def test_ros1_unspawner_stops_controllers_and_starts_them_again(graph, monkeypatch):
    with manager_world(graph, monkeypatch) as manager:
        for name in ("left", "right"):
            manager.load(name)
        manager.switch(start=["left", "right"])
        spawner = Spawner(graph, controller_spawner.run_unspawner, ["left"])
        done = threading.Event()
        while _states(manager)["left"] == "running":
            done.wait(0.01)
        assert _states(manager)["right"] == "running"
        assert spawner.end() == 0
        assert _states(manager)["left"] == "running"


@pytest.mark.parametrize("module", [controller_spawner, controller_spawner_ros2])
def test_a_ros2_manager_is_told_from_its_services(graph, monkeypatch, lines, module):
    with manager_world(graph, monkeypatch, 2) as manager:
        spawner = Spawner(graph, module.run, ["left", "right"])
        assert spawner.join() == 0
        assert {one.state for one in manager.controllers.values()} == {"active"}
    assert "INFO: Loaded left" in lines
    assert "INFO: Configured and activated right" in lines


@pytest.mark.parametrize(
    ("words", "state"),
    [
        (["--load-only"], "unconfigured"),
        (["--inactive"], "inactive"),
        (["--stopped", "-c", "controller_manager"], "inactive"),
        (["-c", "/mira/controller_manager", "--activate-as-group"], "active"),
    ],
)
def test_ros2_spawner_stops_at_the_state_asked_for(graph, monkeypatch, words, state):
    with manager_world(graph, monkeypatch, 2) as manager:
        assert Spawner(graph, controller_spawner_ros2.run, ["left", *words]).join() == 0
        assert manager.controllers["left"].state == state


def test_ros2_spawner_brings_type_and_file(graph, monkeypatch, tmp_path):
    file = tmp_path / "third.yaml"
    file.write_text(
        "/**/third:\n  ros__parameters:\n    type: test_controllers/Recorder\n    joint: right\n"
    )
    with manager_world(graph, monkeypatch, 2) as manager:
        words = ["third", "--param-file", str(file), "--controller-manager-timeout", "5"]
        assert Spawner(graph, controller_spawner.run, words).join() == 0
        assert manager.controllers["third"].commands == ("right/effort",)
        words = ["fourth", "-t", "test_controllers/Recorder", "--load-only"]
        assert Spawner(graph, controller_spawner.run, words).join() == 0
        assert manager.controllers["fourth"].type == "test_controllers/Recorder"


@pytest.mark.parametrize("section", ["/mira/third", "/**/third", "/**"])
def test_parameters_of_the_spawners_node_are_the_controllers(graph, monkeypatch, tmp_path, section):
    file = tmp_path / "third.yaml"
    file.write_text(
        f"{section}:\n  ros__parameters:\n    type: test_controllers/Recorder\n    joint: right\n"
    )
    with manager_world(graph, monkeypatch, 2) as manager:
        words = ["third", "--ros-args", "--params-file", str(file)]
        assert Spawner(graph, controller_spawner_ros2.run, words).join() == 0
        assert manager.controllers["third"].commands == ("right/effort",)


def test_controller_ros_args_are_told_to_the_controllers_node(graph, monkeypatch, tmp_path):
    file = tmp_path / "third.yaml"
    file.write_text("/**/third:\n  ros__parameters:\n    joint: left\n")
    words = ["third", "-t", "test_controllers/Recorder"]
    words += ["--controller-ros-args", f"--ros-args --params-file {file} -p joint:=right"]
    words += ["--controller-ros-args", "-r third/state:=/elsewhere"]
    with manager_world(graph, monkeypatch, 2) as manager:
        assert Spawner(graph, controller_spawner_ros2.run, words).join() == 0
        assert manager.controllers["third"].commands == ("right/effort",)
        assert manager.source.remappings("third") == (("third/state", "/elsewhere"),)


def test_ros2_spawner_fails_with_the_managers_reason(graph, monkeypatch, lines):
    controllers = {"a": {"joint": "left"}, "b": {"joint": "left"}}
    with manager_world(graph, monkeypatch, 2, controllers):
        assert Spawner(graph, controller_spawner_ros2.run, ["a", "b"]).join() == 1
        assert Spawner(graph, controller_spawner_ros2.run, ["c"]).join() == 1
    text = "\n".join(lines)
    assert "Failed to activate controller : b: Resource conflict for controller 'b'" in text
    assert "FATAL: Failed loading controller c" in text
    assert "The 'type' param was not defined for 'c'" in text


def test_ros2_spawner_unloads_when_killed_if_asked(graph, monkeypatch):
    with manager_world(graph, monkeypatch, 2) as manager:
        spawner = Spawner(graph, controller_spawner.run, ["left", "-u"])
        assert spawner.is_ready.wait(stretched(30))
        assert manager.controllers["left"].state == "active"
        assert spawner.end() == 0
        assert not manager.controllers


def test_ros2_unspawner_deactivates_and_unloads(graph, monkeypatch):
    with manager_world(graph, monkeypatch, 2) as manager:
        assert Spawner(graph, controller_spawner_ros2.run, ["left", "right"]).join() == 0
        assert Spawner(graph, controller_spawner.run_unspawner, ["left"]).join() == 0
        assert list(manager.controllers) == ["right"]


@pytest.mark.parametrize(("version", "option"), [("1", "--stopped"), ("2", "--controller-manager")])
def test_help_is_that_of_the_generation_of_the_command(graph, monkeypatch, capsys, version, option):
    monkeypatch.setenv("ROS_VERSION", version)
    arguments = read_arguments(["--help"], "spawner")
    with pytest.raises(SystemExit) as ended:
        controller_spawner.run(arguments, graph, threading.Event())
    assert ended.value.code == 0
    assert option in capsys.readouterr().out


@pytest.mark.parametrize(
    ("run", "words", "phrase"),
    [
        (controller_spawner.run, [], "the following arguments are required: controller"),
        (controller_spawner.run, ["--stoped", "x"], "unrecognized arguments: --stoped"),
        (controller_spawner_ros2.run, ["x", "-p", "/no.yaml"], "No such file .*'/no.yaml'"),
        (controller_spawner.run_unspawner, [], "usage: unspawner controller"),
    ],
)
def test_wrong_words_are_explained(graph, run, words, phrase):
    with pytest.raises(LaunchError) as raised:
        run(read_arguments(words, "spawner", namespace="/"), graph, threading.Event())
    assert re.search(phrase, str(raised.value)), raised.value


def test_unreadable_controllers_name_the_file(graph, monkeypatch, tmp_path: Path):
    file = tmp_path / "bad.yaml"
    file.write_text("a: [1\n")
    arguments = read_arguments([str(file)], "spawner", namespace="/mira")
    with (
        manager_world(graph, monkeypatch),
        pytest.raises(LaunchError, match=f"cannot read controllers from '{file}'"),
    ):
        controller_spawner.run(arguments, graph, threading.Event())
