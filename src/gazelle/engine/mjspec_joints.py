"""Joints of the description as joints and equality constraints of MuJoCo."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, JointAxis, JointType
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import joint_part, root_joint, scoped
from gazelle.geometry import Pose, Vector3

__all__ = [
    "INFINITE_LIMIT",
    "add_joint",
    "add_mimic",
    "add_root_joint",
    "couple",
    "equality_solver",
    "has_parallel_axes",
    "implicit_damping",
    "is_single_axis",
    "keeps_turning",
]

INFINITE_LIMIT = 1e10
"""Limits beyond this mean none (SDF writes 1e16)."""

Value = TypeVar("Value", float, NDArray[np.float64])

_PARALLEL = 1e-2
"""Axes that enclose less, rad, are one: the joint's inertia would be singular."""

_DOUBLE = (JointType.UNIVERSAL, JointType.REVOLUTE2)
_SINGLE = {JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC, JointType.SCREW}


def implicit_damping(damping: Value, step_s: float) -> Value:
    """Return the armature that makes damping act on the speed at the end of a step.

    (M + h D) a = τ − D v is the implicit step. MuJoCo's own implicit integrators divide by h D
    only after the constraints are solved, so that motors and mimics of light, damped joints would
    lag; as an armature the constraints see it.
    """
    return step_s * damping


def has_parallel_axes(joint: Joint) -> bool:
    """Whether a joint of two axes has but one: what they do against each other moves nothing."""
    if joint.type not in _DOUBLE:
        return False
    first, second = (joint.axis or JointAxis()).xyz, _second_axis(joint).xyz
    return float(np.linalg.norm(np.cross(first, second))) < _PARALLEL


def keeps_turning(joint: Joint) -> bool:
    """Whether a joint turns about several axes, so that gyroscopic torques act on its child."""
    return joint.type in _DOUBLE or joint.type in (JointType.BALL, JointType.FLOATING)


def _second_axis(joint: Joint) -> JointAxis:
    return joint.axis2 or JointAxis((1.0, 0.0, 0.0))


def is_single_axis(joint: Joint) -> bool:
    """Whether one number describes the joint's position."""
    return joint.type in _SINGLE


def add_root_joint(body: Any, link: str) -> None:
    """Let a root link float: a free joint whose frame is the link's own."""
    joint = body.add_freejoint(name=root_joint(link))
    joint.align = mujoco.mjtAlignFree.mjALIGNFREE_FALSE


def add_joint(
    spec: Any, body: Any, joint: Joint, model: str, T_link_joint: Pose, step_s: float
) -> None:
    """Add the degrees of freedom of a joint to its child's body."""
    name = scoped(model, joint.name)
    axis = joint.axis or JointAxis()
    add = _Adder(body, T_link_joint, step_s)
    match joint.type:
        case JointType.REVOLUTE | JointType.CONTINUOUS:
            add.hinge(name, axis, unlimited=joint.type is JointType.CONTINUOUS)
        case JointType.PRISMATIC:
            add.slide(name, axis)
        case JointType.UNIVERSAL | JointType.REVOLUTE2:
            add.hinge(name, axis)
            if not has_parallel_axes(joint):
                add.hinge(joint_part(name, "axis2"), _second_axis(joint))
        case JointType.BALL:
            add.ball(name)
        case JointType.FLOATING:
            _add_floating(add, name)
        case JointType.PLANAR:
            _add_planar(add, name, axis)
        case JointType.SCREW:
            _add_screw(spec, add, name, joint, axis)
        case JointType.FIXED | JointType.GEARBOX:
            pass


def add_mimic(spec: Any, joint: Joint, model: str, step_s: float) -> None:
    """Make a joint follow another: ``position = multiplier · position(other) + offset``."""
    mimic = joint.mimic
    if mimic is None:
        return
    couple(
        spec,
        (scoped(model, joint.name), scoped(model, mimic.joint)),
        (mimic.offset, mimic.multiplier),
        step_s,
    )


def couple(
    spec: Any, names: tuple[str, str], offset_and_factor: tuple[float, float], step_s: float
) -> None:
    """Constrain ``q(first) = offset + factor · q(second)``."""
    equality = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_JOINT, objtype=mujoco.mjtObj.mjOBJ_JOINT, name1=names[0]
    )
    equality.name2 = names[1]
    equality.data = _padded(offset_and_factor, len(equality.data))
    equality_solver(equality, step_s)


def _padded(values: Sequence[float], length: int) -> list[float]:
    return [*values, *([0.0] * length)][:length]


