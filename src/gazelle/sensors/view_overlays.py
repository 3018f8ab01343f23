"""What cannot be seen of a robot, as shapes: collisions, inertia, axes, frames, mass centres."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Cone,
    Cylinder,
    Inertial,
    Joint,
    Link,
    Material,
    Model,
    Plane,
    Shape,
    Sphere,
    Visual,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3, cross, inertia_matrix
from gazelle.sensors.ray_scene import RayScene

__all__ = ["OVERLAYS", "equivalent_box", "overlay_world", "scene_points"]


OVERLAYS = ("collisions", "inertia", "com", "joints", "frames")
"""In the order in which they are painted."""

_COLOURS: dict[str, tuple[float, float, float]] = {
    "collisions": (1.0, 0.5, 0.05),
    "inertia": (0.6, 0.2, 0.85),
    "com": (1.0, 0.85, 0.0),
    "joints": (0.0, 0.7, 0.75),
}
_AXES: tuple[tuple[Vector3, Vector3], ...] = (
    ((1.0, 0.0, 0.0), (0.9, 0.1, 0.1)),
    ((0.0, 1.0, 0.0), (0.1, 0.75, 0.1)),
    ((0.0, 0.0, 1.0), (0.15, 0.25, 1.0)),
)
_BARE_MODEL_M = 0.5
"""Taken as the size of a model without shapes."""


def overlay_world(
    world: World, kind: str, sizes_m: Mapping[str, float], diagnostics: Diagnostics
) -> World:
    """Return the world with nothing in it but one overlay, drawn as visuals of the links.

    Args:
        world: with links where they are to be shown.
        kind: of `OVERLAYS`, or ``inertia_edges``.
        sizes_m: extent by model name; arrows, axes and spheres are made to fit it.
        diagnostics: told of inertias that no box has.
    """
    painters: dict[str, Callable[[Model, Link, float, Diagnostics], list[Visual]]] = {
        "collisions": _collisions,
        "inertia": _inertia,
        "inertia_edges": _inertia_edges,
        "com": _mass_centre,
        "joints": _joint_axes,
        "frames": _frame_axes,
    }
    paint = painters[kind]
    models = []
    for model in world.models:
        size = sizes_m.get(model.name, 0.0) or _BARE_MODEL_M
        links = tuple(
            replace(link, visuals=tuple(paint(model, link, size, diagnostics)), lights=())
            for link in model.links
        )
        models.append(replace(model, links=links))
    return replace(world, models=tuple(models))


def equivalent_box(inertial: Inertial) -> tuple[Vector3, Pose] | None:
    """Return size and pose in the link of the uniform box with this mass and tensor.

    A box of mass m and edges a, b, c has ``ixx = m (b² + c²) / 12``; principal moments solved
    for the edges give ``a² = 6 (iyy + izz − ixx) / m``.

    Returns:
        None when there is none: no mass, or moments that no body can have.
    """
    tensor = inertia_matrix(inertial.inertia_kg_m2)
    if not (inertial.mass_kg > 0.0 and np.isfinite(tensor).all()):
        return None
    moments, axes = np.linalg.eigh(tensor)
    squares = 6.0 * (moments.sum() - 2.0 * moments) / inertial.mass_kg
    # Thin rods and discs give zeros that rounding may take below.
    if squares.min() < -1e-9 * max(float(np.abs(squares).max()), 1e-300):
        return None
    if np.linalg.det(axes) < 0.0:
        axes[:, 2] *= -1.0
    matrix = np.eye(4)
    matrix[:3, :3] = axes
    edges = np.sqrt(np.maximum(squares, 0.0))
    size = (float(edges[0]), float(edges[1]), float(edges[2]))
    return size, inertial.T_link_com @ Pose.from_matrix(matrix)


def scene_points(scene: RayScene) -> dict[str, NDArray[np.float64]]:
    """Return, by model name, points whose hull holds all that a scene shows of it.

    They are (n, 3), m, in the world.

    Flat squares on the ground would be all there is to see of a world: planes are left out.
    """
    found: dict[str, list[NDArray[np.float64]]] = {}
    shapes = {
        (f"{model.name}::{link.name}", visual.name): visual.shape
        for model in scene.world.models
        for link in model.links
        for visual in link.visuals
    }
    for number, instance in enumerate(scene.instances):
        if isinstance(shapes.get((instance.link, instance.name)), Plane):
            continue
        facets = [part.facets.vertices for part in instance.surface.parts if part.facets]
        is_round = any(part.facets is None for part in instance.surface.parts)
        cloud = _round_cloud(facets) if is_round else np.concatenate(facets).astype(np.float64)
        matrix = scene.T_world_surface[number].astype(np.float64)
        model = _model_of(instance.link, scene.world)
        placed: NDArray[np.float64] = cloud @ matrix[:3, :3].T + matrix[:3, 3]
        found.setdefault(model, []).append(placed)
    return {name: np.concatenate(clouds) for name, clouds in found.items()}


def _round_cloud(facets: list[NDArray[np.float32]]) -> NDArray[np.float64]:
    """Return points around a unit sphere, or around a capsule given its tube."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    if not facets:
        axes = np.concatenate([np.eye(3), -np.eye(3)])
        # A cube with a pyramid on each side; its sides are 3/√10 from the centre before scaling.
        return np.asarray(np.concatenate([axes, corners * 0.75]) * (10.0**0.5 / 3.0))
    half = np.abs(np.concatenate(facets)).max(axis=0).astype(np.float64)
    return np.asarray(corners * (half + np.array([0.0, 0.0, half[0]])))


