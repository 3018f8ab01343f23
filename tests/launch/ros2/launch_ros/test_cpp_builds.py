"""C++ nodes of a launch of ROS 2: compiled together, before anything starts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.launch.fake_build import FakeBuild

from gazelle.launch.ros2 import launch_ros
from gazelle.launch.ros2.actions import (
    OpaqueFunction,
    RegisterEventHandler,
    Shutdown,
    TimerAction,
)
from gazelle.launch.ros2.event_handlers import OnProcessStart

Run = Callable[..., Any]


@pytest.fixture
def build(package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> FakeBuild:
    """Stands in for the compiler; package ``demo`` has programs one, two, bad."""
    lists = "".join(f"add_executable({name} {name}.cpp)\n" for name in ("one", "two", "bad"))
    (package / "CMakeLists.txt").write_text(lists, encoding="utf-8")
    return FakeBuild.instead_of_compiling(tmp_path, monkeypatch)


def _node(executable: str, **more: Any) -> Any:
    return launch_ros.actions.Node(package="demo", executable=executable, output="screen", **more)


def _note(build: FakeBuild) -> OpaqueFunction:
    return OpaqueFunction(function=lambda _context: build.log.append("start"))


def _said(ran: Any) -> list[str]:
    """Return what nodes wrote, without the names of their processes."""
    return sorted(line.partition("] ")[2] for line in ran.lines if " runs: " in line)


def test_nodes_that_a_launch_comes_to_at_once_are_compiled_at_once(
    run: Run, build: FakeBuild
) -> None:
    ran = run(_node("one", name="first"), _node("show"), _node("two"), _node("one"))
    assert ran.code == 0
    assert build.batches == [["one", "two"]]
    assert _said(ran) == [
        "one runs: --ros-args",
        "one runs: --ros-args -r __node:=first",
        "two runs: --ros-args",
    ]


def test_nothing_starts_before_all_is_compiled(run: Run, build: FakeBuild) -> None:
    script = _node("show")
    started = OnProcessStart(
        target_action=script,
        on_start=lambda _event, _context: [_note(build)],
    )
    ran = run(RegisterEventHandler(started), script, _node("one"))
    assert ran.code == 0
    assert build.log == ["compile one", "start"]


def test_later_nodes_are_compiled_when_their_turn_comes(run: Run, build: FakeBuild) -> None:
    ran = run(_node("one"), TimerAction(period=0.01, actions=[_node("two")]))
    assert ran.code == 0
    assert build.batches == [["one"], ["two"]]
    assert _said(ran) == ["one runs: --ros-args", "two runs: --ros-args"]


def test_launch_goes_on_without_a_node_that_does_not_compile(run: Run, build: FakeBuild) -> None:
    bad = _node("bad", name="lost", namespace="r1")
    ran = run(bad, _node("one"))
    assert ran.code == 0 and bad.is_absent
    (error,) = ran.context.diagnostics.errors
    assert error.message == "'bad' of package 'demo' does not compile"
    assert "it does not compile; the others go on" in ran.text
    assert _said(ran) == ["one runs: --ros-args"]


def test_components_are_compiled_before_their_container_starts(
    run: Run, build: FakeBuild, package: Path
) -> None:
    lists = package / "CMakeLists.txt"
    text = lists.read_text(encoding="utf-8")
    lists.write_text(text + 'rclcpp_components_register_nodes(one "demo::One")\n', encoding="utf-8")
    container = launch_ros.actions.ComposableNodeContainer(
        package="demo",
        executable="show",
        name="box",
        namespace="",
        composable_node_descriptions=[
            launch_ros.descriptions.ComposableNode(package="demo", plugin="demo::One")
        ],
    )
    started = OnProcessStart(
        target_action=container,
        on_start=lambda _event, _context: [_note(build), Shutdown()],
    )
    run(RegisterEventHandler(started), container)
    assert build.batches == [[""]], "an empty name is all of a package"
    assert build.log == ["compile ", "start"]


def test_prefix_stays_before_the_command(run: Run, build: FakeBuild) -> None:
    ran = run(_node("one", prefix="env NOTHING=1"))
    assert ran.code == 0
    assert _said(ran) == ["one runs: --ros-args"]
