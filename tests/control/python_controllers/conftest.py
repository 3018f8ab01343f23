"""A workspace with packages made for the test, and a manager that finds controllers in it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.resource_manager import JointResource, Robot
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.simulator.intra_process_node import LocalParameters
from gazelle.workspace import Workspace

PACKAGE = """\
<package format="2"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend></package>
"""


class Ports:
    """Topics are lists; what is logged is a list."""

    def __init__(self) -> None:
        self.sent: dict[str, list[Any]] = {}
        self.callbacks: dict[str, Callable[[Any], None]] = {}
        self.lines: list[tuple[str, str]] = []
        self.live: list[Any] = []

    def live_parameters(self, group: str, parameters: Any, on_change: Any) -> Any:
        self.live.append((group, parameters, on_change))

    def publisher(self, topic: str, type_name: str, **options: Any) -> Any:
        sent = self.sent.setdefault(topic, [])

        class Publisher:
            matched = True

            def publish(self, message: Any) -> None:
                sent.append(message)

        return Publisher()

    def subscription(self, topic: str, type_name: Any, callback: Callable[[Any], None]) -> None:
        self.callbacks[topic] = callback

    def log(self, level: str, text: str) -> None:
        self.lines.append((level, text))

    def offer_parameters(self, values: Mapping[str, Any], on_set: Any) -> None:
        """ROS 1 has none."""

    def close(self) -> None:
        """Nothing is open."""


class Bench:
    """A manager over two wheels, and the packages it looks into."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.store, self.ports, self.diagnostics = LocalParameters(), Ports(), Diagnostics()
        self.interface_values = InterfaceValues()
        interfaces = ("effort", "velocity")
        joints = [
            JointResource("joint_w1", interfaces, ("position", "velocity", "effort")),
            JointResource("joint_w2", interfaces, ("position", "velocity", "effort")),
            JointResource("slider", ("position",), ("position",)),
        ]
        for joint in joints:
            for name in joint.state_interfaces:
                self.interface_values.add_state(f"{joint.name}/{name}", 0.0)
            for name in joint.command_interfaces:
                self.interface_values.add_command(f"{joint.name}/{name}")
        self.interface_values.freeze()
        self.robot = Robot(
            1, Model("pr2"), self.interface_values, (), {one.name: one for one in joints}
        )

    def package(self, name: str, **files: str) -> Path:
        """Write a package; file names have ``__`` for ``/`` and no ending."""
        root = self.folder / name
        root.mkdir(parents=True)
        (root / "package.xml").write_text(PACKAGE.format(name=name))
        for key, text in files.items():
            path = root / f"{key.replace('__', '/')}.py"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(dedent(text))
        return root

    def manager(self) -> ControllerManager:
        """Return a manager that knows the packages written so far."""
        return ControllerManager(
            self.robot,
            namespace="/",
            make_ports=lambda name: self.ports,  # type: ignore[arg-type,return-value]
            source=StoreSource(self.store, "/"),
            diagnostics=self.diagnostics,
            update_rate_hz=1000.0,
            workspace=Workspace.discover(environ={"ROS_PACKAGE_PATH": str(self.folder)}),
        )

    def run(self, type_name: str, **parameters: Any) -> ControllerManager:
        """Load and start a controller called ``mine``."""
        self.store.set("/mine", {"type": type_name, **parameters})
        manager = self.manager()
        manager.load("mine")
        manager.switch(start=["mine"])
        return manager

    def state(self, name: str, value: float) -> None:
        """Let the hardware measure something."""
        self.interface_values.states[self.interface_values.state_index[name]] = value

    def command(self, name: str) -> float:
        """Return what is commanded."""
        return float(self.interface_values.commands[self.interface_values.command_index[name]])


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    """An empty workspace and a robot."""
    return Bench(tmp_path / "src")
