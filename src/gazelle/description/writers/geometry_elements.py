"""Shapes in SDF's words, and meshes for what URDF has no word for.

A ``<gazebo reference>`` says how a whole link touches. A collision with another surface, such as a
castor without friction, goes to a link without mass that a fixed joint holds; sdformat puts both
back into one link and keeps their surfaces apart.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import replace
from typing import assert_never

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Capsule,
    Collision,
    Cylinder,
    Heightmap,
    Joint,
    JointType,
    Link,
    MeshShape,
    Model,
    Plane,
    Polyline,
    Shape,
    Solid,
    Sphere,
    Surface,
)
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.unscoped_names import free_name, part_names
from gazelle.description.writers.xml_markup import Markup, number, numbers, tidy
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError
from gazelle.geometry import (
    Mesh,
    MeshPart,
    Pose,
    load_mesh,
    polyline_mesh,
)

__all__ = [
    "add_sdf_geometry",
    "add_urdf_geometry",
    "as_mesh",
    "mesh_of",
    "stl_bytes",
    "urdf_pieces",
    "with_surfaces_apart",
]

_ONES = (1.0, 1.0, 1.0)


def with_surfaces_apart(model: Model, diagnostics: Diagnostics) -> Model:
    """Return the model with links whose collisions all have the same surface.

    Args:
        model: any.
        diagnostics: receives ``convert.approximated`` for each link that is added.
    """
    links: list[Link] = []
    joints = list(model.joints)
    taken = set(part_names(model))
    for link in model.links:
        kinds: dict[tuple[Surface, float], list[Collision]] = {}
        for collision in link.collisions:
            key = (replace(collision.surface, span=None), collision.laser_retro)
            kinds.setdefault(key, []).append(collision)
        first, *others = list(kinds.values()) or [[]]
        links.append(replace(link, collisions=tuple(first)) if others else link)
        for group in others:
            name = free_name(f"{link.name}_{group[0].name}", taken)
            joint = free_name(f"{name}_joint", taken)
            taken |= {name, joint}
            links.append(_shell(link, name, group))
            joints.append(
                Joint(joint, JointType.FIXED, link.name, name, link.T_model_link, span=link.span)
            )
            _report(link, name, group, diagnostics)
    return replace(model, links=tuple(links), joints=tuple(joints))


def add_urdf_geometry(owner: Markup, shape: Shape, output_files: OutputFiles) -> None:
    """Append the ``<geometry>`` of a shape that URDF has a word for."""
    geometry = owner.add("geometry")
    match shape:
        case Solid() if shape.in_urdf:
            geometry.add(shape.word, **dict(_lengths(shape)))
        case MeshShape():
            mesh = geometry.add("mesh", filename=output_files.address(shape.path, shape.uri))
            if shape.scale != _ONES:
                mesh.attributes["scale"] = numbers(shape.scale)
        case Solid() | Plane() | Heightmap() | Polyline():
            raise AssertionError(f"URDF has no word for {shape}")
        case _:
            assert_never(shape)


def urdf_pieces(shape: Shape, *, has_capsules: bool) -> tuple[tuple[str, Shape, Pose], ...]:
    """Return shapes that URDF can say and that together are the shape; none when there are none.

    Args:
        shape: any.
        has_capsules: the file is of a URDF version that knows ``<capsule>`` (1.2).

    Returns:
        What is added to the name, the shape, and its place in the frame of `shape`.
    """
    match shape:
        case Capsule() if not has_capsules:
            return _capsule_pieces(shape)
        case Solid() if shape.in_urdf:
            return (("", shape, Pose()),)
        case MeshShape():
            return () if shape.submesh else (("", shape, Pose()),)
        case Solid() | Plane() | Heightmap() | Polyline():
            return ()
        case _:
            assert_never(shape)


def as_mesh(shape: Shape) -> tuple[str, bytes] | None:
    """Return a word and an STL file for a shape that URDF has no other for.

    None for planes, terrain, lost files and what `add_urdf_geometry` says.
    """
    part: MeshPart
    match shape:
        case MeshShape():
            mesh = mesh_of(shape)
            return None if mesh is None else (shape.submesh, stl_bytes(mesh.vertices_m, mesh.faces))
        case Solid() if not shape.in_urdf:
            part = shape.mesh()
        case Polyline(outlines_m=outlines, height_m=height):
            part = polyline_mesh(outlines, height)
        case Solid() | Plane() | Heightmap():
            return None
        case _:
            assert_never(shape)
    return type(shape).__name__.lower(), stl_bytes(part.vertices_m, part.faces)


def mesh_of(shape: MeshShape) -> Mesh | None:
    """Return a mesh file's triangles, of its submesh if one is named; None when it is unusable."""
    if shape.path is None:
        return None
    try:
        mesh = load_mesh(shape.path)
    except (GazelleError, OSError, ValueError):
        return None
    chosen = mesh.submesh(shape.submesh, shape.center_submesh) if shape.submesh else mesh
    return None if chosen is None else chosen.scaled(shape.scale)


