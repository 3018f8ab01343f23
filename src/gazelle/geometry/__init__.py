"""Rigid transforms, meshes and mass properties, without any robot format."""

from __future__ import annotations

from gazelle.geometry.convex import ConvexParts, announcing, convex_hull, convex_parts
from gazelle.geometry.loading import MESH_SUFFIXES, load_mesh, load_mesh_reported
from gazelle.geometry.mass import (
    Inertia6,
    MassProperties,
    combined_mass_properties,
    inertia_from_matrix,
    inertia_matrix,
    inertia_problems,
    is_legal_inertia,
    legalised_inertia,
)
from gazelle.geometry.mesh import Mesh, MeshError, MeshMaterial, MeshNote, MeshPart
from gazelle.geometry.mesh_mass import (
    MassError,
    is_closed,
    mesh_area_m2,
    mesh_mass_properties,
    mesh_volume_m3,
)
from gazelle.geometry.pose import IDENTITY_POSE, Pose, quat_xyzw_from_rpy, rpy_from_quat_xyzw
from gazelle.geometry.primitives import (
    box_mesh,
    capsule_mesh,
    cone_mesh,
    cylinder_mesh,
    ellipsoid_mesh,
    plane_mesh,
    sphere_mesh,
)
from gazelle.geometry.solids import (
    box_mass_properties,
    capsule_mass_properties,
    cone_mass_properties,
    cylinder_mass_properties,
    cylindrical_shell_mass_properties,
    ellipsoid_mass_properties,
    half_cylindrical_shell_mass_properties,
    hemisphere_mass_properties,
    hemispherical_shell_mass_properties,
    rod_mass_properties,
    semicylinder_mass_properties,
    sphere_mass_properties,
    spherical_shell_mass_properties,
)
from gazelle.geometry.terrain import heightmap_mesh, polyline_mesh
from gazelle.geometry.vectors import cross

__all__ = [
    "IDENTITY_POSE",
    "MESH_SUFFIXES",
    "ConvexParts",
    "Inertia6",
    "MassError",
    "MassProperties",
    "Mesh",
    "MeshError",
    "MeshMaterial",
    "MeshNote",
    "MeshPart",
    "Pose",
    "announcing",
    "box_mass_properties",
    "box_mesh",
    "capsule_mass_properties",
    "capsule_mesh",
    "combined_mass_properties",
    "cone_mass_properties",
    "cone_mesh",
    "convex_hull",
    "convex_parts",
    "cross",
    "cylinder_mass_properties",
    "cylinder_mesh",
    "cylindrical_shell_mass_properties",
    "ellipsoid_mass_properties",
    "ellipsoid_mesh",
    "half_cylindrical_shell_mass_properties",
    "heightmap_mesh",
    "hemisphere_mass_properties",
    "hemispherical_shell_mass_properties",
    "inertia_from_matrix",
    "inertia_matrix",
    "inertia_problems",
    "is_closed",
    "is_legal_inertia",
    "legalised_inertia",
    "load_mesh",
    "load_mesh_reported",
    "mesh_area_m2",
    "mesh_mass_properties",
    "mesh_volume_m3",
    "plane_mesh",
    "polyline_mesh",
    "quat_xyzw_from_rpy",
    "rod_mass_properties",
    "rpy_from_quat_xyzw",
    "semicylinder_mass_properties",
    "sphere_mass_properties",
    "sphere_mesh",
    "spherical_shell_mass_properties",
]
