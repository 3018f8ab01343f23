"""Velocity motors with a torque limit, as ODE's joint motors are.

ODE solves a motor as one more constraint: reach this velocity with at most this torque. MuJoCo
has exactly one constraint with a bounded force, dry friction, and it brakes towards rest. So a
motor is built as a flywheel that turns at the wanted speed and a clutch (a fixed tendon with
dry friction) between flywheel and joint: the clutch brakes the difference of both speeds to
zero with at most the wanted torque. It cannot overshoot, whatever the joint's inertia, and costs
nothing while released (no friction, no constraint). A soft clutch is a damper with a limit: it
gives the torque ``effort − slope · speed`` with the speed at the end of the step. The clutch
pushes the joint's own coordinate, so the parent link feels the reaction; the flywheel is
weightless in effect and touches nothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import rotor_body, rotor_joint, tendon

__all__ = [
    "TIGHT",
    "UNLIMITED_EFFORT",
    "MotorCommand",
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