def stl_bytes(vertices_m: NDArray[np.float64], faces: NDArray[np.int32]) -> bytes:
    """Return triangles as a binary STL file: faces (f, 3) of vertices (n, 3)."""
    corners = np.asarray(vertices_m, dtype=np.float64)[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)
    record = np.zeros(len(corners), dtype=[("numbers", "<f4", (4, 3)), ("spare", "<u2")])
    record["numbers"][:, 0], record["numbers"][:, 1:] = normals, corners
    head = b"binary STL in metres".ljust(80)
    return head + struct.pack("<I", len(corners)) + record.tobytes()


def add_sdf_geometry(owner: Markup, shape: Shape, output_files: OutputFiles) -> None:
    """Append the ``<geometry>`` of a shape in SDF's words."""
    geometry = owner.add("geometry")
    match shape:
        case Solid():
            item = geometry.add(shape.word)
            for word, text in _lengths(shape):
                item.add(word, text)
        case Plane(normal=normal, size_m=plane_size):
            plane = geometry.add("plane")
            plane.add("normal", numbers(map(tidy, normal)))
            plane.add("size", numbers(plane_size))
        case MeshShape():
            _add_mesh(geometry, shape, output_files)
        case Heightmap():
            terrain = geometry.add("heightmap")
            terrain.add("uri", output_files.address(shape.path, shape.uri))
            terrain.add("size", numbers(shape.size_m))
            terrain.add("pos", numbers(shape.position_m))
        case Polyline(outlines_m=outlines, height_m=height):
            for outline in outlines:
                line = geometry.add("polyline")
                for point in outline:
                    line.add("point", numbers(point))
                line.add("height", number(height))
        case _:
            assert_never(shape)


def _shell(link: Link, name: str, collisions: list[Collision]) -> Link:
    return Link(
        name,
        link.T_model_link,
        collisions=tuple(collisions),
        self_collide=link.self_collide,
        span=link.span,
    )


def _report(link: Link, name: str, group: list[Collision], diagnostics: Diagnostics) -> None:
    shown = ", ".join(f"'{item.name}'" for item in group)
    message = (
        f"collision {shown} of link '{link.name}' touches in another way than the link's first "
        f"one; it is on a link of its own, '{name}', for URDF says this for whole links"
    )
    diagnostics.report("convert.approximated", message, group[0].span)


def _capsule_pieces(shape: Capsule) -> tuple[tuple[str, Shape, Pose], ...]:
    if shape.length_m <= 0:
        return (("", Sphere(shape.radius_m), Pose()),)
    ends = (
        (word, Sphere(shape.radius_m), Pose((0.0, 0.0, side * shape.length_m / 2)))
        for word, side in (("_top", 1.0), ("_bottom", -1.0))
    )
    return (("", Cylinder(shape.radius_m, shape.length_m), Pose()), *ends)


def _lengths(shape: Solid) -> Iterator[tuple[str, str]]:
    """Yield words and texts of a solid's lengths."""
    for row in shape.lengths():
        value = getattr(shape, row.field)
        yield row.word, numbers(value) if isinstance(value, tuple) else number(value)


def _add_mesh(geometry: Markup, shape: MeshShape, output_files: OutputFiles) -> None:
    mesh = geometry.add("mesh")
    mesh.add("uri", output_files.address(shape.path, shape.uri))
    if shape.submesh:
        submesh = mesh.add("submesh")
        submesh.add("name", shape.submesh)
        submesh.add("center", str(shape.center_submesh).lower())
    if shape.scale != _ONES:
        mesh.add("scale", numbers(shape.scale))
