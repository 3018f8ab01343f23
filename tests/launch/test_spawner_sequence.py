"""Spawners of a lock-step launch come one after another, then time goes on."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.launch.launch_config import NodeTag
from gazelle.launch.node_commands import Executable, find_executable
from gazelle.launch.spawner_sequence import HeldStart, holds_time, starts_in_turn
from gazelle.workspace import Workspace

Startable = tuple[NodeTag, Executable]


def _node(package: str, type_name: str, name: str, args: str = "") -> Startable:
    workspace = Workspace.discover(environ={}, cwd=Path("/"))
    found = find_executable(package, type_name, workspace=workspace, diagnostics=Diagnostics())
    assert found is not None
    return NodeTag(package, type_name, name, args=args), found


def _world(args: str = "") -> Startable:
    return _node("gazebo_ros", "gzserver", "gazebo", args)


def _spawner(name: str, args: str = "-urdf -param robot_description -model r") -> Startable:
    return _node("gazebo_ros", "spawn_model", name, args)


def test_time_is_held_for_spawners_unless_a_file_asks_for_a_pause() -> None:
    assert holds_time([_world(), _spawner("one")])
    assert not holds_time([_world(), _node("rviz", "rviz", "rviz")])
    assert not holds_time([_world("-u worlds/empty.world"), _spawner("one")])
    assert not holds_time([_spawner("one")])
    assert not holds_time([_world(), _spawner("stays", "-urdf -param p -model r -b")])


def test_spawners_start_in_turn_and_time_is_released_after_the_last() -> None:
    told: list[str] = []
    nodes = [_spawner("one"), _world(), _spawner("two")]
    held = HeldStart(
        nodes,
        start=lambda spec, executable: told.append(spec.name),
        release=lambda: told.append("released"),
    )
    assert [spec.name for spec, _ in HeldStart.others(nodes)] == ["gazebo"]
    held.begin()
    assert told == ["one"]
    held.ended(nodes[1][0])
    assert told == ["one"]
    held.ended(nodes[0][0])
    assert told == ["one", "two"]
    held.ended(nodes[2][0])
    assert told == ["one", "two", "released"]


def _controllers(type_name: str, name: str, args: str = "roll") -> Startable:
    return _node("controller_manager", type_name, name, args)


def test_controllers_start_after_the_models_and_time_goes_on_when_they_are_ready() -> None:
    told: list[str] = []
    nodes = [
        _controllers("spawner", "ros1_stays"),
        _world(),
        _spawner("model"),
        _controllers("spawner.py", "ros2_ends"),
        _controllers("controller_manager", "command", "spawn pitch"),
    ]
    held = HeldStart(
        nodes,
        start=lambda spec, executable: told.append(spec.name),
        release=lambda: told.append("released"),
    )
    assert [spec.name for spec, _ in HeldStart.others(nodes)] == ["gazebo"]
    held.begin()
    held.ended(nodes[2][0])
    assert told == ["model", "ros1_stays"]
    held.ready(nodes[0][0])
    assert told[-1] == "ros2_ends"
    held.ready(nodes[0][0])
    held.ended(nodes[3][0])
    held.ended(nodes[4][0])
    assert told[2:] == ["ros2_ends", "command", "released"]


def test_controllers_alone_hold_time_and_come_in_turn_while_a_file_pauses() -> None:
    nodes = [_world(), _controllers("spawner", "one")]
    assert holds_time(nodes)
    paused = [_world("-u"), _controllers("spawner", "one")]
    assert starts_in_turn(paused)
    assert not holds_time(paused)


def test_a_spawner_in_a_process_of_its_own_cannot_say_that_it_is_ready() -> None:
    spec, executable = _controllers("spawner", "one")
    alone = (replace(spec, launch_prefix="nice"), executable)
    assert not holds_time([_world(), alone])
    assert HeldStart.others([alone]) == [alone]
