"""Scene values whose shapes name files → ones whose shapes name keys that the page can load."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError
from gazelle.geometry import Mesh, MeshMaterial, MeshPart, load_mesh
from gazelle.geometry.terrain import heightmap_mesh, polyline_mesh
from gazelle.studio.scenes.assets import Assets

__all__ = ["mesh_geometry", "page_scene"]

Value = dict[str, Any]


def page_scene(value: Value, assets: Assets) -> Value:
    """Return a scene value of `gazelle.sensors.scene_value` as the page takes it.

    Args:
        value: its shapes and materials name files.
        assets: keeps what the page loads later.
    """
    bodies = [
        body
        | {
            "visuals": [_shape(shape, assets) for shape in body["visuals"]],
            "collisions": [_shape(shape, assets) for shape in body["collisions"]],
        }
        for body in value["bodies"]
    ]
    return value | {"bodies": bodies}


def mesh_geometry(geometry: Value, assets: Assets) -> Value:
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
    parts = [
        {"key": assets.add_mesh(part), "material": _mesh_material(part.material, assets)}
        for part in mesh.parts
    ]
    return {"type": "mesh", "parts": parts, "scale": geometry["scale"]}


def _shape(shape: Value, assets: Assets) -> Value:
    material = shape["material"]
    changed: Value = {"geometry": _geometry(shape["geometry"], assets)}
    if material is not None and material.get("texture"):
        key = assets.add_texture(Path(material["texture"]))
        changed["material"] = material | {"texture": key}
    return shape | changed


def _geometry(geometry: Value, assets: Assets) -> Value:
    kind = geometry["type"]
    if kind == "mesh":
        return mesh_geometry(geometry, assets)
    if kind not in ("heightmap", "polyline"):
        return geometry
    try:
        part = _made_part(geometry)
    except (GazelleError, OSError, ValueError) as error:
        return _missing(str(geometry.get("uri", kind)), str(error))
    parts = [{"key": assets.add_mesh(part), "material": None}]
    return {"type": "mesh", "parts": parts, "scale": [1.0, 1.0, 1.0]}


def _made_part(geometry: Value) -> MeshPart:
    if geometry["type"] == "polyline":
        outlines = tuple(
            tuple((float(x), float(y)) for x, y in outline) for outline in geometry["outlines"]
        )
        return polyline_mesh(outlines, geometry["height"])
    size, position = geometry["size"], geometry["position"]
    return heightmap_mesh(_heights(Path(geometry["path"])), tuple(size), tuple(position))


def _heights(path: Path) -> NDArray[np.float64]:
    """A picture's brightness as 0…1."""
    from PIL import Image

    with Image.open(path) as image:
        deep = image.mode.startswith("I")
        pixels = np.asarray(image if deep else image.convert("L"), np.float64)
    return pixels / (65535.0 if deep else 255.0)


def _chosen(mesh: Mesh, geometry: Value) -> Mesh:
    name = geometry.get("submesh", "")
    if not name:
        return mesh
    chosen = mesh.submesh(name, bool(geometry.get("center_submesh")))
    if chosen is None:
        names = ", ".join(mesh.submesh_names)
        raise GazelleError(f"it has no submesh '{name}'; there are {names}")
    return chosen


def _mesh_material(material: MeshMaterial | None, assets: Assets) -> Value | None:
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


def _missing(uri: str, reason: str) -> Value:
    return {"type": "missing", "uri": uri, "reason": reason}
