"""Scene values whose shapes name files → ones whose shapes name keys that the page can load."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, TypedDict, cast

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.geometry import Mesh, MeshMaterial, MeshPart, load_mesh
from gazelle.geometry.shape_meshes import heightmap_mesh, polyline_mesh
from gazelle.sensors.scene_json_types import (
    BodyValue,
    Floats3,
    HeightmapFile,
    MaterialValue,
    MeshFile,
    PlainGeometry,
    PolylineOutlines,
    SceneValue,
    ShapeValue,
    TrianglesGeometry,
    WorldGeometry,
)
from gazelle.studio.scenes.assets import Assets

__all__ = [
    "MeshGeometry",
    "MeshPartValue",
    "MissingGeometry",
    "PageGeometry",
    "mesh_geometry",
    "page_scene",
]


class MeshPartValue(TypedDict):
    """A part of a mesh, which the page loads by its key."""

    key: str
    material: MaterialValue | None


class MeshGeometry(TypedDict):
    """A mesh."""

    type: Literal["mesh"]
    parts: list[MeshPartValue]
    scale: Floats3


class MissingGeometry(TypedDict):
    """A mesh that cannot be read; it is drawn as a red box."""

    type: Literal["missing"]
    uri: str
    reason: str


PageGeometry = PlainGeometry | MeshGeometry | MissingGeometry
"""Geometries as the page takes them."""


def page_scene(value: SceneValue[WorldGeometry], assets: Assets) -> SceneValue[PageGeometry]:
    """Return a scene value of `gazelle.sensors.scene_json` as the page takes it.

    Args:
        value: its shapes and materials name files.
        assets: keeps what the page loads later.
    """
    made = cast("SceneValue[PageGeometry]", value.copy())
    made["bodies"] = [_body(body, assets) for body in value["bodies"]]
    return made


def mesh_geometry(geometry: MeshFile, assets: Assets) -> MeshGeometry | MissingGeometry:
    """Return a mesh's geometry with keys; one that cannot be read is of type ``missing``.

    Args:
        geometry: with ``uri``, ``path``, ``scale``, ``submesh`` and ``center_submesh``.
        assets: keeps its parts.
    """
    uri, path = str(geometry["uri"]), str(geometry["path"])
    if not path:
        return _missing(uri, "the file was not found")
    try:
        mesh = _chosen(load_mesh(path), geometry)
    except GazelleError as error:
        return _missing(uri, str(error))
    parts: list[MeshPartValue] = [
        {"key": assets.add_mesh(part), "material": _mesh_material(part.material, assets)}
        for part in mesh.parts
    ]
    return {"type": "mesh", "parts": parts, "scale": geometry["scale"]}


def _body(body: BodyValue[WorldGeometry], assets: Assets) -> BodyValue[PageGeometry]:
    made = cast("BodyValue[PageGeometry]", body.copy())
    made["visuals"] = [_shape(shape, assets) for shape in body["visuals"]]
    made["collisions"] = [_shape(shape, assets) for shape in body["collisions"]]
    return made


def _shape(shape: ShapeValue[WorldGeometry], assets: Assets) -> ShapeValue[PageGeometry]:
    made = cast("ShapeValue[PageGeometry]", shape.copy())
    made["geometry"] = _geometry(shape["geometry"], assets)
    material = shape["material"]
    if material is not None and material["texture"]:
        looks = material.copy()
        looks["texture"] = assets.add_texture(Path(material["texture"]))
        made["material"] = looks
    return made


def _geometry(geometry: WorldGeometry, assets: Assets) -> PageGeometry:
    if geometry["type"] == "mesh":
        return mesh_geometry(geometry, assets)
    if geometry["type"] not in ("heightmap", "polyline", "triangles"):
        return cast("PlainGeometry", geometry)
    try:
        part = _made_part(geometry)
    except (GazelleError, OSError, ValueError) as error:
        return _missing(str(geometry.get("uri", geometry["type"])), str(error))
    parts: list[MeshPartValue] = [{"key": assets.add_mesh(part), "material": None}]
    return {"type": "mesh", "parts": parts, "scale": [1.0, 1.0, 1.0]}


def _made_part(geometry: HeightmapFile | PolylineOutlines | TrianglesGeometry) -> MeshPart:
    if geometry["type"] == "triangles":
        vertices = np.array(geometry["vertices"], np.float64)
        faces = np.array(geometry["faces"], np.int32)
        return MeshPart("", vertices, faces, np.array(geometry["normals"], np.float64))
    if geometry["type"] == "polyline":
        outlines = tuple(
            tuple((float(x), float(y)) for x, y in outline) for outline in geometry["outlines"]
        )
        return polyline_mesh(outlines, geometry["height"])
    (x, y, z), (at_x, at_y, at_z) = geometry["size"], geometry["position"]
    return heightmap_mesh(_heights(Path(geometry["path"])), (x, y, z), (at_x, at_y, at_z))


def _heights(path: Path) -> NDArray[np.float64]:
    """A picture's brightness as 0…1."""
    from PIL import Image

    with Image.open(path) as image:
        deep = image.mode.startswith("I")
        pixels = np.asarray(image if deep else image.convert("L"), np.float64)
    return pixels / (65535.0 if deep else 255.0)


def _chosen(mesh: Mesh, geometry: MeshFile) -> Mesh:
    name = geometry["submesh"]
    if not name:
        return mesh
    chosen = mesh.submesh(name, geometry["center_submesh"])
    if chosen is None:
        names = ", ".join(mesh.submesh_names)
        raise GazelleError(f"it has no submesh '{name}'; there are {names}")
    return chosen


def _mesh_material(material: MeshMaterial | None, assets: Assets) -> MaterialValue | None:
    if material is None:
        return None
    return {
        "diffuse": list(material.diffuse),
        "ambient": list(material.ambient),
        "specular": list(material.specular),
        "emissive": list(material.emissive),
        "shininess": material.shininess,
        "texture": None if material.texture is None else assets.add_texture(material.texture),
    }


def _missing(uri: str, reason: str) -> MissingGeometry:
    return {"type": "missing", "uri": uri, "reason": reason}
