"""Shapes of links and things as the convex solids that are collided."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gazelle.description.model import Collision
from gazelle.diagnostics import Diagnostics
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.shapes import GeomShape, geom_shapes
from gazelle.geometry import Mesh, MeshError, MeshPart, Pose, convex_hull, convex_parts
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import SceneMesh, SceneShape, WorldObject

__all__ = ["Solid", "link_solids", "object_solids"]


class Solid(NamedTuple):
    """A convex solid in the frame of its link or thing."""

    shape: GeomShape
    T_owner_shape: Pose


def link_solids(robot: RobotModel, diagnostics: Diagnostics) -> dict[str, tuple[Solid, ...]]:
    """Return the solids of all links that have collisions; concave meshes are several.

    Args:
        robot: the robot.
        diagnostics: receives what cannot be collided, the first time a robot is asked for.
    """
    found, told = _link_solids(robot)
    diagnostics.extend(told)
    return found


def object_solids(item: WorldObject, diagnostics: Diagnostics) -> tuple[Solid, ...]:
    """Return the solids of a thing.

    Args:
        item: the thing.
        diagnostics: receives what cannot be collided.
    """
    found: list[Solid] = []
    for placed in item.shapes:
        shapes = _solids_of(placed.shape, item.name, diagnostics)
        found += [Solid(shape, placed.T_object_shape @ shape.T_collision_geom) for shape in shapes]
    return tuple(found)


@lru_cache(maxsize=8)
def _link_solids(robot: RobotModel) -> tuple[dict[str, tuple[Solid, ...]], Diagnostics]:
    told = Diagnostics()
    found: dict[str, tuple[Solid, ...]] = {}
    for link in robot.description.links:
        solids: list[Solid] = []
        for collision in link.collisions:
            shapes = geom_shapes(
                collision, f"{link.name}::{collision.name}",
                static=False, scenery=False, diagnostics=told,
            )  # fmt: skip
            pose = collision.T_link_collision
            solids += [Solid(shape, pose @ shape.T_collision_geom) for shape in shapes]
        if solids:
            found[link.name] = tuple(solids)
    return found, told


def _solids_of(shape: SceneShape, name: str, diagnostics: Diagnostics) -> tuple[GeomShape, ...]:
    if not isinstance(shape, SceneMesh):
        collision = Collision(name, shape)
        return geom_shapes(collision, name, static=True, scenery=True, diagnostics=diagnostics)
    try:
        parts = _parts_of(shape)
    except (MeshError, ValueError) as error:
        message = f"the mesh of object '{name}' cannot be used ({error}); it does not collide"
        diagnostics.report("engine.bad-mesh", message)
        return ()
    kind = mujoco.mjtGeom.mjGEOM_MESH
    return tuple(
        GeomShape(kind, hull_m=np.ascontiguousarray(part.vertices_m, np.float64)) for part in parts
    )


@lru_cache(maxsize=64)
def _parts_of(mesh: SceneMesh) -> tuple[MeshPart, ...]:
    if not len(mesh.faces):
        return (convex_hull(mesh.vertices_m),)
    faces = np.ascontiguousarray(mesh.faces, np.int32)
    vertices = np.array(mesh.vertices_m, np.float64)
    part = MeshPart("", vertices, faces, np.zeros_like(vertices))
    return convex_parts(Mesh((part,))).parts
