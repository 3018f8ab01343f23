"""Pinhole cameras: focal lengths and principal points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from gazelle.description.model import CameraSpec

__all__ = ["MAX_ANGLE_RAD", "Convention", "Intrinsics", "camera_intrinsics"]

MAX_ANGLE_RAD = math.radians(179.9)
"""The widest view of a pinhole; wide-angle lenses beyond it are drawn like this."""

Convention = Literal["rendering", "camera_info"]


@dataclass(frozen=True, slots=True)
class Intrinsics:
    """A pinhole: ``u = fx x / z + s y / z + cx``, ``v = fy y / z + cy``, in pixels.

    x points right, y down, z forward (REP-103's optical frame). Integer u, v are the centres of
    pixels under the ``rendering`` convention.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int
    skew: float = 0.0


def camera_intrinsics(spec: CameraSpec, *, convention: Convention = "rendering") -> Intrinsics:
    """Return a camera's intrinsics.

    The focal length is ``width / (2 tan(hfov / 2))`` for both axes unless ``<lens><intrinsics>``
    says otherwise.

    Args:
        spec: the camera.
        convention: ``rendering`` is where pictures and clouds really are: principal point at
            ``(width - 1) / 2``. ``camera_info`` is what gazebo_ros writes into CameraInfo, one
            pixel further: ``(width + 1) / 2``.
    """
    width, height = spec.width_px, spec.height_px
    shift = 0.5 if convention == "camera_info" else -0.5
    if spec.intrinsics is not None:
        fx, fy, cx, cy, skew = spec.intrinsics
        if convention == "rendering":
            cx, cy = cx - 0.5, cy - 0.5
        return Intrinsics(fx, fy, cx, cy, width, height, skew)
    focal = width / (2.0 * math.tan(min(spec.horizontal_fov_rad, MAX_ANGLE_RAD) / 2.0))
    return Intrinsics(focal, focal, width / 2.0 + shift, height / 2.0 + shift, width, height)
