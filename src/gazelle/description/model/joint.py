"""Joints."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from gazelle.description.model.sensor import Sensor
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["Joint", "JointAxis", "JointType", "Mimic", "SafetyController"]

INFINITE = float("inf")


class JointType(Enum):
    """URDF's and SDF's joint types under one set of names."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
    FIXED = "fixed"
    FLOATING = "floating"
    PLANAR = "planar"
    BALL = "ball"
    UNIVERSAL = "universal"
    SCREW = "screw"
    REVOLUTE2 = "revolute2"
    GEARBOX = "gearbox"

    @property
    def is_hinge(self) -> bool:
        """True for joints that turn about one axis, with limits or without."""
        return self in (JointType.REVOLUTE, JointType.CONTINUOUS)


@dataclass(frozen=True, slots=True)
class JointAxis:
    """One axis: units are rad and N·m for turning joints, m and N for sliding ones.

    Attributes:
        xyz: unit vector in the joint's frame.
        effort: effort limit; infinite when the file gives none or a negative one.
        velocity: velocity limit; in the engine efforts end there, as in Gazebo.
        damping: N·m·s/rad or N·s/m.
        friction: Coulomb friction, N·m or N.
        position: initial position.
        span: where it is written.
    """

    xyz: tuple[float, float, float] = (0.0, 0.0, 1.0)
    lower: float = -INFINITE
    upper: float = INFINITE
    effort: float = INFINITE
    velocity: float = INFINITE
    damping: float = 0.0
    friction: float = 0.0
    spring_stiffness: float = 0.0
    spring_reference: float = 0.0
    position: float = 0.0
    span: SourceSpan | None = field(default=None, compare=False)


@dataclass(frozen=True, slots=True)
class Mimic:
    """``position = multiplier · position(joint) + offset``."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class SafetyController:
    """URDF ``<safety_controller>``."""

    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0
    k_position: float = 0.0
    k_velocity: float = 0.0


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint between two links.

    Attributes:
        parent: link name within the model, ``world`` for the world.
        child: link name within the model.
        T_model_joint: the joint's frame in the model's frame with all joints at zero.
        axis: first axis; None for fixed, ball and floating joints.
        axis2: second axis of universal, revolute2 and gearbox joints.
        thread_pitch_rad_m: radians per metre of a screw joint (SDF 1.10 ``screw_thread_pitch``
            and ``thread_pitch`` are converted to it).
        gearbox_ratio, gearbox_reference_body: of a gearbox joint.
        cfm, erp, limit_cfm, limit_erp: ODE's joint softness, None for the default.
        implicit_spring_damper: ODE ``implicit_spring_damper`` / ``cfm_damping``.
        provide_feedback: forces on the joint are measured.
        disable_fixed_joint_lumping: ``preserveFixedJoint`` and its kin.
        calibration_rising, calibration_falling: URDF ``<calibration>``.
    """

    name: str
    type: JointType
    parent: str
    child: str
    T_model_joint: Pose = IDENTITY_POSE
    axis: JointAxis | None = None
    axis2: JointAxis | None = None
    mimic: Mimic | None = None
    safety: SafetyController | None = None
    sensors: tuple[Sensor, ...] = ()
    thread_pitch_rad_m: float = 1.0
    gearbox_ratio: float = 1.0
    gearbox_reference_body: str = ""
    cfm: float | None = None
    erp: float | None = None
    limit_cfm: float | None = None
    limit_erp: float | None = None
    implicit_spring_damper: bool = False
    provide_feedback: bool = False
    disable_fixed_joint_lumping: bool = False
    calibration_rising: float | None = None
    calibration_falling: float | None = None
    span: SourceSpan | None = None
