"""Rigid transforms, meshes and mass properties, without any robot format."""

from __future__ import annotations

from gazelle.geometry.pose import IDENTITY_POSE, Pose, quat_xyzw_from_rpy, rpy_from_quat_xyzw

__all__ = ["IDENTITY_POSE", "Pose", "quat_xyzw_from_rpy", "rpy_from_quat_xyzw"]
