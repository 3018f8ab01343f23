"""What is seen of a world, as geoms that touch nothing, and their meshes as OBJ files."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Heightmap,
    Link,
    Material,
    MeshShape,
    Model,
    Plane,
    Polyline,
    Rgba,
    Shape,
    Solid,
    Sphere,
    Visual,
)
from gazelle.description.writers.geometry_elements import mesh_of
from gazelle.description.writers.output_files import OutputFiles
from gazelle.diagnostics import Diagnostics
from gazelle.documents.images import PictureError, opened_picture
from gazelle.engine.mjspec_builder import SpecBuilder
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import scoped
from gazelle.geometry import (
    MeshMaterial,
    MeshPart,
    Pose,
    plane_mesh,
    polyline_mesh,
)

__all__ = ["COLLISION_GROUP", "VisualWriter", "obj_bytes"]


Array = NDArray[Any]


COLLISION_GROUP = 3
"""Group of geoms that touch and are not drawn; MuJoCo's viewer hides it at first."""


_VISUAL_GROUP = 2
_MIN_CORNERS = 4
_Appearance = tuple[Rgba, float, float, str]


class VisualWriter:
    """Adds visuals to a spec and gathers the files they need.

    Attributes:
        meshes: content of the OBJ file of every mesh, by the mesh's name.
    """

    def __init__(
        self, builder: SpecBuilder, output_files: OutputFiles, diagnostics: Diagnostics
    ) -> None:
        self.meshes: dict[str, tuple[str, bytes]] = {}
        self._builder = builder
        self._spec: Any = builder.spec
        self._beside = output_files
        self._diagnostics = diagnostics
        self._parts: dict[Any, tuple[tuple[str, str], ...]] = {}
        self._materials: dict[_Appearance, str] = {}
        self._textures: dict[bytes, str] = {}
        self._assets: dict[str, bytes] = {}

    def add(self) -> None:
        """Add every visual of the world."""
        count = 0
        for model in self._builder.world.models:
            for link in model.links:
                for visual in link.visuals:
                    self._add_visual(model, link, visual)
                    count += 1
        self._spec.assets = self._assets
        if count:
            for geom in self._builder.geoms:
                geom.element.group = COLLISION_GROUP

    def _add_visual(self, model: Model, link: Link, visual: Visual) -> None:
        link_name = scoped(model.name, link.name)
        name = f"{link_name}//visual {visual.name}"
        body = self._spec.body(link_name)
        simple = _primitive(visual.shape)
        if simple is not None:
            kind, size = simple
            geom = self._geom(body, name, visual.T_link_visual)
            geom.type, geom.size = kind, [*size, 0.0, 0.0, 0.0][:3]
            geom.material = self._material(visual, None)
            return
        parts = self._mesh_parts(visual, name)
        if not parts:
            message = f"visual '{visual.name}' of link '{link_name}' has no mesh MuJoCo can show"
            self._diagnostics.report("convert.left-out", message, visual.span)
        for index, (mesh, material) in enumerate(parts):
            part = name if index == 0 else f"{name}//part-{index}"
            geom = self._geom(body, part, visual.T_link_visual)
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, mesh
            geom.material = material

    def _geom(self, body: Any, name: str, pose: Pose) -> Any:
        while name in self._builder.used_names:
            name += "'"
        self._builder.used_names.add(name)
        geom = body.add_geom(name=name)
        geom.pos, geom.quat = list(pose.position_m), list(pose.quat_wxyz)
        geom.contype, geom.conaffinity, geom.group = 0, 0, _VISUAL_GROUP
        geom.mass = 0.0
        return geom

    def _mesh_parts(self, visual: Visual, name: str) -> tuple[tuple[str, str], ...]:
        """Return names of mesh and material of each part; the same mesh is written once."""
        shape = visual.shape
        key: Any = (visual.material, visual.transparency, name)
        if isinstance(shape, MeshShape):
            key = (shape.path, shape.scale, shape.submesh, visual.material, visual.transparency)
        if key not in self._parts:
            found = []
            for part in _triangles(shape):
                if len(part.vertices_m) >= _MIN_CORNERS and _has_area(part):
                    mesh = self._mesh(part, shape, name)
                    found.append((mesh, self._material(visual, part.material)))
            self._parts[key] = tuple(found)
        return self._parts[key]

    def _mesh(self, part: MeshPart, shape: Shape, name: str) -> str:
        word = type(shape).__name__.lower()
        if isinstance(shape, MeshShape):
            word = f"{Path(shape.uri).stem} {part.name}".strip()
        wanted = f"visual {word}"
        chosen, number = wanted, 2
        while chosen in self.meshes:
            chosen, number = f"{wanted} {number}", number + 1
        data = obj_bytes(part.vertices_m, part.faces, part.normals, part.uv)
        self.meshes[chosen] = (f"{word}.obj", data)
        mesh = self._spec.add_mesh(name=chosen)
        mesh.uservert = part.vertices_m.ravel()
        mesh.userface = part.faces.ravel()
        # A shell has an inertia also where a picture of a thing has no inside.
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        return chosen

    def _material(self, visual: Visual, own: MeshMaterial | None) -> str:
        appearance = visual.material or own or Material()
        *rgb, alpha = appearance.diffuse
        texture = self._texture(appearance.texture)
        glow = max(appearance.emissive[:3])
        rgba: Rgba = (rgb[0], rgb[1], rgb[2], alpha * (1.0 - visual.transparency))
        key = (rgba, max(appearance.specular[:3]), glow, texture)
        if key not in self._materials:
            name = f"material {len(self._materials) + 1}"
            item = self._spec.add_material(name=name)
            item.rgba, item.specular, item.emission = list(rgba), key[1], glow
            item.shininess = 0.5
            if texture:
                item.textures[int(mujoco.mjtTextureRole.mjTEXROLE_RGB)] = texture
            self._materials[key] = name
        return self._materials[key]

    def _texture(self, source: Path | bytes | None) -> str:
        """Return the name of a picture, as PNG, the one kind MuJoCo reads; empty for none."""
        if source is None:
            return ""
        try:
            data = source.read_bytes() if isinstance(source, Path) else source
            if data in self._textures:
                return self._textures[data]
            png = io.BytesIO()
            with opened_picture(data) as image:
                image.convert("RGB").save(png, "PNG")
        except (OSError, PictureError) as error:
            return self._without_texture(source, str(error))
        stem = source.stem if isinstance(source, Path) else "texture"
        file = self._beside.add(f"{stem}.png", png.getvalue())
        if file is None:
            return self._without_texture(source, "it needs a file beside the text")
        name = f"texture {len(self._textures) + 1}"
        self._assets[file] = png.getvalue()
        texture = self._spec.add_texture(name=name)
        texture.type, texture.file = mujoco.mjtTexture.mjTEXTURE_2D, file
        self._textures[data] = name
        return name

    def _without_texture(self, source: Path | bytes, why: str) -> str:
        where = f"'{source}'" if isinstance(source, Path) else "inside a mesh"
        message = f"texture {where} is left out: {why}"
        self._diagnostics.report("convert.left-out", message)
        return ""


