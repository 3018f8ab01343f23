"""A solid that nobody knows by its class is a solid everywhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from gazelle.description.checks.shape_volumes import shape_body, shape_points_m
from gazelle.description.model import Collision, Link, Model, Solid, Visual, World
from gazelle.description.writers.geometry_elements import as_mesh, urdf_pieces
from gazelle.diagnostics import Diagnostics
from gazelle.engine.collision_geoms import geom_shapes
from gazelle.geometry import MassProperties, Mesh, MeshPart, Pose, mesh_mass_properties
from gazelle.interfaces import message_type
from gazelle.motion.collision.convex_solids import object_solids
from gazelle.motion.scene import WorldObject
from gazelle.nodes.move_group.shape_messages import add_shapes
from gazelle.sensors.ray_surfaces import surface_of
from gazelle.sensors.scene_json import world_value
from gazelle.studio.scenes.assets import Assets
from gazelle.studio.scenes.shapes import page_scene

_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))


@dataclass(frozen=True, slots=True)
class Corner(Solid):
    """A corner of a box: its apex is the origin, its legs lie on the axes."""

    word: ClassVar[str] = "corner"
    usual: ClassVar = ((1.0, 1.0, 1.0),)

    legs_m: tuple[float, float, float]

    def body(self, density_kg_m3: float) -> MassProperties:
        return mesh_mass_properties(Mesh((self.mesh(),)), density_kg_m3=density_kg_m3)

    def mesh(self) -> MeshPart:
        corners = np.vstack([np.zeros(3), np.diag(self.legs_m)])
        faces = np.array(_FACES, np.int32)
        return MeshPart("corner", corners, faces, np.tile([0.0, 0.0, 1.0], (4, 1)))


CORNER = Corner((1.0, 2.0, 3.0))


def test_it_has_mass_and_extent() -> None:
    told = Diagnostics()
    body = shape_body(CORNER, 2.0, told)
    assert body is not None
    assert body.mass_kg == pytest.approx(2.0)
    assert body.center_m == pytest.approx((0.25, 0.5, 0.75))
    assert shape_points_m(CORNER, told).max(axis=0).tolist() == [1.0, 2.0, 3.0]
    assert not list(told)


def test_a_urdf_has_it_as_a_mesh() -> None:
    assert urdf_pieces(CORNER, has_capsules=True) == ()
    word, stl = as_mesh(CORNER) or ("", b"")
    assert (word, len(stl)) == ("corner", 84 + 4 * 50)


def test_it_collides_as_its_hull() -> None:
    told = Diagnostics()
    collision = Collision("c", CORNER)
    (geom,) = geom_shapes(collision, "c", static=False, scenery=False, diagnostics=told)
    assert geom.hull_m is not None
    assert geom.hull_m.max(axis=0).tolist() == [1.0, 2.0, 3.0]
    (solid,) = object_solids(WorldObject.single("thing", CORNER, Pose()), told)
    assert solid.shape.hull_m is not None
    assert not list(told)


def test_rays_meet_its_triangles() -> None:
    found = surface_of(CORNER, Diagnostics(), endless=True)
    assert found is not None
    surface, matrix = found
    assert matrix.tolist() == np.eye(4).tolist()
    assert surface.parts[0].facets is not None
    assert surface.parts[0].facets.faces.tolist() == [list(row) for row in _FACES]


def test_the_page_gets_its_triangles() -> None:
    link = Link("l", visuals=(Visual("v", CORNER),))
    value = world_value(World("w", models=(Model("m", links=(link,)),)))
    (body,) = page_scene(value, Assets())["bodies"]
    geometry = body["visuals"][0]["geometry"]
    assert geometry["type"] == "mesh"
    assert len(geometry["parts"]) == 1


def test_a_message_has_it_as_a_mesh() -> None:
    message = message_type("moveit_msgs/msg/CollisionObject")()
    add_shapes(message, WorldObject.single("thing", CORNER, Pose()).shapes)
    (mesh,) = message.meshes
    assert (len(mesh.vertices), len(mesh.triangles)) == (4, 4)
    assert not message.primitives
