"""What a group shall do next, as goal constraints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.interfaces import fill, message_type

__all__ = ["Targets", "joint_constraints", "pose_constraints"]


def joint_constraints(values: Mapping[str, float], tolerance: float) -> Any:
    """Return ``Constraints`` for positions of joints, rad or m."""
    made: Any = message_type("moveit_msgs/msg/Constraints")()
    rows = [
        {"joint_name": name, "position": float(value), "tolerance_above": tolerance,
         "tolerance_below": tolerance, "weight": 1.0}
        for name, value in values.items()
    ]  # fmt: skip
    fill(made, {"joint_constraints": rows})
    return made


def pose_constraints(
    link: str,
    frame: str,
    *,
    position_m: Sequence[float] | None = None,
    quat_xyzw: Sequence[float] | None = None,
    position_tolerance_m: float = 1e-4,
    orientation_tolerance_rad: float = 1e-3,
) -> Any:
    """Return ``Constraints`` for a link's position, orientation or both, in a frame."""
    made: Any = message_type("moveit_msgs/msg/Constraints")()
    header = {"frame_id": frame}
    fields: dict[str, Any] = {}
    if position_m is not None:
        position = dict(zip("xyz", map(float, position_m), strict=True))
        region = {
            "primitives": [{"type": 2, "dimensions": [position_tolerance_m]}],
            "primitive_poses": [{"position": position, "orientation": {"w": 1.0}}],
        }
        fields["position_constraints"] = [
            {"header": header, "link_name": link, "constraint_region": region, "weight": 1.0}
        ]
    if quat_xyzw is not None:
        turn = {
            "header": header,
            "link_name": link,
            "orientation": dict(zip("xyzw", map(float, quat_xyzw), strict=True)),
            "weight": 1.0,
        }
        names = (f"absolute_{axis}_axis_tolerance" for axis in "xyz")
        turn.update(dict.fromkeys(names, orientation_tolerance_rad))
        fields["orientation_constraints"] = [turn]
    fill(made, fields)
    return made


@dataclass
class Targets:
    """The last target counts: joints, or poses of links.

    Attributes:
        joints: positions by joint, None while poses are the target.
        poses: frame, position and orientation of several poses, by link; either part may be None.
        joint_tolerance, position_tolerance_m, orientation_tolerance_rad: of the goal.
    """

    joints: dict[str, float] | None = None
    poses: dict[str, list[tuple[str, Any, Any]]] = field(default_factory=dict)
    joint_tolerance: float = 1e-4
    position_tolerance_m: float = 1e-4
    orientation_tolerance_rad: float = 1e-3

    def set_joints(self, values: Mapping[str, float]) -> None:
        """Make positions of joints the target; those not named stay in it."""
        self.joints = {**(self.joints or {}), **{k: float(v) for k, v in values.items()}}
        self.poses = {}

    def set_poses(self, link: str, frame: str, poses: Sequence[Pose]) -> None:
        """Make poses of a link the target, any of them."""
        self.poses[link] = [(frame, pose.position_m, pose.quat_xyzw) for pose in poses]
        self.joints = None

    def set_part(
        self, link: str, frame: str, *, position_m: Any = None, quat_xyzw: Any = None
    ) -> None:
        """Make a position or an orientation of a link the target."""
        self.poses[link] = [(frame, position_m, quat_xyzw)]
        self.joints = None

    def clear(self, link: str = "") -> None:
        """Forget the poses of a link, of all links when none is named."""
        if link:
            self.poses.pop(link, None)
        else:
            self.poses = {}

    def constraints(self) -> list[Any]:
        """Return the goals; several poses of one link are alternatives, several links are not."""
        if self.joints is not None:
            return [joint_constraints(self.joints, self.joint_tolerance)]
        found: list[Any] = []
        for link, poses in self.poses.items():
            rows = [self._of_pose(link, *pose) for pose in poses]
            found = rows if not found else [_merged(a, b) for a in found for b in rows]
        return found

    def shifted(self, link: str, axis: int, value: float, start: tuple[str, Pose]) -> None:
        """Shift a link's target, or its present pose, by m along or rad about an axis (0 to 5)."""
        known = self.poses.get(link)
        frame, pose = start
        if known and known[0][1] is not None and known[0][2] is not None:
            frame, pose = known[0][0], Pose(tuple(known[0][1]), tuple(known[0][2]))
        if axis < 3:
            position = np.array(pose.position_m)
            position[axis] += value
            pose = Pose(
                (float(position[0]), float(position[1]), float(position[2])), pose.quat_xyzw
            )
        else:
            angles = [*pose.rpy_rad]
            angles[axis - 3] += value
            pose = Pose.from_xyz_rpy(pose.position_m, (angles[0], angles[1], angles[2]))
        self.set_poses(link, frame, [pose])

    def _of_pose(self, link: str, frame: str, position: Any, quat: Any) -> Any:
        return pose_constraints(
            link,
            frame,
            position_m=position,
            quat_xyzw=quat,
            position_tolerance_m=self.position_tolerance_m,
            orientation_tolerance_rad=self.orientation_tolerance_rad,
        )


def _merged(first: Any, second: Any) -> Any:
    made: Any = message_type("moveit_msgs/msg/Constraints")()
    for name in ("joint_constraints", "position_constraints", "orientation_constraints"):
        setattr(made, name, [*getattr(first, name), *getattr(second, name)])
    return made
