"""Collision shapes, meshes and terrains."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gazelle.description.model import (
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Heightmap,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    MeshShape,
    Model,
    Plane,
    Polyline,
    Sphere,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.engine.collision_meshes import ear_clipped, surface_pieces
from gazelle.engine.primitive_fitting import fitted_round_shape
from gazelle.geometry import (
    ConvexParts,
    Mesh,
    Pose,
    box_mesh,
    convex_hull,
    cylinder_mesh,
    mesh_volume_m3,
    polyline_mesh,
    sphere_mesh,
)

SMALL = Inertial(1.0, inertia_kg_m2=(0.01, 0, 0, 0.01, 0, 0.01))


def thing(shape, pose=None, static=False, T_link_collision=None):
    collision = Collision("c", shape, T_link_collision or Pose())
    link = Link("l", inertial=None if static else SMALL, collisions=(collision,))
    return Model("thing", pose or Pose((0, 0, 1)), static=static, links=(link,))


def write_stl(path: Path, vertices, faces) -> Path:
    lines = ["solid mesh"]
    for face in faces:
        lines.append("facet normal 0 0 0\nouter loop")
        lines += [f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in np.asarray(vertices)[face]]
        lines.append("endloop\nendfacet")
    path.write_text("\n".join([*lines, "endsolid mesh"]))
    return path


def mesh_shape(path, **more):
    return MeshShape(path.name, path, **more)


def rest_height(build, shape):
    engine = build.engine(build.ground(), thing(shape))
    engine.step(2500)
    return engine.model_pose("thing").position_m[2]


@pytest.mark.parametrize(
    ("shape", "height"),
    [
        (Sphere(0.2), 0.2),
        (Cylinder(0.2, 0.1), 0.05),
        (Capsule(0.1, 0.0001), 0.1),
        (Ellipsoid((0.3, 0.3, 0.1)), 0.1),
        (Cone(0.3, 0.2), 0.1),
        (Polyline((((-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (-0.2, 0.2)),), 0.3), 0.0),
    ],
)
def test_shape_rests_on_its_underside(build, shape, height):
    assert rest_height(build, shape) == pytest.approx(height, abs=1e-3)


def test_plane_faces_along_its_normal(build):
    wall = Model(
        "wall", static=True,
        links=(Link("l", collisions=(Collision("c", Plane((-1.0, 0, 0))),)),),
    )  # fmt: skip
    engine = build.engine(wall, build.ball(pose=Pose((-0.5, 0, 0))), gravity_m_s2=(0, 0, 0))
    engine.set_model_velocity("ball", (1.0, 0, 0), (0, 0, 0))
    engine.step(2000)
    assert engine.model_pose("ball").position_m[0] == pytest.approx(-0.1, abs=0.1)


def test_moving_plane_becomes_a_box_and_is_reported():
    diagnostics = Diagnostics()
    Engine(World(models=(thing(Plane(size_m=(2, 2))),)), diagnostics=diagnostics)
    (finding,) = diagnostics.by_code("engine.moving-plane")
    assert "collision 'thing::l::c' is a plane on a link that moves" in finding.message


def test_flat_shape_is_reported():
    diagnostics = Diagnostics()
    Engine(World(models=(thing(Sphere(0.0)),)), diagnostics=diagnostics)
    (finding,) = diagnostics.by_code("engine.flat-shape")
    assert "has a size of zero or less" in finding.message


def test_convex_mesh_rests_like_its_box(build, tmp_path):
    part = box_mesh((0.4, 0.4, 0.2))
    path = write_stl(tmp_path / "box.stl", part.vertices_m, part.faces)
    assert rest_height(build, mesh_shape(path, scale=(1, 1, 0.5))) == pytest.approx(0.05, abs=1e-4)


def test_tessellated_cylinder_and_sphere_are_recognised():
    for part, radius, half in ((cylinder_mesh(0.3, 0.2), 0.3, 0.1), (sphere_mesh(0.3), 0.3, None)):
        hull = convex_hull(part.vertices_m)
        found = fitted_round_shape(hull.vertices_m, mesh_volume_m3(Mesh((hull,))))
        assert found is not None
        assert found.radius_m == pytest.approx(radius, rel=2e-3)
        assert found.half_length_m == pytest.approx(half) if half else found.half_length_m is None


@pytest.mark.parametrize("corners", [6, 12])
def test_coarse_prism_stays_a_prism(corners):
    angles = np.linspace(0, 2 * math.pi, corners, endpoint=False)
    rim = np.stack([np.cos(angles), np.sin(angles), 0 * angles], 1)
    points = np.vstack([rim, rim + np.array([0, 0, 1])])
    assert fitted_round_shape(points, 3.0) is None


def test_turned_cylinder_keeps_its_pose():
    pose = Pose.from_xyz_rpy((1, 2, 3), (0.4, 0.5, 0.6))
    points = pose.transform(np.asarray(cylinder_mesh(0.3, 0.2).vertices_m))
    hull = convex_hull(points)
    found = fitted_round_shape(hull.vertices_m, mesh_volume_m3(Mesh((hull,))))
    assert found is not None
    assert found.T_mesh_shape.position_m == pytest.approx((1, 2, 3), abs=1e-6)
    axis = np.array(found.T_mesh_shape.rotate((0, 0, 1)))
    assert abs(axis @ pose.rotate((0, 0, 1))) == pytest.approx(1.0)


def room(tmp_path):
    """A floor and four walls, 2 m wide inside, in one file."""
    slabs = [((2.2, 2.2, 0.1), (0, 0, -0.45))]
    slabs += [((0.1, 2.2, 0.9), (x, 0, 0.05)) for x in (-1.05, 1.05)]
    slabs += [((2.0, 0.1, 0.9), (0, y, 0.05)) for y in (-1.05, 1.05)]
    corners = []
    for size, center in slabs:
        part = box_mesh(size)
        corners.append((np.asarray(part.vertices_m) * 0.999 + np.array(center))[part.faces])
    soup = np.concatenate(corners)
    faces = np.arange(soup.size // 3).reshape(-1, 3)
    return write_stl(tmp_path / "room.stl", soup.reshape(-1, 3), faces)


def test_robot_stays_inside_a_resting_hollow_mesh(build, tmp_path):
    house = thing(mesh_shape(room(tmp_path)), Pose((0, 0, 0.5)), static=True)
    engine = build.engine(house, build.block(pose=Pose((0, 0, 0.4)), edge=0.2))
    engine.set_model_velocity("block", (2.0, 0, 0), (0, 0, 0))
    engine.step(1500)
    x, y, z = engine.model_pose("block").position_m
    assert abs(x) < 0.95 and abs(y) < 0.95 and 0.15 < z < 0.3


def test_open_resting_mesh_is_a_shell_of_thin_solids(build, tmp_path):
    """A funnel without lid: one can be inside although it has no volume."""
    angles = np.linspace(0, 2 * math.pi, 9)
    top = np.stack([np.cos(angles), np.sin(angles), 0 * angles + 0.5], 1)
    soup = np.array([[top[i], (0, 0, 0), top[i + 1]] for i in range(8)])[:, ::-1]
    path = write_stl(tmp_path / "cone.stl", soup.reshape(-1, 3), np.arange(24).reshape(-1, 3))
    diagnostics = Diagnostics()
    funnel = thing(mesh_shape(path), Pose((0, 0, 0)), static=True)
    ball = build.ball(pose=Pose((0.3, 0, 0.6)))
    engine = Engine(World(models=(funnel, ball)), diagnostics=diagnostics)
    engine.step(4000)
    x, y, z = engine.model_pose("ball").position_m
    assert math.hypot(x, y) < 0.3 and 0.08 < z < 0.3
    (finding,) = diagnostics.by_code("engine.hollow-mesh")
    assert "it is not closed and collides as 8 convex pieces" in finding.message


@pytest.mark.parametrize("static", [True, False])
def test_shreds_of_a_mesh_do_not_collide(tmp_path, static):
    """CAD drawings have triangles of no area and parts too small to see."""
    angles = np.linspace(0, 2 * math.pi, 9)
    top = np.stack([np.cos(angles), np.sin(angles), 0 * angles + 0.5], 1)
    sliver = np.array([(0.0, 0.0, 0.0), (1e-4, 0.0, 0.0), (5e-5, 1e-9, 0.0)])
    shred = [sliver, sliver + np.array([2.0, 0.0, 0.0])]
    soup = np.array([*([top[i + 1], (0, 0, 0), top[i]] for i in range(8)), *shred])
    faces = np.arange(len(soup) * 3).reshape(-1, 3)
    path = write_stl(tmp_path / "cone.stl", soup.reshape(-1, 3), faces)
    engine = Engine(World(models=(thing(mesh_shape(path), static=static),)))
    assert engine.model.ngeom == (8 if static else 1)


def test_open_mesh_of_a_fixed_base_is_its_hull(tmp_path):
    """The base of an arm is finely drawn: its surface would be thousands of solids."""
    angles = np.linspace(0, 2 * math.pi, 9)
    top = np.stack([np.cos(angles), np.sin(angles), 0 * angles + 0.5], 1)
    soup = np.array([[top[i + 1], (0, 0, 0), top[i]] for i in range(8)])
    path = write_stl(tmp_path / "cone.stl", soup.reshape(-1, 3), np.arange(24).reshape(-1, 3))
    base = Link("base", inertial=SMALL, collisions=(Collision("c", mesh_shape(path), Pose()),))
    arm = Link("arm", inertial=SMALL)
    joints = (
        Joint("foot", JointType.FIXED, "world", "base"),
        Joint("elbow", JointType.CONTINUOUS, "base", "arm", axis=JointAxis()),
    )
    engine = Engine(World(models=(Model("robot", Pose(), links=(base, arm), joints=joints),)))
    assert engine.model.ngeom == 1


def test_surface_of_a_box_is_six_prisms():
    part = box_mesh((1.0, 2.0, 3.0))
    pieces = surface_pieces(np.asarray(part.vertices_m), np.asarray(part.faces))
    assert len(pieces) == 6
    assert max(np.abs(piece).max() for piece in pieces) <= 1.5 + 1e-9


def test_l_shaped_face_is_not_filled():
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    triangles = ear_clipped(outline)
    points = np.array([[(x, y, 0.0) for x, y in triangle] for triangle in triangles])
    faces = np.arange(points.size // 3, dtype=np.int32).reshape(-1, 3)
    pieces = surface_pieces(points.reshape(-1, 3), faces)
    assert len(pieces) == len(triangles) == 4


def test_ears_cover_the_outline():
    outline = [(0, 0), (4, 0), (4, 3), (2, 1), (0, 3)]
    area = sum(
        abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
        for a, b, c in ear_clipped(outline)
    )
    assert area == pytest.approx(8.0)


def test_unreadable_mesh_is_reported(tmp_path):
    path = tmp_path / "bad.stl"
    path.write_text("nothing")
    diagnostics = Diagnostics()
    Engine(World(models=(thing(mesh_shape(path)),)), diagnostics=diagnostics)
    (finding,) = diagnostics.by_code("engine.bad-mesh")
    assert "the mesh 'bad.stl' of collision 'thing::l::c' cannot be used" in finding.message


def terrain(tmp_path):
    from PIL import Image

    ramp = np.tile(np.linspace(0, 255, 65).astype(np.uint8), (65, 1))
    path = tmp_path / "ramp.png"
    Image.fromarray(ramp).save(path)
    return Heightmap("ramp.png", path, (8.0, 8.0, 2.0))


def test_ball_rests_on_a_heightmap(build, tmp_path):
    ground = thing(terrain(tmp_path), Pose(), static=True)
    engine = build.engine(ground, build.ball(pose=Pose((2.0, 0, 1.8))))
    engine.step(330)
    height = engine.model_pose("ball").position_m[2]
    assert height == pytest.approx(1.5 + 0.1 / math.cos(math.atan(0.25)), abs=0.03)


def test_moving_terrain_and_bad_image_are_reported(tmp_path):
    diagnostics = Diagnostics()
    Engine(World(models=(thing(terrain(tmp_path)),)), diagnostics=diagnostics)
    assert len(diagnostics.by_code("engine.moving-terrain")) == 1
    bad = tmp_path / "bad.png"
    bad.write_text("no image")
    Engine(World(models=(thing(Heightmap("bad.png", bad), static=True),)), diagnostics=diagnostics)
    (finding,) = diagnostics.by_code("engine.unreadable-terrain")
    assert "the heightmap 'bad.png' of collision 'thing::l::c' cannot be read" in finding.message


def test_needles_of_a_large_mesh_are_left_out(tmp_path):
    """MuJoCo keeps corners in single precision, where this triangle is a line; Gazebo loads it."""
    far = "v -34.4 14.06378849 19.3\nv -31.4 14.06378888 19.3\nv -25.7 14.06378824 19.3\n"
    near = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv -4 0 0\n"
    path = tmp_path / "hall.obj"
    path.write_text(f"{far}{near}f 1 2 3\nf 4 5 6\nf 4 6 7\n", encoding="utf-8")
    engine = Engine(World(models=(thing(mesh_shape(path), static=True),)))
    assert engine.model.ngeom == 1


def angle_bracket(tmp_path):
    """A closed L-shaped prism of one piece."""
    outline = ((0.0, 0.0), (2.0, 0.0), (2.0, 0.2), (0.2, 0.2), (0.2, 2.0), (0.0, 2.0))
    part = polyline_mesh((outline,), 1.0)
    return write_stl(tmp_path / "angle.stl", part.vertices_m, part.faces)


@pytest.fixture
def no_coacd(tmp_path, monkeypatch):
    """Nothing splits meshes, and no pieces of them are kept."""

    def hull(mesh):
        return ConvexParts((convex_hull(mesh.vertices_m),), False, "not installed")

    monkeypatch.setattr("gazelle.engine.collision_meshes.convex_parts", hull)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.mark.parametrize("static", [True, False])
def test_without_coacd_resting_meshes_are_shells_and_moving_ones_hulls(tmp_path, no_coacd, static):
    diagnostics = Diagnostics()
    model = thing(mesh_shape(angle_bracket(tmp_path)), static=static)
    engine = Engine(World(models=(model,)), diagnostics=diagnostics)
    (finding,) = diagnostics.by_code("engine.hollow-mesh")
    if static:
        assert "its surface as thin solids, for it rests" in finding.message
        assert engine.model.ngeom > 6
    else:
        assert "pip install 'gazelle-sim[convex]' splits" in finding.message
        assert engine.model.ngeom == 1


def test_hollow_shell_leaves_its_notch_free(build, tmp_path, no_coacd):
    corner = thing(mesh_shape(angle_bracket(tmp_path)), Pose((0, 0, 0)), static=True)
    engine = build.engine(corner, build.ball(pose=Pose((0.8, 0.8, 0.5))), gravity_m_s2=(0, 0, 0))
    engine.set_model_velocity("ball", (-1.0, 0, 0), (0, 0, 0))
    engine.step(200)
    assert engine.model_pose("ball").position_m[0] == pytest.approx(0.6)
    engine.step(1000)
    assert engine.model_pose("ball").position_m[0] > 0.29


def test_models_of_one_mesh_share_its_pieces(tmp_path):
    path = angle_bracket(tmp_path)
    models = tuple(
        replace(thing(mesh_shape(path), Pose((3.0 * index, 0, 0)), static=True), name=f"m{index}")
        for index in range(3)
    )
    model = Engine(World(models=models)).model
    assert model.ngeom == 3 * model.nmesh
    assert Engine(World(models=models[:1])).model.nmesh == model.nmesh
