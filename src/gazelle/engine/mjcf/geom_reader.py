"""Geoms as collisions and visuals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle.description.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Material,
    MeshShape,
    Plane,
    Rgba,
    Shape,
    Sphere,
    Surface,
    Visual,
)
from gazelle.description.writers.geometry_elements import stl_bytes
from gazelle.description.writers.output_files import OutputFiles
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mjcf.mjcf_file import CompiledMjcf, pose_from
from gazelle.engine.mujoco_library import mujoco
from gazelle.geometry import MESH_SUFFIXES, Pose

__all__ = ["GeomReader"]

_LAST_DRAWN_GROUP = 2
"""MuJoCo's viewers draw the groups 0 to 2 at first."""

_PLAIN_RGBA = (0.5, 0.5, 0.5, 1.0)
_ENDLESS_M = 100.0
_KEPT_SUFFIXES = frozenset({".obj", ".stl"}) & frozenset(MESH_SUFFIXES)


class GeomReader:
    """Reads the geoms of one file."""

    def __init__(
        self, mjcf: CompiledMjcf, output_files: OutputFiles, diagnostics: Diagnostics
    ) -> None:
        self._mjcf = mjcf
        self._model: Any = mjcf.model
        self._beside = output_files
        self._diagnostics = diagnostics
        self._meshes = {mesh.id: mesh for mesh in mjcf.spec.meshes}

    def read(self, body: int) -> tuple[tuple[Collision, ...], tuple[Visual, ...]]:
        """Return what touches and what is seen of a body."""
        model = self._model
        collisions, visuals = [], []
        start = int(model.body_geomadr[body])
        for index in range(start, start + int(model.body_geomnum[body])):
            own = model.geom(index).name
            name = own or f"{self._mjcf.bodies[body]}_geom_{index - start}"
            span = self._mjcf.source.span("geom", own)
            found = self._shape(index, name)
            if found is None:
                kind = mujoco.mjtGeom(int(model.geom_type[index])).name.removeprefix("mjGEOM_")
                message = f"geom '{name}' ({kind.lower()}) is left out"
                self._diagnostics.report("convert.left-out", message, span)
                continue
            shape, pose = found
            if model.geom_contype[index] or model.geom_conaffinity[index]:
                surface = self._surface(index, name)
                collisions.append(Collision(name, shape, pose, surface, span=span))
            if int(model.geom_group[index]) <= _LAST_DRAWN_GROUP:
                visuals.append(Visual(name, shape, pose, self._material(index), span=span))
        return tuple(collisions), tuple(visuals)

    def _shape(self, index: int, name: str) -> tuple[Shape, Pose] | None:
        model, types = self._model, mujoco.mjtGeom
        pose = pose_from(model.geom_pos[index], model.geom_quat[index])
        x, y, z = (float(value) for value in model.geom_size[index])
        match types(int(model.geom_type[index])):
            case types.mjGEOM_BOX:
                return Box((2 * x, 2 * y, 2 * z)), pose
            case types.mjGEOM_SPHERE:
                return Sphere(x), pose
            case types.mjGEOM_CYLINDER:
                return Cylinder(x, 2 * y), pose
            case types.mjGEOM_CAPSULE:
                return Capsule(x, 2 * y), pose
            case types.mjGEOM_ELLIPSOID:
                return Ellipsoid((x, y, z)), pose
            case types.mjGEOM_PLANE:
                # 0 is MuJoCo's word for endless.
                return Plane(size_m=(2 * x or _ENDLESS_M, 2 * y or _ENDLESS_M)), pose
            case types.mjGEOM_MESH:
                return self._mesh(int(model.geom_dataid[index]), pose, name)
        return None

    def _mesh(self, mesh: int, pose: Pose, name: str) -> tuple[Shape, Pose] | None:
        """Return the mesh's own file where it is one that others read, else a new file."""
        model = self._model
        element = self._meshes.get(mesh)
        file = None if element is None else self._mjcf.file_of("mesh", element)
        if element is not None and file is not None and _is_as_written(element, file):
            T_file_mesh = pose_from(model.mesh_pos[mesh], model.mesh_quat[mesh])
            scale = (float(element.scale[0]), float(element.scale[1]), float(element.scale[2]))
            return MeshShape(str(file), file, scale), pose @ T_file_mesh.inverse()
        start, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        first, faces = int(model.mesh_faceadr[mesh]), int(model.mesh_facenum[mesh])
        data = stl_bytes(
            model.mesh_vert[start : start + count], model.mesh_face[first : first + faces]
        )
        address = self._beside.add(f"{model.mesh(mesh).name or name}.stl", data)
        return None if address is None else (MeshShape(address, None), pose)

    def _surface(self, index: int, name: str) -> Surface:
        dimensions = int(self._model.geom_condim[index])
        if dimensions > 3:
            message = f"spin and rolling friction of geom '{name}' have no word in URDF and SDF"
            span = self._mjcf.source.span("geom", name)
            self._diagnostics.report("convert.left-out", message, span)
        mu = float(self._model.geom_friction[index][0]) if dimensions > 1 else 0.0
        return Surface(mu1=mu, mu2=mu)

    def _material(self, index: int) -> Material:
        model = self._model
        rgba = tuple(round(float(value), 7) for value in model.geom_rgba[index])
        material = int(model.geom_matid[index])
        name, texture = "", None
        if material >= 0:
            name = model.mat(material).name
            texture = self._texture(material)
            if rgba == _PLAIN_RGBA:
                rgba = tuple(round(float(value), 7) for value in model.mat_rgba[material])
        appearance: Rgba = (rgba[0], rgba[1], rgba[2], rgba[3])
        return Material(name, ambient=appearance, diffuse=appearance, texture=texture)

    def _texture(self, material: int) -> Path | None:
        role = int(mujoco.mjtTextureRole.mjTEXROLE_RGB)
        index = int(self._model.mat_texid[material][role])
        element = next((item for item in self._mjcf.spec.textures if item.id == index), None)
        return None if element is None else self._mjcf.file_of("texture", element)


def _is_as_written(element: Any, file: Path) -> bool:
    """Tell whether the file's own frame and a scale say all of a mesh."""
    moved = any(element.refpos) or list(element.refquat) != [1.0, 0.0, 0.0, 0.0]
    return file.suffix.lower() in _KEPT_SUFFIXES and not moved
