"""Mass properties of triangle meshes, solid and thin-walled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.geometry.mass_properties import MassProperties, inertia_from_matrix
from gazelle.geometry.mesh import Mesh, MeshPart
from gazelle.geometry.vertex_normals import face_normals, group_points

__all__ = ["MassError", "is_closed", "mesh_area_m2", "mesh_mass_properties", "mesh_volume_m3"]

Array = NDArray[np.float64]


class MassError(GazelleError):
    """Mass properties cannot be computed from this geometry."""


def is_closed(mesh: Mesh | MeshPart) -> bool:
    """Return whether every edge is met by as many faces one way as the other.

    Only then does a mesh have an inside. Vertices at the same place count as one.
    """
    vertex = group_points(mesh.vertices_m)
    faces = vertex[mesh.faces]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    count = int(vertex.max(initial=0)) + 1
    forward = np.sort(edges[:, 0] * count + edges[:, 1])
    backward = np.sort(edges[:, 1] * count + edges[:, 0])
    return bool(np.array_equal(forward, backward))


def mesh_volume_m3(mesh: Mesh | MeshPart) -> float:
    """Return the enclosed volume; negative when the faces point inwards."""
    corners = _centred_corners(mesh)[0]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def mesh_area_m2(mesh: Mesh | MeshPart) -> float:
    """Return the area of all faces."""
    return float(np.linalg.norm(face_normals(mesh.vertices_m[mesh.faces]), axis=1).sum() / 2)


def mesh_mass_properties(
    mesh: Mesh | MeshPart,
    *,
    mass_kg: float | None = None,
    density_kg_m3: float | None = None,
    shell: bool = False,
) -> MassProperties:
    """Return mass properties of a mesh of even density.

    The solid's integrals follow from the divergence theorem: each face spans a tetrahedron with
    the origin, whose moments are polynomials of its corners.

    Args:
        mesh: triangles; turned inside out is understood.
        mass_kg: the mass; or
        density_kg_m3: the density (kg/m² of a shell). Exactly one of the two.
        shell: the faces are thin walls instead of the surface of a solid.

    Raises:
        MassError: a solid is asked for and the mesh is not closed or has no volume, or a shell's
            faces have no area.
        ValueError: not exactly one of mass and density is given.
    """
    if (mass_kg is None) == (density_kg_m3 is None):
        raise ValueError("give either mass_kg or density_kg_m3")
    if not shell and not is_closed(mesh):
        raise MassError(
            "the mesh is not closed, so it has no inside; take shell=True or its convex hull"
        )
    corners, origin = _centred_corners(mesh)
    amount, first, second = _shell_moments(corners) if shell else _solid_moments(corners)
    if not shell and amount < 0:
        amount, first, second = -amount, -first, -second
    extent = float(np.ptp(mesh.vertices_m, axis=0).max(initial=0.0))
    if amount <= 1e-12 * max(extent ** (2 if shell else 3), 1e-300):
        raise MassError(f"the mesh has no {'area' if shell else 'volume'}")
    density = mass_kg / amount if mass_kg is not None else float(density_kg_m3 or 0.0)
    mass = density * amount
    center = first / amount
    spread = density * (second - amount * np.outer(center, center))
    x, y, z = (float(value) for value in center + origin)
    inertia = inertia_from_matrix(np.trace(spread) * np.eye(3) - spread)
    return MassProperties(mass, (x, y, z), inertia)


def _centred_corners(mesh: Mesh | MeshPart) -> tuple[Array, Array]:
    # Far from the origin the tetrahedra are huge and cancel badly.
    vertices = mesh.vertices_m
    origin = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    return (vertices - origin)[mesh.faces], origin


def _solid_moments(corners: Array) -> tuple[float, Array, Array]:
    volume = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    total = corners.sum(axis=1)
    first = (volume[:, None] * total).sum(axis=0) / 4
    second = np.einsum("i,ij,ik->jk", volume, total, total)
    second += np.einsum("i,ivj,ivk->jk", volume, corners, corners)
    return float(volume.sum()), first, second / 20


def _shell_moments(corners: Array) -> tuple[float, Array, Array]:
    area = np.linalg.norm(face_normals(corners), axis=1) / 2
    total = corners.sum(axis=1)
    first = (area[:, None] * total).sum(axis=0) / 3
    second = np.einsum("i,ij,ik->jk", area, total, total)
    second += np.einsum("i,ivj,ivk->jk", area, corners, corners)
    return float(area.sum()), first, second / 12
