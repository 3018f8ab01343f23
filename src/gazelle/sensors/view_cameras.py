"""Where a picture's camera stands: named directions, and the distance that fits everything in."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose, Vector3
from gazelle.sensors.intrinsics import camera_intrinsics

__all__ = ["VIEWS", "Shot", "camera_spec", "fitting_camera", "looking_at", "view_direction"]


VIEWS: dict[str, Vector3] = {
    "front": (1.0, 0.0, 0.0),
    "back": (-1.0, 0.0, 0.0),
    "side": (0.0, -1.0, 0.0),
    "right": (0.0, -1.0, 0.0),
    "left": (0.0, 1.0, 0.0),
    "top": (0.0, 0.0, 1.0),
    "bottom": (0.0, 0.0, -1.0),
    "iso": (1.0, -1.0, 0.8),
}
"""Where the camera stands, seen from the robot; x is the robot's front (REP-103)."""

_LONGER_SIDE_RAD = 0.7
_MARGIN = 0.06


@dataclass(frozen=True, slots=True)
class Shot:
    """One view of a picture and its place in it.

    Attributes:
        view: its name in `VIEWS`, or ``camera``.
        T_world_camera: the camera looks along +x of its frame, y left, z up.
        spec: lens and size.
        left_px, top_px: of its upper left pixel in the picture.
    """

    view: str
    T_world_camera: Pose
    spec: CameraSpec
    left_px: int = 0
    top_px: int = 0

    def pixel(self, point_m: Vector3) -> tuple[float, float]:
        """Return where in the picture a point of the world lies: column and row.

        Raises:
            ValueError: the point is not in front of the camera.
        """
        x, y, z = self.T_world_camera.inverse().transform(np.array(point_m)).tolist()
        if x <= 0.0:
            raise ValueError(f"the point {point_m} is behind the camera of view '{self.view}'")
        lens = camera_intrinsics(self.spec)
        column, row = lens.cx - lens.fx * y / x, lens.cy - lens.fy * z / x
        return self.left_px + column, self.top_px + row


def view_direction(view: str) -> Vector3:
    """Return where the camera of a named view stands, seen from what it looks at.

    Raises:
        NotFoundError: there is no view of this name.
    """
    if view not in VIEWS:
        hint = f"views: {', '.join(VIEWS)}"
        raise NotFoundError("view", view, nearest=nearest_names(view, VIEWS), hint=hint)
    return VIEWS[view]


def looking_at(eye_m: Vector3, target_m: Vector3) -> Pose:
    """Return the pose of a camera at one point that looks at another, upright.

    Straight up or down, the picture's right is +x of the world.

    Raises:
        ValueError: both are the same point.
    """
    forward = np.subtract(target_m, eye_m)
    length = float(np.linalg.norm(forward))
    if length < 1e-9:
        raise ValueError(f"the camera stands at {eye_m}, the very point it is to look at")
    forward = forward / length
    left = np.cross([0.0, 0.0, 1.0], forward)
    size = float(np.linalg.norm(left))
    left = left / size if size > 1e-6 else np.array([-1.0, 0.0, 0.0])
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([forward, left, np.cross(forward, left)], axis=1)
    matrix[:3, 3] = eye_m
    return Pose.from_matrix(matrix)


def camera_spec(width_px: int, height_px: int) -> CameraSpec:
    """Return a lens of 0.7 rad across the longer side; clip distances are set when it is placed."""
    focal = max(width_px, height_px) / (2.0 * math.tan(_LONGER_SIDE_RAD / 2.0))
    angle = 2.0 * math.atan(width_px / (2.0 * focal))
    return CameraSpec("view", horizontal_fov_rad=angle, width_px=width_px, height_px=height_px)


def fitting_camera(points_m: NDArray[np.float64], direction: Vector3, spec: CameraSpec) -> Pose:
    """Return the nearest camera of a direction that has all points in its picture.

    For each side of the picture, the points give one half-space that the camera must stand in;
    the camera is where they meet, in closed form.

    Args:
        points_m: (N, 3), at least one.
        direction: from the points to the camera.
        spec: the lens.
    """
    turned = looking_at(direction, (0.0, 0.0, 0.0))
    rotation = Pose((0.0, 0.0, 0.0), turned.quat_xyzw)
    local = rotation.inverse().transform(points_m)
    tan_x = math.tan(spec.horizontal_fov_rad / 2.0) * (1.0 - _MARGIN)
    back, left = _apex(local[:, 0], local[:, 1], tan_x)
    height, up = _apex(local[:, 0], local[:, 2], tan_x * spec.height_px / spec.width_px)
    nearest = float(local[:, 0].min())
    # Never inside of what is looked at, and some way off a single point.
    reach = max(float(np.ptp(local, axis=0).max()), 0.1)
    eye = (min(back, height, nearest - 0.1 * reach), left, up)
    x, y, z = rotation.rotate(eye)
    return Pose((x, y, z), turned.quat_xyzw)


def _apex(
    depth: NDArray[np.float64], across: NDArray[np.float64], tangent: float
) -> tuple[float, float]:
    """Return depth and offset of the tip of the narrowest wedge around the points."""
    left = float((across - depth * tangent).max())
    right = float((-across - depth * tangent).max())
    return -(left + right) / (2.0 * tangent), (left - right) / 2.0
