"""Rigid transforms, meshes and mass properties, without any robot format."""

from __future__ import annotations

from gazelle.geometry.loading import MESH_SUFFIXES, load_mesh, load_mesh_reported
from gazelle.geometry.mesh import Mesh, MeshError, MeshMaterial, MeshNote, MeshPart
from gazelle.geometry.pose import IDENTITY_POSE, Pose, quat_xyzw_from_rpy, rpy_from_quat_xyzw

__all__ = [
    "IDENTITY_POSE",
    "MESH_SUFFIXES",
    "Mesh",
    "MeshError",
    "MeshMaterial",
    "MeshNote",
    "MeshPart",
    "Pose",
    "load_mesh",
    "load_mesh_reported",
    "quat_xyzw_from_rpy",
    "rpy_from_quat_xyzw",
]
