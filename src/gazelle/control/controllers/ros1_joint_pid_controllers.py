"""ROS 1's JointPositionController with a PID: of effort_controllers and velocity_controllers."""

from __future__ import annotations

from typing import Any

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.joint_error import JointRange
from gazelle.control.controllers.pid_joint import (
    PID_PARAMETERS,
    PID_TOPICS,
    PidJointController,
)
from gazelle.control.table import ControllerTable
from gazelle.parameters import ParameterTable

__all__ = ["JointPositionController"]


class JointPositionController(PidJointController):
    """Holds one joint at a position by effort or velocity.

    Attributes:
        command: the position wanted, rad or m, as it came.
    """

    TABLE = ControllerTable(
        ParameterTable(
            "joint_position",
            "Holds one joint at a position: a PID of the position's error commands its effort or "
            "velocity.",
            (
                "effort_controllers/JointPositionController",
                "velocity_controllers/JointPositionController",
            ),
            PID_PARAMETERS,
        ),
        interfaces="claims effort or velocity of the joint, as its type says; reads"
        " position and velocity",
        topics=PID_TOPICS,
        behaviour=(
            "It begins where the joint is, and holds it there (joint_position_controller.cpp).",
            "Commands are kept within the limits of revolute and prismatic joints.",
            "Revolute joints take the shorter way round if it ends within their limits, continuous "
            "ones always (angles::shortest_angular_distance…).",
            "Once stopped it leaves its last command with the hardware.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up joint and gains."""
        super().__init__(context)
        joint = self._begin(context, context.type.partition("_")[0])
        self._range = JointRange.of(context, joint)

    def start(self, time_ns: int) -> None:
        """Hold the joint where it is."""
        self.command = self._range.clip(self.robot.bank.states.item(self._position_place))
        self.pid.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PID wants."""
        bank = self.robot.bank
        position = bank.states.item(self._position_place)
        command = self._range.clip(self.command)
        error = self._range.error(position, command)
        bank.commands[self._place] = self.pid.compute(error, period_ns * 1e-9)
        gains = self.pid.gains
        bank.answer(self._place, gains.p, gains.d)
        self._tell(time_ns, period_ns, process_value=position, error=error, command=command)

    def _fill(self, message: Any) -> None:
        message.process_value_dot = self.robot.bank.states.item(self._velocity_place)
