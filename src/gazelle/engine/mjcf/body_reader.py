"""Bodies and their joints as links and joints; a body may have several, one after the other."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link
from gazelle.description.writers.single_axis_joints import carried
from gazelle.description.writers.unscoped_names import free_name
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.geom_reader import GeomReader
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf, pose_from
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["BodyReader", "effort_limits"]


_WORLD = "world"
_FULL_GRAVITY = 1.0


class BodyReader:
    """Reads the bodies of one tree.

    Attributes:
        T_world_model: the model's frame: that of a body that floats freely, else the world's.
        is_static: nothing of the tree moves.
    """

    def __init__(
        self, mjcf: CompiledMjcf, geoms: GeomReader, diagnostics: Diagnostics, root: int
    ) -> None:
        self._mjcf = mjcf
        self._model: Any = mjcf.model
        self._geoms = geoms
        self._diagnostics = diagnostics
        self._root = root
        self._taken = {*mjcf.bodies, *mjcf.joints}
        self._efforts = effort_limits(mjcf.model)
        self.is_static = not mjcf.model.body_dofnum[mjcf.tree(root)].any()
        floats = self._is_free(root) or self.is_static
        self.T_world_model = mjcf.body_pose(root) if floats else IDENTITY_POSE
        self._from_world = self.T_world_model.inverse()

    def read(self, body: int) -> tuple[list[Link], list[Joint]]:
        """Return a body's link, the links that carry its first axes, and its joints."""
        link = self._link(body)
        parent_id = int(self._model.body_parentid[body])
        parent = self._mjcf.bodies[parent_id] if parent_id else _WORLD
        if self._is_free(body) or (self.is_static and body == self._root):
            return [link], []
        indices = list(self._mjcf.joints_of(body))
        if not indices:
            name = free_name(f"{link.name}_joint", self._taken)
            self._taken.add(name)
            fixed = Joint(name, JointType.FIXED, parent, link.name, link.T_model_link)
            return [link], [fixed]
        return self._chain(indices, link, parent)

    def _chain(self, indices: list[int], link: Link, parent: str) -> tuple[list[Link], list[Joint]]:
        links: list[Link] = []
        joints: list[Joint] = []
        kept = link
        for index in indices:
            frame = self._joint_frame(index, link)
            child = link.name
            if index != indices[-1]:
                child = free_name(f"{link.name}_{self._mjcf.joints[index]}_carrier", self._taken)
                self._taken.add(child)
                carrier, kept = carried(link, child, frame, len(indices) - 1)
                links.append(carrier)
            joints.append(self._joint(index, parent, child, frame))
            parent = child
        if len(indices) > 1:
            names = ", ".join(f"'{self._mjcf.joints[index]}'" for index in indices)
            message = (
                f"body '{link.name}' has the joints {names}; links of a thousandth of its mass "
                "stand between them"
            )
            self._diagnostics.report("convert.approximated", message, link.span)
        return [*links, kept], joints

    def _link(self, body: int) -> Link:
        model, name = self._model, self._mjcf.bodies[body]
        collisions, visuals = self._geoms.read(body)
        return Link(
            name,
            self._from_world @ self._mjcf.body_pose(body),
            self._inertial(body),
            collisions,
            visuals,
            gravity=float(model.body_gravcomp[body]) < _FULL_GRAVITY,
            span=self._mjcf.source.span("body", model.body(body).name),
        )

    def _inertial(self, body: int) -> Inertial | None:
        model = self._model
        mass = float(model.body_mass[body])
        if mass <= 0:
            return None
        x, y, z = (float(value) for value in model.body_inertia[body])
        T_link_com = pose_from(model.body_ipos[body], model.body_iquat[body])
        return Inertial(mass, T_link_com, (x, 0.0, 0.0, y, 0.0, z))

    def _joint_frame(self, index: int, link: Link) -> Pose:
        anchor = self._mjcf.data.xanchor[index]
        x, y, z = self._from_world.transform(np.asarray(anchor))
        return Pose((float(x), float(y), float(z)), link.T_model_link.quat_xyzw)

    def _joint(self, index: int, parent: str, child: str, frame: Pose) -> Joint:
        model, types = self._model, mujoco.mjtJoint
        span = self._mjcf.source.span("joint", model.joint(index).name)
        name = self._mjcf.joints[index]
        if int(model.jnt_type[index]) == int(types.mjJNT_BALL):
            if model.jnt_limited[index]:
                message = f"the limit of ball joint '{name}' has no word in URDF and SDF"
                self._diagnostics.report("convert.left-out", message, span)
            return Joint(name, JointType.BALL, parent, child, frame, span=span)
        limited = bool(model.jnt_limited[index])
        if int(model.jnt_type[index]) == int(types.mjJNT_SLIDE):
            kind = JointType.PRISMATIC
        else:
            kind = JointType.REVOLUTE if limited else JointType.CONTINUOUS
        return Joint(name, kind, parent, child, frame, axis=self._axis(index, frame), span=span)

    def _axis(self, index: int, frame: Pose) -> JointAxis:
        model = self._model
        place, dof = int(model.jnt_qposadr[index]), int(model.jnt_dofadr[index])
        direction = self._from_world.rotate(_vector(self._mjcf.data.xaxis[index]))
        x, y, z = frame.inverse().rotate(direction)
        lower, upper = (float(value) for value in model.jnt_range[index])
        limited = bool(model.jnt_limited[index])
        stiffness = float(model.jnt_stiffness[index])
        return JointAxis(
            (x, y, z),
            lower=lower if limited else -math.inf,
            upper=upper if limited else math.inf,
            effort=self._efforts.get(index, math.inf),
            damping=float(model.dof_damping[dof]),
            friction=float(model.dof_frictionloss[dof]),
            spring_stiffness=stiffness,
            spring_reference=float(model.qpos_spring[place]) if stiffness else 0.0,
            position=float(model.qpos0[place]),
        )

    def _is_free(self, body: int) -> bool:
        free = int(mujoco.mjtJoint.mjJNT_FREE)
        return any(int(self._model.jnt_type[i]) == free for i in self._mjcf.joints_of(body))


