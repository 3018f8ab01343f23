"""Velocity motors with a torque limit, as ODE's joint motors are.

ODE solves a motor as one more constraint: reach this velocity with at most this torque. MuJoCo
has exactly one constraint with a bounded force, dry friction, and it brakes towards rest. So a
motor is built as a flywheel that turns at the wanted speed and a clutch (a fixed tendon with
dry friction) between flywheel and joint: the clutch brakes the difference of both speeds to
zero with at most the wanted torque. It cannot overshoot, whatever the joint's inertia, and costs
nothing while released (no friction, no constraint). A soft clutch is a damper with a limit: it
gives the torque ``effort − slope · speed`` with the speed at the end of the step. The clutch
pushes the joint's own coordinate, so the parent link feels the reaction; the flywheel is
weightless in effect and touches nothing. `Motors` keeps what every motor was asked for and
writes it into MuJoCo's state.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import rotor_body, rotor_joint, tendon

__all__ = [
    "POSITION_STEPS",
    "TIGHT",
    "UNLIMITED_EFFORT",
    "MotorCommand",
    "Motors",
    "add_motor",
    "clutch_impedance",
    "flywheel_inertia",
]


UNLIMITED_EFFORT = 1e9
"""Stands for an infinite torque limit, N·m or N."""


TIGHT = 0.9999
"""Impedance of a clutch that hardly slips, the largest there is."""


_MIN_FLYWHEEL = 1e5
_FLYWHEEL_RATIO = 1e6


POSITION_STEPS = 10
"""Position motors are steered again after at most so many steps."""


_CLOSE_ENOUGH = 1e-6
"""A position motor this near its target, rad or m, stands still, so that a robot can sleep."""


_SOFTEST = 9000.0
"""Largest slope · step / inertia of a clutch, where its impedance is nearly 1."""


@dataclass(frozen=True, slots=True)
class MotorCommand:
    """What a motor is asked for.

    Attributes:
        mode: ``velocity``, ``position`` or ``effort``.
        target: rad/s, m/s, rad or m; of ``effort``, the effort on a joint at rest.
        max_effort: torque or force limit.
        max_velocity: speed limit on the way to a position.
        slope: what an ``effort`` loses per speed at the end of the step, N·m·s/rad or N·s/m.
    """

    mode: str
    target: float
    max_effort: float
    max_velocity: float = float("inf")
    slope: float = float("inf")


def add_motor(spec: Any, joint: str, step_s: float) -> None:
    """Add flywheel and clutch for a joint; they stay idle until commanded."""
    body = spec.worldbody.add_body(name=rotor_body(joint))
    body.explicitinertial = True
    body.mass = 1.0
    body.inertia = [1.0, 1.0, 1.0]
    body.gravcomp = 1.0
    body.sleep = mujoco.mjtSleepPolicy.mjSLEEP_ALLOWED
    body.add_joint(
        name=rotor_joint(joint),
        type=mujoco.mjtJoint.mjJNT_HINGE,
        axis=[0.0, 0.0, 1.0],
        armature=_MIN_FLYWHEEL,
    )
    clutch = spec.add_tendon(name=tendon(joint))
    clutch.wrap_joint(joint, 1.0)
    clutch.wrap_joint(rotor_joint(joint), -1.0)
    clutch.solref_friction = [2.0 * step_s, 1.0]
    clutch.solimp_friction = [TIGHT, TIGHT, 0.001, 0.5, 2.0]


def flywheel_inertia(joint_inertia: float) -> float:
    """Return a flywheel's inertia: so large that a load cannot slow it."""
    return max(_MIN_FLYWHEEL, _FLYWHEEL_RATIO * joint_inertia)


def clutch_impedance(slope: float, inverse_inertia: float, step_s: float) -> float:
    """Return the impedance with which a clutch brakes with a torque of slope · speed.

    MuJoCo's dry friction has the torque −(v / h) / R below its limit, with R = (1 − d) / (d I) for
    the impedance d: a damper of 1/(h R).
    """
    share = slope * step_s * inverse_inertia
    return min(share / (1.0 + share), TIGHT) if math.isfinite(share) else TIGHT


