"""Commands of all motors, and writing them into MuJoCo's state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.motors import TIGHT, UNLIMITED_EFFORT, MotorCommand, clutch_impedance
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import rotor_joint, tendon

__all__ = ["POSITION_STEPS", "MotorBank"]

POSITION_STEPS = 10
"""Position motors are steered again after at most so many steps."""

_CLOSE_ENOUGH = 1e-6
"""A position motor this near its target, rad or m, stands still, so that a robot can sleep."""


_SOFTEST = 9000.0
"""Largest slope · step / inertia of a clutch, where its impedance is nearly 1."""


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


@dataclass(slots=True)
class MotorBank:
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