def effort_limits(model: Any) -> dict[int, float]:
    """Return N·m or N by joint: ``actuatorfrcrange``, else what its actuators are limited to.

    An actuator counts that acts on the joint itself and whose force is limited, by ``forcerange``
    or, for plain motors, by ``ctrlrange``.
    """
    limits: dict[int, float] = {}
    on_joint = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    for index in range(model.nu):
        if int(model.actuator_trntype[index]) in on_joint:
            force = _force(model, index)
            if force is not None:
                joint = int(model.actuator_trnid[index][0])
                gear = abs(float(model.actuator_gear[index][0]))
                limits[joint] = limits.get(joint, 0.0) + gear * force
    for joint in range(model.njnt):
        if model.jnt_actfrclimited[joint]:
            limits[joint] = float(np.abs(model.jnt_actfrcrange[joint]).max())
    return limits


def _force(model: Any, index: int) -> float | None:
    if model.actuator_forcelimited[index]:
        return float(np.abs(model.actuator_forcerange[index]).max())
    plain = int(model.actuator_gaintype[index]) == int(mujoco.mjtGain.mjGAIN_FIXED)
    plain = plain and int(model.actuator_biastype[index]) == int(mujoco.mjtBias.mjBIAS_NONE)
    if plain and model.actuator_ctrllimited[index]:
        gain = abs(float(model.actuator_gainprm[index][0]))
        return gain * float(np.abs(model.actuator_ctrlrange[index]).max())
    return None


def _vector(values: Any) -> tuple[float, float, float]:
    return (float(values[0]), float(values[1]), float(values[2]))
