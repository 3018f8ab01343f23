"""A two-joint arm on ideal joints under a trajectory controller of either generation."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from tests.control.plant import PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordedGoal, RecordingPorts
from tests.control.trajectory_messages import duration

from gazelle.control.controllers.joint_trajectory_controller.ros1 import (
    Ros1JointTrajectoryController,
)
from gazelle.control.controllers.joint_trajectory_controller.ros2 import (
    Ros2JointTrajectoryController,
)
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import service_type

__all__ = ["ACTION", "JOINTS", "ROS2", "Bench"]

ACTION = "~/follow_joint_trajectory"
JOINTS = ("shoulder", "elbow")
ROS2 = "joint_trajectory_controller/JointTrajectoryController"
_MS = 1_000_000


class Bench:
    """A controller, started, with its plant and ports; time goes on by 1 ms.

    Attributes:
        commands: the commands of the robot after each step.
    """

    def __init__(
        self,
        type_name: str,
        parameters: Mapping[str, Any] | None = None,
        *,
        joints: Sequence[PlantJoint] = tuple(PlantJoint(name) for name in JOINTS),
        subscribed: bool = True,
        start: bool = True,
        ros_version: int | None = None,
    ) -> None:
        is_ros2 = type_name == ROS2
        cls = Ros2JointTrajectoryController if is_ros2 else Ros1JointTrajectoryController
        self.robot, self.plant = make_robot(
            joints, ros_version=ros_version or (2 if is_ros2 else 1)
        )
        self.diagnostics = Diagnostics()
        given: dict[str, Any] = {"joints": [joint.name for joint in joints]}
        if is_ros2:
            given |= {"command_interfaces": ["position"]}
            given |= {"state_interfaces": ["position", "velocity"]}
        self.controller, self.ports = make_controller(
            cls,
            self.robot,
            given | dict(parameters or {}),
            type_name=type_name,
            ports=RecordingPorts(subscribed=subscribed),
            diagnostics=self.diagnostics,
        )
        self.time_ns = 0
        self.commands: list[np.ndarray] = []
        if start:
            self.start()

    def start(self) -> None:
        """Start the controller."""
        self.robot.read(self.time_ns, _MS)
        self.controller.start(self.time_ns)

    def run(self, steps: int, after: Callable[[int], None] = lambda time_ns: None) -> None:
        """Go on for some ms; commands of each step are kept."""

        def keep(time_ns: int) -> None:
            self.commands.append(self.robot.interface_values.commands.copy())
            after(time_ns)

        self.time_ns = run(self.robot, self.controller, steps, time_ns=self.time_ns, after=keep)

    def send(self, request: Any, goal_id: str = "goal") -> RecordedGoal:
        """Send a goal."""
        return self.ports.send_goal(ACTION, request, goal_id)

    def commanded(self, interface: str = "position") -> np.ndarray:
        """Return the commands (T, N) of one interface."""
        places = self.robot.interface_values.command_indices(
            [f"{name}/{interface}" for name in self.robot.joints]
        )
        return np.array(self.commands)[:, places]

    def query(self, time_s: float) -> Any:
        """Ask what is wanted at a time."""
        service = service_type("control_msgs/QueryTrajectoryState")
        request = service.Request(time=duration(time_s, "builtin_interfaces/Time"))
        return self.ports.call("~/query_state", request, service.Response())
