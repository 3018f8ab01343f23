"""Scene values back into worlds to look at: what a running world told becomes a `World` again.

It holds what cameras see: links with visuals and sensors, and lights. What physics needs besides
(collisions, inertias, joints' limits) is not in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import assert_never

from gazelle.description.model import (
    CameraSpec,
    Light,
    LightType,
    Link,
    Material,
    Model,
    Scene,
    Sensor,
    Visual,
    World,
)
from gazelle.description.model.sensor import OtherSensorSpec
from gazelle.description.model.shape import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Heightmap,
    MeshShape,
    Plane,
    Polyline,
    Rgba,
    Shape,
    Sphere,
)
from gazelle.geometry import Pose, Vector3
from gazelle.sensors.scene_json_types import (
    BodyValue,
    LightValue,
    MaterialValue,
    ModelValue,
    SceneValue,
    SensorValue,
    ShapeValue,
    WorldGeometry,
)

__all__ = ["pose_of_value", "world_of_value"]

_ROUND: dict[str, type[Cylinder | Capsule | Cone]] = {
    "cylinder": Cylinder,
    "capsule": Capsule,
    "cone": Cone,
}


def world_of_value(value: SceneValue[WorldGeometry]) -> World:
    """Return the world that `gazelle.sensors.scene_json.world_value` was made of, as it looks."""
    view = value["view"]
    return World(
        name=value["name"],
        models=tuple(_model(model, value["bodies"]) for model in value["models"]),
        lights=tuple(map(_light, value["lights"])),
        scene=Scene(
            ambient=_rgba(value["ambient"]),
            background=_rgba(value["background"]),
            sky=value["sky"],
            shadows=value["shadows"],
            grid=value["grid"],
            T_world_view=None if view is None else pose_of_value(view),
        ),
    )


def pose_of_value(numbers: Sequence[float]) -> Pose:
    """Return the pose of ``[x, y, z, qx, qy, qz, qw]``, metres."""
    x, y, z, qx, qy, qz, qw = map(float, numbers)
    return Pose((x, y, z), (qx, qy, qz, qw))


def _model(value: ModelValue, bodies: Sequence[BodyValue[WorldGeometry]]) -> Model:
    T_world_model = pose_of_value(value["pose"])
    T_model_world = T_world_model.inverse()
    links = tuple(_link(bodies[place], T_model_world) for place in value["bodies"])
    return Model(value["name"], T_world_model, static=value["static"], links=links)


def _link(value: BodyValue[WorldGeometry], T_model_world: Pose) -> Link:
    return Link(
        value["link"],
        T_model_world @ pose_of_value(value["pose"]),
        visuals=tuple(map(_visual, value["visuals"])),
        sensors=tuple(map(_sensor, value["sensors"])),
        lights=tuple(map(_light, value["lights"])),
    )


def _visual(value: ShapeValue[WorldGeometry]) -> Visual:
    material = value["material"]
    return Visual(
        value["name"],
        _shape(value["geometry"]),
        pose_of_value(value["pose"]),
        None if material is None else _material(material),
        transparency=value["transparency"],
        cast_shadows=value["cast_shadows"],
    )


def _sensor(value: SensorValue) -> Sensor:
    fov_rad, lens = value.get("fov_rad"), value.get("lens")
    spec = (
        OtherSensorSpec(value["type"])
        if fov_rad is None or lens is None
        else CameraSpec(T_sensor_camera=pose_of_value(lens), horizontal_fov_rad=fov_rad)
    )
    return Sensor(
        value["name"],
        value["type"],
        spec,
        pose_of_value(value["pose"]),
        update_rate_hz=value["rate_hz"],
    )


def _light(value: LightValue) -> Light:
    return Light(
        value["name"],
        LightType(value["type"]),
        pose_of_value(value["pose"]),
        diffuse=_rgba(value["diffuse"]),
        specular=_rgba(value["specular"]),
        direction=_triple(value["direction"]),
        intensity=value["intensity"],
        cast_shadows=value["cast_shadows"],
        range_m=value["range_m"],
        spot_outer_angle_rad=value["spot_outer_angle_rad"],
    )


def _material(value: MaterialValue) -> Material:
    texture, scale = value["texture"], value.get("texture_scale", [1.0, 1.0])
    return Material(
        value.get("name", ""),
        ambient=_rgba(value["ambient"]),
        diffuse=_rgba(value["diffuse"]),
        specular=_rgba(value["specular"]),
        emissive=_rgba(value["emissive"]),
        shininess=value["shininess"],
        texture=None if texture is None else Path(texture),
        texture_scale=(scale[0], scale[1]),
    )


def _shape(value: WorldGeometry) -> Shape:
    match value["type"]:
        case "box":
            return Box(_triple(value["size"]))
        case "sphere":
            return Sphere(value["radius"])
        case "ellipsoid":
            return Ellipsoid(_triple(value["radii"]))
        case "cylinder" | "capsule" | "cone" as word:
            return _ROUND[word](value["radius"], value["length"])
        case "plane":
            return Plane(_triple(value["normal"]), (value["size"][0], value["size"][1]))
        case "polyline":
            outlines = tuple(tuple((x, y) for x, y in outline) for outline in value["outlines"])
            return Polyline(outlines, value["height"])
        case "mesh":
            return MeshShape(
                value["uri"],
                Path(value["path"]) if value["path"] else None,
                _triple(value["scale"]),
                value["submesh"],
                value["center_submesh"],
            )
        case "heightmap":
            path = Path(value["path"]) if value["path"] else None
            return Heightmap(value["uri"], path, _triple(value["size"]), _triple(value["position"]))
        case "triangles":
            # Only solids that have no word of their own are sent so; their file is not known.
            return MeshShape("", None)
        case _:
            assert_never(value)


def _triple(numbers: Sequence[float]) -> Vector3:
    return (numbers[0], numbers[1], numbers[2])


def _rgba(numbers: Sequence[float]) -> Rgba:
    alpha = numbers[3] if len(numbers) > 3 else 1.0
    return (numbers[0], numbers[1], numbers[2], alpha)
