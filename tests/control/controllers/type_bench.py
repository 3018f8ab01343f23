"""A controller made by its type's name, as a robot's parameters name it, on the plant."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from tests.control.plant import MS, PlantJoint, make_robot
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.simulator.intra_process_node import LocalParameters

__all__ = ["Scenario", "TypeBench"]


@dataclass(frozen=True)
class Scenario:
    """What a type is tried with.

    Attributes:
        type_name: as the parameters name it.
        law: plays the user, runs the bench and asserts what has to come out.
        parameters: of the controller, without its type.
        ros_version: 1 for ros_control, 2 for ros2_control.
        about: numbers that the law needs, such as where wheels are.
    """

    type_name: str
    law: Callable[[TypeBench, Any], None]
    parameters: Mapping[str, Any]
    joints: Sequence[PlantJoint] = ()
    ros_version: int = 1
    about: Any = None
    sensors: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    frames: Mapping[str, str] = field(default_factory=dict)
    model: Model | None = None

    @property
    def id(self) -> str:
        """Name of the test."""
        return f"{self.type_name}-ros{self.ros_version}"

    def check(self) -> None:
        """Make the controller, start it, and hold it to its law; nothing may be reported."""
        bench = TypeBench(self)
        self.law(bench, self.about)
        assert not list(bench.diagnostics)


class TypeBench:
    """A started controller of a controller manager; time goes on by 1 ms.

    Attributes:
        time_ns: of the next update.
        jammed: holds the joints where they are.
        trace: true positions (N,) after each step.
    """

    def __init__(self, scenario: Scenario) -> None:
        self.diagnostics, self.ports = Diagnostics(), RecordingPorts()
        self.robot, self.plant = make_robot(
            scenario.joints,
            ros_version=scenario.ros_version,
            sensors=scenario.sensors,
            sensor_frames=scenario.frames,
            model=scenario.model,
        )
        tree = {"type": scenario.type_name, **scenario.parameters}
        self.manager = ControllerManager(
            self.robot,
            namespace="/robot",
            make_ports=lambda name: self.ports,
            source=_source(scenario.ros_version, tree, self.diagnostics),
            diagnostics=self.diagnostics,
            update_rate_hz=1000.0,
        )
        self.record = self.manager.load("c")
        self.manager.configure("c")
        self.manager.switch(start=["c"])
        self.time_ns, self.jammed = 0, False
        self.trace: list[np.ndarray] = []

    def run(self, seconds: float, topic: str = "", message: Any = None) -> None:
        """Go on; a message is sent again before every update while it is given."""
        for _ in range(round(seconds * 1000)):
            if message is not None:
                self.ports.send(topic, message)
            self.manager.update(self.time_ns, MS)
            before = self.plant.position.copy()
            self.plant.step(0.001)
            if self.jammed:
                self.plant.position[:], self.plant.velocity[:] = before, 0.0
            self.time_ns += MS
            self.trace.append(self.plant.position.copy())

    def command(self, name: str) -> float:
        """The present command of an interface such as ``a/effort``."""
        return float(
            self.robot.interface_values.commands[self.robot.interface_values.command_index[name]]
        )

    def messages(self, topic: str) -> list[Any]:
        """What was published."""
        return self.ports.publishers[topic].messages


def _source(ros_version: int, tree: Mapping[str, Any], diagnostics: Diagnostics) -> Any:
    if ros_version == 2:
        return FileSource([], "/robot", diagnostics, overrides={"c": tree})
    store = LocalParameters()
    store.set("/robot", {"c": dict(tree)})
    return StoreSource(store, "/robot")
