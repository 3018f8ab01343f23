"""Nodes, packages and files of parameters that are not there: what is told, and what goes on."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.launch.ros2 import actions as launch
from gazelle.launch.ros2.launch_ros import actions as a
from gazelle.nodes.arguments import ABSENT_NODES

Run = Callable[..., Any]


def _show(**options: Any) -> a.Node:
    return a.Node(package="demo", executable="show", output="screen", **options)


def _started(ran: Any) -> int:
    return ran.text.count("] words: ")


def test_a_file_of_parameters_that_is_not_there_is_told(run: Run, package: Path) -> None:
    (package / "driver.yaml").write_text("")
    ran = run(_show(parameters=[str(package / "drivers.yaml")]))
    (found,) = ran.context.diagnostics
    assert (ran.code, found.code) == (0, "ros2_launch.parameter-file")
    assert str(found.severity) == "warning"
    assert found.fix == "did you mean 'driver.yaml'?"
    assert found.span is not None and found.span.file == __file__
    assert "[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: " in ran.text


def test_nodes_that_do_not_come_are_told_to_the_others(run: Run, package: Path) -> None:
    seen: list[str] = []
    look = launch.OpaqueFunction(function=lambda _: seen.append(os.environ[ABSENT_NODES]))
    absent = [
        a.Node(package="nav2_route", executable="route_server", name="route"),
        a.Node(package="demo", executable="compiled", name="own", namespace="r1"),
        a.Node(package="usb_cam", executable="usb_cam_node"),
    ]
    assert run(*absent, look).code == 0
    assert seen == ["/route /r1/own"]


@pytest.mark.parametrize(
    ("package_name", "what"),
    [
        ("usb_cam", "the driver of a real camera"),
        ("rosbridge_server", "rosbridge_server is a bridge to programs outside of ROS"),
        ("rqt_xyz", "rqt_xyz is a panel of rqt"),
        ("rqt_controller_manager", "`ros2 control list_controllers`, `switch_controllers`"),
        ("nav2_minimal_tb3_sim", "put its folder into the workspace's src"),
        ("some_robot", "put the package's sources into the workspace's src"),
    ],
)
def test_packages_of_ros_that_are_not_here_are_explained(
    run: Run, package: Path, package_name: str, what: str
) -> None:
    ran = run(a.Node(package=package_name, executable="node"), _show())
    (found,) = ran.context.diagnostics.errors
    goes_on = "the others go on" in found.message
    assert (ran.code, _started(ran)) == ((0, 1) if goes_on else (1, 0))
    assert goes_on is (package_name != "some_robot")
    assert found.code == "ros2_launch.package-missing"
    assert what in found.fix
