"""``moveit_msgs/Constraints`` as constraints of planning."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose
from gazelle.interfaces import poses
from gazelle.interfaces.poses import quat_xyzw_of
from gazelle.motion.constraints import (
    ForwardKinematics,
    JointConstraint,
    OrientationConstraint,
    Parameterization,
    PathConstraint,
    PositionConstraint,
    Region,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import JointGroup, RobotModel
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError

__all__ = ["ConstraintReader", "Frames", "pose_of"]

_KINDS = {1: "box", 2: "sphere", 3: "cylinder"}
_TINY_M = 1e-4
_TINY_RAD = 1e-3


class Frames(Protocol):
    """Where frames are: links, objects, and what tf knows."""

    def T_planning_frame(self, name: str) -> FloatArray:
        """Return the pose of a frame in the planning frame, 4×4.

        Raises:
            MoveGroupError: nobody knows the frame.
        """
        ...


@dataclass(frozen=True)
class ConstraintReader:
    """Reads constraints for one planning group.

    Attributes:
        model: the robot.
        group: whose configurations are constrained.
        frames: resolves the frames that messages name.
        fk: pose of a link at a configuration.
        code: what a fault is answered with.
    """

    model: RobotModel
    group: JointGroup
    frames: Frames
    fk: ForwardKinematics
    code: ErrorCode = ErrorCode.INVALID_GOAL_CONSTRAINTS

    def read(self, message: Any) -> tuple[PathConstraint, ...]:
        """Return all constraints of a message.

        Raises:
            MoveGroupError: a joint, link or frame is not known, or a region has no size.
        """
        if len(message.visibility_constraints):
            text = "visibility constraints are not planned with; leave them out"
            raise MoveGroupError(self.code, text)
        found: list[PathConstraint] = []
        found += [self._joint(item) for item in message.joint_constraints]
        found += [self._position(item) for item in message.position_constraints]
        found += [self._orientation(item) for item in message.orientation_constraints]
        return tuple(found)

    def _joint(self, item: Any) -> JointConstraint:
        if item.joint_name not in self.model.variables:
            self._unknown("joint", item.joint_name, self.model.variables)
        leader, multiplier, offset = self.model.mimic_of(item.joint_name)
        if leader not in self.group.variables or not multiplier:
            hint = f"'{self.group.name}' moves {', '.join(self.group.variables)}"
            text = f"joint '{item.joint_name}' is not moved by the planning group; {hint}"
            raise MoveGroupError(self.code, text)
        above, below = float(item.tolerance_above), float(item.tolerance_below)
        if above < 0 or below < 0:
            text = f"a tolerance of joint '{item.joint_name}' is below zero"
            raise MoveGroupError(self.code, text)
        above, below = above / abs(multiplier), below / abs(multiplier)
        if multiplier < 0:
            above, below = below, above
        return JointConstraint(
            leader,
            self.group.variables.index(leader),
            (float(item.position) - offset) / multiplier,
            above,
            below,
        )

    def _position(self, item: Any) -> PositionConstraint:
        self._check_link(item.link_name)
        T_frame = self.frames.T_planning_frame(item.header.frame_id)
        volume = item.constraint_region
        if len(volume.meshes):
            raise MoveGroupError(self.code, "regions that are meshes are not planned with")
        regions = tuple(
            _region(shape, T_frame @ pose_of(pose).matrix(), self.code)
            for shape, pose in zip(volume.primitives, volume.primitive_poses, strict=False)
        )
        if not regions:
            text = f"the position constraint of link '{item.link_name}' has no region with a pose"
            raise MoveGroupError(self.code, text)
        offset = item.target_point_offset
        return PositionConstraint(item.link_name, regions, self.fk, (offset.x, offset.y, offset.z))

    def _orientation(self, item: Any) -> OrientationConstraint:
        self._check_link(item.link_name)
        turn = item.orientation
        if abs(turn.x) + abs(turn.y) + abs(turn.z) + abs(turn.w) < _TINY_RAD:
            text = f"the orientation for link '{item.link_name}' is no quaternion: all is 0"
            raise MoveGroupError(self.code, text)
        T_frame = self.frames.T_planning_frame(item.header.frame_id)
        rotation = Pose(quat_xyzw=quat_xyzw_of(turn)).matrix()[:3, :3]
        tolerances = (
            item.absolute_x_axis_tolerance,
            item.absolute_y_axis_tolerance,
            item.absolute_z_axis_tolerance,
        )
        kind = int(getattr(item, "parameterization", 0))
        return OrientationConstraint(
            item.link_name,
            T_frame[:3, :3] @ rotation,
            _positive(tolerances),
            self.fk,
            Parameterization(kind if kind in (0, 1) else 0),
        )

    def _check_link(self, link: str) -> None:
        if link not in self.model.links:
            self._unknown("link", link, self.model.links, ErrorCode.INVALID_LINK_NAME)

    def _unknown(
        self, what: str, name: str, known: Iterable[str], code: ErrorCode | None = None
    ) -> None:
        text = f"the robot has no {what} '{name}'; {did_you_mean(name, tuple(known))}"
        raise MoveGroupError(code or self.code, text)


def pose_of(message: Any) -> Pose:
    """Return a ``geometry_msgs/Pose``; a quaternion of zeros is no rotation, as in MoveIt."""
    pose = poses.pose_of(message)
    return pose if np.linalg.norm(pose.quat_xyzw) > _TINY_RAD else Pose(pose.position_m)


def _region(shape: Any, pose: FloatArray, code: ErrorCode) -> Region:
    kind = _KINDS.get(int(shape.type))
    if kind is None:
        text = f"a region of SolidPrimitive type {shape.type} is not planned with"
        raise MoveGroupError(code, f"{text}; there are boxes, spheres and cylinders")
    sizes = tuple(max(float(size), _TINY_M) for size in shape.dimensions)
    try:
        return Region(kind, sizes, pose)
    except ValueError as error:
        raise MoveGroupError(code, str(error)) from error


def _positive(tolerances: Iterable[float]) -> tuple[float, float, float]:
    x, y, z = (max(float(value), _TINY_RAD) for value in tolerances)
    return x, y, z