@dataclass(slots=True)
class Motors:
    """All motors: which joints have one, and what it is asked for.

    Attributes:
        commands: by joint; survives recompiles.
        installed: joints with a motor, in the order of their first command.
        changes: grows with every command, so that others see when theirs may be gone.
    """

    commands: dict[str, MotorCommand] = field(default_factory=dict)
    installed: list[str] = field(default_factory=list)
    changes: int = 0
    _slots: dict[str, _Slot] = field(default_factory=dict)
    _changed: bool = False

    @property
    def has_positions(self) -> bool:
        """Whether a motor holds a position."""
        return any(command.mode == "position" for command in self.commands.values())

    def command(self, joint: str, command: MotorCommand | None) -> bool:
        """Set or release a motor; returns whether the joint needs one built first."""
        self._changed = True
        self.changes += 1
        if command is None or command.max_effort <= 0:
            self.commands.pop(joint, None)
            return False
        self.commands[joint] = command
        if joint in self.installed:
            return False
        self.installed.append(joint)
        return True

    def steer(self, joint: str, command: MotorCommand) -> bool:
        """Set a motor like `command`, at every step: nobody else looks at what it is told."""
        if joint not in self.commands or command.max_effort <= 0:
            return self.command(joint, command)
        self.commands[joint] = command
        return False

    def release(self) -> None:
        """End all commands; the motors stay installed."""
        self.commands.clear()
        self.changes += 1

    def forget(self, prefix: str) -> None:
        """Drop the motors of a deleted model."""
        self.installed = [name for name in self.installed if not name.startswith(prefix)]
        for name in [name for name in self.commands if name.startswith(prefix)]:
            del self.commands[name]

    def bind(self, model: Any, joints: Sequence[str]) -> None:
        """Find the motors of joints in a newly compiled model."""
        self._slots = {}
        for joint in joints:
            index = model.joint(joint).id
            dof = int(model.jnt_dofadr[index])
            rotor = int(model.jnt_dofadr[model.joint(rotor_joint(joint)).id])
            self._slots[joint] = _Slot(
                dof,
                int(model.jnt_qposadr[index]),
                rotor,
                place := int(model.tendon(tendon(joint)).id),
                model.opt.sleep_tolerance / float(model.dof_length[[dof, rotor]].max()),
                max(float(model.tendon_invweight0[place]), 1e-12),
                float(model.tendon_solimp_fri[place, 0]),
            )
        self._changed = True

    def tendons(self, joints: Sequence[str]) -> NDArray[np.intp] | None:
        """Return the clutch of each joint, (joints,), −1 for none; None when none has one."""
        found = [self._slots[joint].tendon if joint in self._slots else -1 for joint in joints]
        return np.array(found, dtype=np.intp) if max(found, default=-1) >= 0 else None

    def drive(self, model: Any, data: Any, step_s: float, steps: int) -> None:
        """Write flywheel speeds and clutch torques for the next steps."""
        if not self._slots:
            return
        # Every look at one of MuJoCo's arrays makes a new view of it.
        speeds, limits = data.qvel, model.tendon_frictionloss
        for joint, slot in self._slots.items():
            command = self.commands.get(joint)
            if command is None:
                if self._changed:
                    self._release(model, data, slot)
                continue
            speed = command.target
            if command.slope * step_s * slot.weight > _SOFTEST and command.mode == "effort":
                _weigh_down(model, slot, command.slope * step_s / _SOFTEST)
            impedance = clutch_impedance(command.slope, slot.weight, step_s)
            if impedance != slot.impedance:
                _soften(model, slot, impedance, step_s)
            if command.mode == "effort":
                speed *= step_s * slot.weight * (1.0 - impedance) / impedance
            if command.mode == "position":
                gap = command.target - float(data.qpos[slot.qpos])
                speed = 0.0 if abs(gap) < _CLOSE_ENOUGH else gap / (max(steps, 2) * step_s)
                speed = min(max(speed, -command.max_velocity), command.max_velocity)
            is_creep = abs(speed) < slot.creep and speeds[slot.dof] == 0
            if speeds[slot.rotor] != speed and not is_creep:
                speeds[slot.rotor] = speed
            limit = min(command.max_effort, UNLIMITED_EFFORT)
            if limits[slot.tendon] != limit:
                limits[slot.tendon] = limit
                _wake(data, slot)
        self._changed = False

    def effort(self, joint: str, data: Any) -> float:
        """Return what a motor delivered in the last step."""
        slot = self._slots.get(joint)
        if slot is None or joint not in self.commands:
            return 0.0
        kind = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_TENDON)
        rows = np.flatnonzero((data.efc_type == kind) & (data.efc_id == slot.tendon))
        return float(data.efc_force[rows[0]]) if len(rows) else 0.0

    @staticmethod
    def _release(model: Any, data: Any, slot: _Slot) -> None:
        if model.tendon_frictionloss[slot.tendon] != 0:
            model.tendon_frictionloss[slot.tendon] = 0.0
            data.qvel[slot.rotor] = 0.0
            _wake(data, slot)


@dataclass(slots=True)
class _Slot:
    dof: int
    qpos: int
    rotor: int
    tendon: int
    creep: float
    """Speeds below it let a robot fall asleep again at once: they do not wake one."""
    weight: float
    """Inverse inertia that the clutch sees."""
    impedance: float = TIGHT


def _weigh_down(model: Any, slot: _Slot, inertia: float) -> None:
    """Give a joint the least inertia with which a clutch of the wanted slope can be solved."""
    model.dof_armature[slot.dof] += inertia - 1.0 / slot.weight
    slot.weight = 1.0 / inertia
    model.tendon_invweight0[slot.tendon] = slot.weight
    model.dof_invweight0[slot.dof] = min(float(model.dof_invweight0[slot.dof]), slot.weight)


def _soften(model: Any, slot: _Slot, impedance: float, step_s: float) -> None:
    """Change how much a clutch slips; its damping stays 1/h."""
    slot.impedance = impedance
    model.tendon_solimp_fri[slot.tendon, :2] = impedance
    model.tendon_solref_fri[slot.tendon, 0] = 2.0 * step_s * (TIGHT / impedance)


def _wake(data: Any, slot: _Slot) -> None:
    """Wake a sleeping tree: MuJoCo looks for bytes that are not 0, minus zero is one."""
    if data.qvel[slot.dof] == 0:
        data.qvel[slot.dof] = -0.0
