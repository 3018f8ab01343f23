"""What a viewer elsewhere needs to draw a world or a robot, as plain values for JSON.

The form is that of ``docs/studio_protocol.md``, with meshes and textures still as files: whoever
sends it to a page replaces them by what the page can load.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Literal, TypedDict, assert_never

from gazelle.description.model import (
    CameraSpec,
    Joint,
    Light,
    Link,
    Material,
    Model,
    Sensor,
    World,
)
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
    Shape,
    Solid,
    Sphere,
)
from gazelle.geometry import IDENTITY_POSE, MeshPart, Pose
from gazelle.sensors.scene_json_types import (
    BodyValue,
    HeightmapFile,
    InertialValue,
    JointValue,
    LightValue,
    MaterialValue,
    MeshFile,
    ModelValue,
    PolylineOutlines,
    RoundGeometry,
    SceneValue,
    SensorValue,
    TrianglesGeometry,
    WorldGeometry,
)
from gazelle.sensors.view_overlays import equivalent_box

__all__ = ["geometry_value", "light_value", "pose_value", "robot_value", "world_value"]

# Of ixx, ixy, ixz, iyy, iyz, izz.
_MOMENTS = (0, 3, 5)
_ROUND: dict[type[Cylinder | Capsule | Cone], Literal["cylinder", "capsule", "cone"]] = {
    Cylinder: "cylinder",
    Capsule: "capsule",
    Cone: "cone",
}


class _ModelsValue(TypedDict):
    models: list[ModelValue]
    bodies: list[BodyValue[WorldGeometry]]
    joints: list[JointValue]


class _AxisValue(TypedDict):
    axis: list[float]
    lower: float | None
    upper: float | None
    effort: float | None
    velocity: float | None


def world_value(world: World, *, version: int = 0) -> SceneValue[WorldGeometry]:
    """Return the scene value of a world; bodies are in the order of the engine's link names.

    Args:
        world: what is there, everything at its initial pose.
        version: counts changes.
    """
    lights = [light_value(light) for light in world.lights]
    scene, parts = world.scene, _models_value(world.models)
    return {
        "models": parts["models"],
        "bodies": parts["bodies"],
        "joints": parts["joints"],
        "name": world.name,
        "kind": "world",
        "version": version,
        "lights": lights,
        "sky": scene.sky,
        "ambient": list(scene.ambient[:3]),
        "background": list(scene.background[:3]),
        "shadows": scene.shadows,
        "grid": scene.grid,
        "view": None if scene.T_world_view is None else pose_value(scene.T_world_view),
        "gravity": list(world.gravity_m_s2),
    }


def robot_value(model: Model) -> SceneValue[WorldGeometry]:
    """Return the scene value of one robot at joint position zero; poses are in its root link."""
    root = _root(model)
    parts = _models_value((model,))
    T_root_model = root.T_model_link.inverse() if root is not None else IDENTITY_POSE
    for body, link in zip(parts["bodies"], model.links, strict=True):
        body["name"] = link.name
        body["pose"] = pose_value(T_root_model @ link.T_model_link)
    return {
        "models": parts["models"],
        "bodies": parts["bodies"],
        "joints": parts["joints"],
        "name": model.name,
        "kind": "robot",
        "version": 0,
        "lights": [],
        "sky": False,
        "ambient": [0.4, 0.4, 0.4],
        "background": [0.2, 0.2, 0.2],
        "shadows": True,
        "grid": True,
        "view": None,
    }


def pose_value(pose: Pose) -> list[float]:
    """Return ``[x, y, z, qx, qy, qz, qw]``, metres."""
    return [*pose.position_m, *pose.quat_xyzw]


def light_value(light: Light) -> LightValue:
    """Return a light of the scene value."""
    return {
        "name": light.name,
        "type": light.type.value,
        "pose": pose_value(light.T_parent_light),
        "direction": list(light.direction),
        "diffuse": list(light.diffuse),
        "specular": list(light.specular),
        "intensity": light.intensity,
        "range_m": light.range_m,
        "cast_shadows": light.cast_shadows,
        "spot_outer_angle_rad": light.spot_outer_angle_rad,
    }


def geometry_value(shape: Shape) -> WorldGeometry:
    """Return a geometry; meshes and terrain carry their files."""
    match shape:
        case Box():
            return {"type": "box", "size": list(shape.size_m)}
        case Sphere():
            return {"type": "sphere", "radius": shape.radius_m}
        case Ellipsoid():
            return {"type": "ellipsoid", "radii": list(shape.radii_m)}
        case Cylinder() | Capsule() | Cone():
            kind = _ROUND[type(shape)]
            made: RoundGeometry = {
                "type": kind, "radius": shape.radius_m, "length": shape.length_m,
            }  # fmt: skip
            return made
        case Solid():
            return _triangles(shape.mesh())
        case Plane():
            return {"type": "plane", "normal": list(shape.normal), "size": list(shape.size_m)}
        case MeshShape() | Heightmap() | Polyline():
            return _file_geometry(shape)
        case _:
            assert_never(shape)


def _triangles(part: MeshPart) -> TrianglesGeometry:
    return {
        "type": "triangles",
        "vertices": part.vertices_m.tolist(),
        "faces": part.faces.tolist(),
        "normals": part.normals.tolist(),
    }


def _file_geometry(
    shape: MeshShape | Heightmap | Polyline,
) -> MeshFile | HeightmapFile | PolylineOutlines:
    match shape:
        case MeshShape():
            return {
                "type": "mesh",
                "uri": shape.uri,
                "path": str(shape.path or ""),
                "scale": list(shape.scale),
                "submesh": shape.submesh,
                "center_submesh": shape.center_submesh,
            }
        case Heightmap():
            return {
                "type": "heightmap",
                "uri": shape.uri,
                "path": str(shape.path or ""),
                "size": list(shape.size_m),
                "position": list(shape.position_m),
            }
        case Polyline():
            outlines = [[list(point) for point in outline] for outline in shape.outlines_m]
            return {"type": "polyline", "outlines": outlines, "height": shape.height_m}
        case _:
            assert_never(shape)


def _models_value(models: Sequence[Model]) -> _ModelsValue:
    value: _ModelsValue = {"models": [], "bodies": [], "joints": []}
    for index, model in enumerate(models):
        first_body, first_joint = len(value["bodies"]), len(value["joints"])
        places = {link.name: first_body + place for place, link in enumerate(model.links)}
        value["bodies"] += [_body(link, model, index) for link in model.links]
        value["joints"] += _joints(model, places)
        value["models"].append(
            {
                "name": model.name,
                "static": model.static,
                "bodies": list(range(first_body, len(value["bodies"]))),
                "joints": list(range(first_joint, len(value["joints"]))),
                "pose": pose_value(model.T_world_model),
            }
        )
    return value


def _body(link: Link, model: Model, index: int) -> BodyValue[WorldGeometry]:
    return {
        "name": f"{model.name}::{link.name}",
        "model": index,
        "link": link.name,
        "pose": pose_value(model.T_world_model @ link.T_model_link),
        "inertial": _inertial(link),
        "visuals": [
            {
                "name": visual.name,
                "pose": pose_value(visual.T_link_visual),
                "geometry": geometry_value(visual.shape),
                "material": _material(visual.material),
                "cast_shadows": visual.cast_shadows,
                "transparency": visual.transparency,
            }
            for visual in link.visuals
        ],
        "collisions": [
            {
                "name": collision.name,
                "pose": pose_value(collision.T_link_collision),
                "geometry": geometry_value(collision.shape),
                "material": None,
                "cast_shadows": False,
                "transparency": 0.0,
            }
            for collision in link.collisions
        ],
        "sensors": [_sensor(sensor) for sensor in link.sensors],
        "lights": [light_value(light) for light in link.lights],
    }


def _inertial(link: Link) -> InertialValue | None:
    inertial = link.inertial
    if inertial is None:
        return None
    box = equivalent_box(inertial)
    diagonal = [inertial.inertia_kg_m2[index] for index in _MOMENTS]
    size, T_link_box = box if box is not None else ((0.0, 0.0, 0.0), inertial.T_link_com)
    return {
        "mass_kg": inertial.mass_kg,
        "pose": pose_value(inertial.T_link_com),
        "diagonal": diagonal,
        "box": list(size),
        "box_pose": pose_value(T_link_box),
        "estimated": inertial.estimated,
    }


def _sensor(sensor: Sensor) -> SensorValue:
    value: SensorValue = {
        "name": sensor.name,
        "type": sensor.type,
        "pose": pose_value(sensor.T_link_sensor),
        "rate_hz": sensor.update_rate_hz,
    }
    if isinstance(sensor.spec, CameraSpec):
        value["fov_rad"] = sensor.spec.horizontal_fov_rad
        value["lens"] = pose_value(sensor.spec.T_sensor_camera)
    return value


def _material(material: Material | None) -> MaterialValue | None:
    if material is None:
        return None
    return {
        "name": material.name,
        "diffuse": list(material.diffuse),
        "ambient": list(material.ambient),
        "specular": list(material.specular),
        "emissive": list(material.emissive),
        "shininess": material.shininess,
        "texture": str(material.texture) if material.texture is not None else None,
        "texture_scale": list(material.texture_scale),
    }


def _joints(model: Model, places: dict[str, int]) -> Iterable[JointValue]:
    links = {link.name: link for link in model.links}
    for joint in model.joints:
        child = links.get(joint.child)
        T_model_child = child.T_model_link if child is not None else IDENTITY_POSE
        T_child_joint = T_model_child.inverse() @ joint.T_model_joint
        mimic = joint.mimic
        yield {
            "name": joint.name,
            "type": joint.type.value,
            "parent": places.get(joint.parent, -1),
            "child": places.get(joint.child, -1),
            "pose": pose_value(T_child_joint),
            **_axis(joint),
            "mimic": None
            if mimic is None
            else {"joint": mimic.joint, "multiplier": mimic.multiplier, "offset": mimic.offset},
        }


def _axis(joint: Joint) -> _AxisValue:
    axis = joint.axis
    if axis is None:
        return {
            "axis": [0.0, 0.0, 0.0],
            "lower": None,
            "upper": None,
            "effort": None,
            "velocity": None,
        }
    return {
        "axis": list(axis.xyz),
        "lower": _finite(axis.lower),
        "upper": _finite(axis.upper),
        "effort": _finite(axis.effort),
        "velocity": _finite(axis.velocity),
    }


def _finite(value: float) -> float | None:
    """JSON has no infinity."""
    return value if math.isfinite(value) else None


def _root(model: Model) -> Link | None:
    children = {joint.child for joint in model.joints}
    return next((link for link in model.links if link.name not in children), None)