def equality_solver(equality: Any, step_s: float) -> None:
    """Make an equality constraint as stiff as the step resolves."""
    equality.solref = [2.0 * step_s, 1.0]
    equality.solimp = [0.9995, 0.9995, 0.001, 0.5, 2.0]


class _Adder:
    """Adds elementary joints to one body, in the joint's frame."""

    def __init__(self, body: Any, T_link_joint: Pose, step_s: float) -> None:
        self._body = body
        self._pose = T_link_joint
        self._step_s = step_s

    def hinge(self, name: str, axis: JointAxis, *, unlimited: bool = False) -> None:
        self._axis(name, axis, mujoco.mjtJoint.mjJNT_HINGE, unlimited=unlimited)

    def slide(self, name: str, axis: JointAxis, *, unlimited: bool = False) -> None:
        self._axis(name, axis, mujoco.mjtJoint.mjJNT_SLIDE, unlimited=unlimited)

    def ball(self, name: str) -> None:
        self._body.add_joint(
            name=name, type=mujoco.mjtJoint.mjJNT_BALL, pos=list(self._pose.position_m)
        )

    def _axis(self, name: str, axis: JointAxis, kind: Any, *, unlimited: bool) -> None:
        joint = self._body.add_joint(
            name=name,
            type=kind,
            pos=list(self._pose.position_m),
            axis=list(self._pose.rotate(axis.xyz)),
        )
        damping = max(axis.damping, 0.0)
        joint.damping = [damping, 0.0, 0.0]
        joint.armature = implicit_damping(damping, self._step_s)
        joint.frictionloss = max(axis.friction, 0.0)
        joint.stiffness = [max(axis.spring_stiffness, 0.0), 0.0, 0.0]
        joint.springref = axis.spring_reference
        joint.solref_friction = [2.0 * self._step_s, 1.0]
        joint.solimp_friction = [0.9999, 0.9999, 0.001, 0.5, 2.0]
        self._limit(joint, axis, unlimited=unlimited)

    def _limit(self, joint: Any, axis: JointAxis, *, unlimited: bool) -> None:
        lower, upper = axis.lower, axis.upper
        if unlimited or (lower <= -INFINITE_LIMIT and upper >= INFINITE_LIMIT):
            joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
            return
        lower, upper = max(lower, -INFINITE_LIMIT), min(upper, INFINITE_LIMIT)
        if lower >= upper:
            middle = (lower + upper) / 2
            lower, upper = middle - 1e-9, middle + 1e-9
        joint.limited = mujoco.mjtLimited.mjLIMITED_TRUE
        joint.range = [lower, upper]
        joint.solref_limit = [2.0 * self._step_s, 1.0]
        joint.solimp_limit = [0.999, 0.999, 0.001, 0.5, 2.0]


def _add_floating(add: _Adder, name: str) -> None:
    axes: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    for axis, xyz in zip("xyz", axes, strict=True):
        add.slide(joint_part(name, axis), JointAxis(xyz), unlimited=True)
    add.ball(name)


def _add_planar(add: _Adder, name: str, axis: JointAxis) -> None:
    """URDF planar: moves in the plane whose normal is the axis, and turns about it."""
    first, second = _plane_axes(axis.xyz)
    add.slide(joint_part(name, "x"), JointAxis(first, damping=axis.damping), unlimited=True)
    add.slide(joint_part(name, "y"), JointAxis(second, damping=axis.damping), unlimited=True)
    add.hinge(name, JointAxis(axis.xyz, damping=axis.damping), unlimited=True)


def _plane_axes(normal: Vector3) -> tuple[Vector3, Vector3]:
    z = np.asarray(normal) / max(float(np.linalg.norm(normal)), 1e-12)
    reference = np.array([1.0, 0.0, 0.0]) if abs(z[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    x = reference - z * float(reference @ z)
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    return (float(x[0]), float(x[1]), float(x[2])), (float(y[0]), float(y[1]), float(y[2]))


def _add_screw(spec: Any, add: _Adder, name: str, joint: Joint, axis: JointAxis) -> None:
    """A hinge and a slide on one axis, coupled by the thread."""
    slide = joint_part(name, "slide")
    add.slide(slide, JointAxis(axis.xyz), unlimited=True)
    add.hinge(name, axis)
    pitch = joint.thread_pitch_rad_m
    factor = 1.0 / pitch if math.isfinite(pitch) and pitch != 0 else 0.0
    couple(spec, (slide, name), (0.0, factor), add._step_s)