def obj_bytes(
    vertices_m: Array, faces: Array, normals: Array | None = None, uv: Array | None = None
) -> bytes:
    """Return an OBJ file; numbers have the digits that single precision needs.

    Args:
        vertices_m: (N, 3), kept in their order.
        faces: (M, 3) indices from 0.
        normals: (N, 3), one per vertex.
        uv: (N, 2), (0, 0) is the picture's lower left corner.
    """
    text = "# metres\n" + _rows("v", vertices_m)
    if uv is not None:
        text += _rows("vt", uv)
    if normals is not None:
        text += _rows("vn", normals)
    corner = "%d"
    if uv is not None or normals is not None:
        corner = f"%d/{'%d' if uv is not None else ''}{'/%d' if normals is not None else ''}"
    indices = np.asarray(faces, dtype=np.int64) + 1
    line = f"f {corner} {corner} {corner}\n"
    numbers = np.repeat(indices.ravel(), corner.count("%d")).tolist()
    return (text + line * len(indices) % tuple(numbers)).encode("ascii")


def _rows(word: str, values: Array) -> str:
    # Nine digits give every single-precision number back.
    rows = np.asarray(values, dtype=np.float32)
    line = f"{word} {' '.join(['%.9g'] * rows.shape[1])}\n"
    return line * len(rows) % tuple(rows.ravel().tolist())


def _primitive(shape: Shape) -> tuple[Any, tuple[float, ...]] | None:
    types = mujoco.mjtGeom
    match shape:
        case Box(size_m=size):
            return types.mjGEOM_BOX, tuple(edge / 2 for edge in size)
        case Sphere(radius_m=radius):
            return types.mjGEOM_SPHERE, (radius,)
        case Cylinder(radius_m=radius, length_m=length):
            return types.mjGEOM_CYLINDER, (radius, length / 2)
        case Capsule(radius_m=radius, length_m=length):
            return types.mjGEOM_CAPSULE, (radius, length / 2)
        case Ellipsoid(radii_m=radii):
            return types.mjGEOM_ELLIPSOID, tuple(radii)
        case Solid() | MeshShape() | Polyline() | Plane() | Heightmap():
            return None
        case _:
            assert_never(shape)


def _triangles(shape: Shape) -> tuple[MeshPart, ...]:
    match shape:
        case MeshShape():
            mesh = mesh_of(shape)
            return () if mesh is None else mesh.parts
        case Solid():
            return (shape.mesh(),)
        case Polyline(outlines_m=outlines, height_m=height):
            return (polyline_mesh(outlines, height),)
        case Plane(normal=normal, size_m=size):
            return (plane_mesh(size, normal),)
        case Heightmap():
            return ()
        case _:
            assert_never(shape)


def _has_area(part: MeshPart) -> bool:
    corners: NDArray[np.float64] = part.vertices_m[part.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return bool(np.linalg.norm(normals, axis=1).sum() > 1e-12)