def _model_of(link: str, world: World) -> str:
    """Return the model of ``model::link``; both names may hold ``::`` themselves."""
    names = [model.name for model in world.models if link.startswith(f"{model.name}::")]
    return max(names, key=len, default="")


def _collisions(model: Model, link: Link, size_m: float, diagnostics: Diagnostics) -> list[Visual]:
    paint = _paint(_COLOURS["collisions"])
    return [
        Visual(item.name, item.shape, item.T_link_collision, paint)
        for item in link.collisions
        if not isinstance(item.shape, Plane)
    ]


def _inertia(model: Model, link: Link, size_m: float, diagnostics: Diagnostics) -> list[Visual]:
    if link.inertial is None or model.static:
        return []
    box = equivalent_box(link.inertial)
    if box is None:
        diagnostics.report(
            "picture.no-inertia-box",
            f"link '{link.name}' of '{model.name}': no box has its mass "
            f"{link.inertial.mass_kg:g} kg and its inertia",
            link.inertial.span or link.span,
        )
        return []
    return [Visual("inertia", Box(box[0]), box[1], _paint(_COLOURS["inertia"]))]


def _inertia_edges(
    model: Model, link: Link, size_m: float, diagnostics: Diagnostics
) -> list[Visual]:
    box = None if link.inertial is None or model.static else equivalent_box(link.inertial)
    if box is None:
        return []
    size, T_link_box = box
    paint = _paint(_COLOURS["inertia"], flat=True)
    found = []
    for axis, (xyz, _) in enumerate(_AXES):
        edge = Cylinder(0.002 * size_m, size[axis])
        turn = _from_z(xyz)
        for corner in range(4):
            place = [0.0, 0.0, 0.0]
            place[(axis + 1) % 3] = size[(axis + 1) % 3] * (0.5 if corner & 1 else -0.5)
            place[(axis + 2) % 3] = size[(axis + 2) % 3] * (0.5 if corner & 2 else -0.5)
            T_link_edge = T_link_box @ Pose((place[0], place[1], place[2]), turn)
            found.append(Visual(f"edge_{axis}{corner}", edge, T_link_edge, paint))
    return found


def _mass_centre(model: Model, link: Link, size_m: float, diagnostics: Diagnostics) -> list[Visual]:
    if link.inertial is None or model.static:
        return []
    pose = Pose(link.inertial.T_link_com.position_m)
    return [Visual("com", Sphere(0.014 * size_m), pose, _paint(_COLOURS["com"], flat=True))]


def _joint_axes(model: Model, link: Link, size_m: float, diagnostics: Diagnostics) -> list[Visual]:
    found = []
    for joint in model.joints:
        if joint.child == link.name:
            T_link_joint = link.T_model_link.inverse() @ joint.T_model_joint
            for xyz in _axes_of(joint):
                found += _arrow(T_link_joint, xyz, 0.14 * size_m, 0.004 * size_m, "joints")
    return found


def _axes_of(joint: Joint) -> list[Vector3]:
    return [axis.xyz for axis in (joint.axis, joint.axis2) if axis is not None]


def _frame_axes(model: Model, link: Link, size_m: float, diagnostics: Diagnostics) -> list[Visual]:
    found = []
    for xyz, colour in _AXES:
        found += _arrow(IDENTITY_POSE, xyz, 0.08 * size_m, 0.003 * size_m, "frames", colour)
    return found


def _arrow(
    T_link_start: Pose,
    xyz: Vector3,
    length_m: float,
    radius_m: float,
    name: str,
    colour: Vector3 | None = None,
) -> list[Visual]:
    """Return a shaft and a tip along a direction of the start frame."""
    tip_m = 4.5 * radius_m
    T_link_arrow = T_link_start @ Pose((0.0, 0.0, 0.0), _from_z(xyz))
    paint = _paint(_COLOURS[name] if colour is None else colour, flat=True)
    shaft_m = length_m - tip_m
    pieces: list[tuple[Shape, float]] = [
        (Cylinder(radius_m, shaft_m), shaft_m / 2.0),
        (Cone(2.2 * radius_m, tip_m), shaft_m + tip_m / 2.0),
    ]
    return [
        Visual(f"{name}_{number}", shape, T_link_arrow @ Pose((0.0, 0.0, along)), paint)
        for number, (shape, along) in enumerate(pieces)
    ]


def _from_z(xyz: Vector3) -> tuple[float, float, float, float]:
    """Return the shortest turn that takes +z to a unit vector."""
    if xyz[2] < -0.999999:
        return (1.0, 0.0, 0.0, 0.0)
    x, y, z = cross((0.0, 0.0, 1.0), xyz)
    w = 1.0 + xyz[2]
    size = (x * x + y * y + z * z + w * w) ** 0.5
    return (x / size, y / size, z / size, w / size)


def _paint(colour: Vector3, *, flat: bool = False) -> Material:
    rgba = (*colour, 1.0)
    return Material(ambient=rgba, diffuse=rgba, lighting=not flat)
