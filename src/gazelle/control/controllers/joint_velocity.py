"""ROS 1's effort_controllers/JointVelocityController."""

from __future__ import annotations

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.pid_joint import (
    PID_PARAMETERS,
    PID_TOPICS,
    PidJointController,
)
from gazelle.control.table import ControllerTable
from gazelle.parameters import ParameterTable

__all__ = ["JointVelocityController"]


class JointVelocityController(PidJointController):
    """Turns one joint at a velocity by effort.

    Attributes:
        command: the velocity wanted, rad/s or m/s.
    """

    TABLE = ControllerTable(
        ParameterTable(
            "joint_velocity",
            "Moves one joint at a velocity: a PID of the velocity's error commands its effort.",
            ("effort_controllers/JointVelocityController",),
            PID_PARAMETERS,
        ),
        interfaces="claims effort of the joint; reads position and velocity",
        topics=PID_TOPICS,
        behaviour=(
            "It begins with velocity 0 (joint_velocity_controller.cpp).",
            "Once stopped it leaves its last effort with the hardware.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up joint and gains."""
        super().__init__(context)
        self._begin(context, "effort")

    def start(self, time_ns: int) -> None:
        """Begin with velocity 0."""
        self.command = 0.0
        self.pid.reset()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Command what the PID wants."""
        bank = self.robot.bank
        velocity = bank.states.item(self._velocity_place)
        error = self.command - velocity
        bank.commands[self._place] = self.pid.compute(error, period_ns * 1e-9)
        bank.answer(self._place, 0.0, self.pid.gains.p)
        self._tell(time_ns, period_ns, process_value=velocity, error=error, command=self.command)
