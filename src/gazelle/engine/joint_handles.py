"""Handles of joints: state, effort, motors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gazelle.description.model import Joint, JointAxis, JointType
from gazelle.engine.contact_readings import joint_reaction
from gazelle.engine.divergence import finite, within_bounds
from gazelle.engine.motors import MotorCommand
from gazelle.engine.state import Wrench
from gazelle.errors import EngineError

if TYPE_CHECKING:
    from gazelle.engine.engine import Engine
    from gazelle.engine.joint_group import JointGroup

__all__ = ["JointHandle"]

_WITHOUT_POSITION = {JointType.FIXED, JointType.BALL, JointType.GEARBOX}


class JointHandle:
    """A joint of a running world; stays valid while the joint exists, whatever is spawned.

    Position, velocity and effort are those of the first axis: rad, rad/s, N·m for turning
    joints, m, m/s, N for sliding ones. Joints without a single coordinate (fixed, ball,
    floating) read as 0 and cannot be driven.
    """

    __slots__ = (
        "_dof",
        "_element",
        "_engine",
        "_group",
        "_qpos",
        "_revision",
        "axis_index",
        "name",
    )

    def __init__(self, engine: Engine, name: str, axis_index: int = 0) -> None:
        self.name = name
        self.axis_index = axis_index
        self._engine = engine
        self._group: JointGroup | None = None
        self._revision = -1
        self._element, self._qpos, self._dof = name, -1, -1
        self._index()

    def __repr__(self) -> str:
        return f"JointHandle({self.name!r})"

    @property
    def joint(self) -> Joint:
        """The description."""
        return self._engine.description_of_joint(self.name)

    @property
    def type(self) -> JointType:
        """Its type."""
        return self.joint.type

    @property
    def axis(self) -> JointAxis:
        """The axis this handle drives, with its limits."""
        joint = self.joint
        return (joint.axis2 if self.axis_index else joint.axis) or JointAxis()

    @property
    def lower(self) -> float:
        """Lower position limit, −infinity for none."""
        return -math.inf if self.type is JointType.CONTINUOUS else self.axis.lower

    @property
    def upper(self) -> float:
        """Upper position limit, infinity for none."""
        return math.inf if self.type is JointType.CONTINUOUS else self.axis.upper

    @property
    def effort_limit(self) -> float:
        """Largest effort, infinity for none."""
        return self.axis.effort

    @property
    def velocity_limit(self) -> float:
        """Velocity limit, beyond which no effort drives the joint further; infinity for none."""
        return self.axis.velocity

    @property
    def is_driveable(self) -> bool:
        """Whether it has a coordinate in the engine: not fixed, ball, static or closing a loop."""
        return self._index() >= 0

    @property
    def position(self) -> float:
        """Position, not wrapped."""
        self._index()
        return float(self._engine.data.qpos[self._qpos]) if self._qpos >= 0 else 0.0

    @property
    def velocity(self) -> float:
        """Velocity."""
        dof = self._index()
        return float(self._engine.data.qvel[dof]) if dof >= 0 else 0.0

    @property
    def effort(self) -> float:
        """Effort applied: what `set_effort` asks for plus what the motor delivered last."""
        dof = self._index()
        if dof < 0:
            return 0.0
        applied = float(self._engine.data.qfrc_applied[dof])
        return applied + self._engine.motor_effort(self._element)

    def set_effort(self, effort: float) -> None:
        """Apply an effort until it is set again, at most the effort limit.

        Raises:
            EngineError: the joint has no coordinate, or the value is not finite.
        """
        dof = self._driven()
        self._engine.data.qfrc_applied[dof] = self._clamped(effort)

    def set_feedback(self, effort: float, stiffness: float, damping: float) -> None:
        """Apply the effort of a feedback that is computed at every step.

        On a joint that such efforts would shake it follows the motion within the step; see
        `JointGroup.set_feedback`.

        Args:
            effort: as computed from the position and velocity of now.
            stiffness: what it loses per position.
            damping: what it loses per velocity.
        """
        self._driven()
        group = self._own_group()
        period_s, one = self._engine.step_ns * 1e-9, np.ones(1)
        if group.is_light(stiffness * one, damping * one, period_s)[0]:
            rest = self._finite(effort) + damping * self.velocity
            slope = period_s * stiffness + damping
            bounds = (-math.inf * one, math.inf * one)
            group.set_feedback([0], rest * one, slope * one, *bounds)
            return
        held = self._engine.motors.commands.get(self._element)
        if held is not None and held.mode == "effort":
            group.end_feedback([0])
        self.set_effort(effort)

    def set_velocity_target(self, velocity: float, max_effort: float = math.inf) -> None:
        """Drive towards a velocity with at most an effort, as ODE's ``vel`` and ``fmax``.

        Args:
            velocity: rad/s or m/s.
            max_effort: largest effort; the joint's own limit applies as well, unless that is
                0, which stops efforts but not motors (as in Gazebo). 0 releases.
        """
        self._driven()
        limit = self.motor_limit(max_effort)
        command = MotorCommand("velocity", self._finite(velocity), limit)
        self._engine.release_lock(self._element)
        self._engine.command_motor(self._element, command)

    def set_position_target(
        self,
        position: float,
        max_effort: float = math.inf,
        *,
        max_velocity: float = math.inf,
    ) -> None:
        """Drive to a position and hold it there, stiffly, with at most an effort."""
        self._driven()
        limit = self.motor_limit(max_effort)
        command = MotorCommand("position", self._finite(position), limit, abs(max_velocity))
        self._engine.release_lock(self._element)
        self._engine.command_motor(self._element, command)

    def lock_position(self, position: float, *, steps: int = 1) -> None:
        """Hold a position whatever acts on the joint; see `JointGroup.lock_position`."""
        self._own_group().lock_position(np.array([self._finite(position)]), steps=steps)

    def release(self) -> None:
        """Stop motor, lock and effort: the joint moves freely."""
        dof = self._driven()
        self._engine.command_motor(self._element, None)
        self._engine.release_lock(self._element)
        self._engine.data.qfrc_applied[dof] = 0.0

    def set_state(self, position: float | None = None, velocity: float | None = None) -> None:
        """Put the joint to a position and velocity at once; a lock holds it there from now on."""
        dof = self._driven()
        if position is not None:
            wanted = within_bounds(position, f"joint '{self.name}'")
            self._engine.data.qpos[self._qpos] = wanted
            self._engine.locks.move(self._element, position)
        if velocity is not None:
            self._engine.data.qvel[dof] = self._finite(velocity)
        self._engine.state_changed()

    def reaction_wrench(self) -> Wrench:
        """Return what the parent exerts on the child through the joint in the last step.

        Force and torque are in the world frame, the torque about the joint's origin.
        """
        joint, engine = self.joint, self._engine
        child = engine.link(f"{self.name.partition('::')[0]}::{joint.child}")
        body = engine.body_id(child.name)
        data = engine.data_with_accelerations(body)
        T_model_link = child.link.T_model_link
        T_world_joint = child.T_world_link() @ T_model_link.inverse() @ joint.T_model_joint
        return joint_reaction(engine.model, data, body, np.asarray(T_world_joint.position_m))

    @property
    def element(self) -> str:
        """Name of the coordinate in the compiled world."""
        self._driven()
        return self._element

    def addresses(self) -> tuple[int, int]:
        """Return where its position and velocity are in MuJoCo's arrays.

        Raises:
            EngineError: the joint has no single coordinate.
        """
        dof = self._driven()
        return self._qpos, dof

    def motor_limit(self, max_effort: float) -> float:
        """Return the effort a motor gets: what is asked for, at most the joint's own limit."""
        own = self.effort_limit
        return min(abs(max_effort), own) if own > 0 else abs(max_effort)

    def _own_group(self) -> JointGroup:
        if self._group is None:
            self._group = self._engine.joint_group((self.name,))
        return self._group

    def _clamped(self, effort: float) -> float:
        limit = self.effort_limit
        return float(np.clip(self._finite(effort), -limit, limit))

    def _finite(self, value: float) -> float:
        return finite(value, f"joint '{self.name}'")

    def _driven(self) -> int:
        dof = self._index()
        if dof < 0:
            why = self.type.value if self.type in _WITHOUT_POSITION else "static or closes a loop"
            raise EngineError(f"joint '{self.name}' ({why}) has no single coordinate to drive")
        return dof

    def _index(self) -> int:
        if self._revision != self._engine.revision:
            element, qpos, dof = self._engine.joint_address(self.name, self.axis_index)
            self._element, self._qpos, self._dof = element, qpos, dof
            self._revision = self._engine.revision
        return self._dof
