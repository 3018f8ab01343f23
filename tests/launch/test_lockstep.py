"""Spawners of a lock-step launch come one after another, then time goes on."""

from __future__ import annotations

from pathlib import Path

from gazelle.diagnostics import Diagnostics
from gazelle.launch.config import NodeSpec
from gazelle.launch.executables import Executable, find_executable
from gazelle.launch.lockstep import HeldStart, holds_time
from gazelle.workspace import Workspace

Startable = tuple[NodeSpec, Executable]


def _node(package: str, type_name: str, name: str, args: str = "") -> Startable:
    workspace = Workspace.discover(environ={}, cwd=Path("/"))
    found = find_executable(package, type_name, workspace=workspace, diagnostics=Diagnostics())
    assert found is not None
    return NodeSpec(package, type_name, name, args=args), found


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
