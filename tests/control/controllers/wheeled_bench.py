"""A wheeled base on the plant: its controller, started, and what it published."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from tests.control.plant import MS, Plant, PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controllers.controller import Controller
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type

__all__ = ["WheeledBench", "rolling", "stamped", "steered", "twist"]


def twist(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Any:
    """A geometry_msgs/Twist."""
    message = message_type("geometry_msgs/Twist")()
    message.linear.x, message.linear.y, message.angular.z = x, y, z
    return message


def stamped(time_ns: int, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Any:
    """A geometry_msgs/TwistStamped."""
    message = message_type("geometry_msgs/TwistStamped")(twist=twist(x, y, z))
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(time_ns, 1_000_000_000)
    return message


def rolling(*names: str) -> list[PlantJoint]:
    """Joints with a velocity interface."""
    return [PlantJoint(name, commands=("velocity",)) for name in names]


def steered(*names: str) -> list[PlantJoint]:
    """Joints with a position interface."""
    return [PlantJoint(name, commands=("position",)) for name in names]


class WheeledBench:
    """A started controller over ideal joints.

    Attributes:
        time_ns: of the next update.
        twists: after each step, what the commands said: a copy of the robot's.
    """

    def __init__(
        self,
        cls: type[Controller],
        joints: Sequence[PlantJoint],
        parameters: Mapping[str, Any],
        *,
        ros_version: int = 1,
        model: Model | None = None,
        period_ns: int = MS,
        subscribed: bool = True,
    ) -> None:
        self.diagnostics = Diagnostics()
        self.robot, plant = make_robot(joints, ros_version=ros_version, model=model)
        self.plant: Plant = plant
        self.period_ns = period_ns
        self.controller, self.ports = make_controller(
            cls,
            self.robot,
            parameters,
            ports=RecordingPorts(subscribed=subscribed),
            diagnostics=self.diagnostics,
        )
        self.time_ns = 0
        self.commands: list[list[float]] = []
        self.controller.start(0)

    def run(self, seconds: float, topic: str = "", message: Any = None) -> None:
        """Go on; a message is sent again before every update while it is given."""
        for _ in range(round(seconds * 1e9 / self.period_ns)):
            if message is not None:
                self.ports.send(topic, message)
            self.time_ns = run(
                self.robot, self.controller, 1, period_ns=self.period_ns, time_ns=self.time_ns
            )
            self.commands.append(self.robot.interface_values.commands.tolist())

    def command(self, name: str) -> float:
        """The present command of an interface."""
        interface_values = self.robot.interface_values
        return float(interface_values.commands[interface_values.command_index[name]])

    def last(self, topic: str) -> Any:
        """The message published last."""
        return self.ports.publishers[topic].last

    def pose(self, topic: str = "~/odom") -> tuple[float, float, float]:
        """x, y and the quaternion's z of the odometry published last."""
        pose = self.last(topic).pose.pose
        return pose.position.x, pose.position.y, pose.orientation.z
