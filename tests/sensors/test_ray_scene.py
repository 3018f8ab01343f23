"""Instances follow their links, and only those that moved are touched."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gazelle.description.model import (
    Box,
    Heightmap,
    LidarSpec,
    Light,
    LightType,
    MeshShape,
    Polyline,
    Sphere,
)
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import Pose
from gazelle.sensors import RayScene, scan

FORWARD = LidarSpec(samples=1, range_max_m=100.0)
DOWN = Pose.from_xyz_rpy((0.0, 0.0, 10.0), (0.0, np.pi / 2, 0.0))
CUBE_OBJ = """
o cube
v -.5 -.5 -.5
v .5 -.5 -.5
v .5 .5 -.5
v -.5 .5 -.5
v -.5 -.5 .5
v .5 -.5 .5
v .5 .5 .5
v -.5 .5 .5
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


def _ahead(scene: RayScene, pose: Pose = Pose()) -> float:  # noqa: B008 (frozen)
    return float(scan(scene, FORWARD, pose).ranges_m[0, 0])


@pytest.fixture
def cube(tmp_path: Path) -> Path:
    file = tmp_path / "cube.obj"
    file.write_text(CUBE_OBJ)
    return file


def test_update_moves_the_links_that_moved(scene_of, link, poses) -> None:
    scene = scene_of(
        link("a", Box((1, 1, 1)), Pose((3, 0, 0))), link("b", Sphere(1), Pose((9, 0, 0)))
    )
    start = poses(a=Pose((3, 0, 0)), b=Pose((9, 0, 0)))
    assert scene.update(start) == 2
    assert scene.update(start) == 0
    moved = replace(start, T=start.T.copy())
    moved.T[0, :3] = (3, 5, 0)
    assert scene.update(moved) == 1
    assert _ahead(scene) == pytest.approx(8.0, abs=1e-3)
    assert scene.link_pose("thing::a").position_m == (3, 5, 0)


def test_turned_links_turn_their_shapes(scene_of, link, poses) -> None:
    scene = scene_of(link("beam", Box((4.0, 1.0, 1.0)), Pose((5, 0, 0))))
    assert _ahead(scene) == pytest.approx(3.0, abs=1e-3)
    scene.update(poses(beam=Pose.from_xyz_rpy((5, 0, 0), (0, 0, np.pi / 2))))
    assert _ahead(scene) == pytest.approx(4.5, abs=1e-3)


def test_links_without_a_pose_in_the_snapshot_stay(scene_of, link, poses) -> None:
    scene = scene_of(link("wall", Box((1, 9, 9)), Pose((3, 0, 0))), link("robot", Sphere(0.1)))
    assert scene.update(poses(robot=Pose((0, 7, 0)))) == 1
    assert _ahead(scene) == pytest.approx(2.5, abs=1e-3)
    assert scene.link_pose("thing::wall").position_m == (3, 0, 0)


def test_unknown_link_names_are_refused(scene_of, link) -> None:
    with pytest.raises(KeyError):
        scene_of(link("wall", Sphere(1))).link_pose("thing::wal")


def test_rebuild_takes_over_another_world(scene_of, world_of, link, poses) -> None:
    scene = scene_of(link("a", Box((1, 1, 1)), Pose((3, 0, 0))))
    scene.update(poses(a=Pose((50, 0, 0))))
    revision = scene.revision
    scene.rebuild(world_of(link("a", Box((1, 1, 1)), Pose((6, 0, 0)))))
    assert scene.revision == revision + 1
    assert _ahead(scene) == pytest.approx(5.5, abs=1e-3)
    scene.update(poses(a=Pose((8, 0, 0))))
    assert _ahead(scene) == pytest.approx(7.5, abs=1e-3)


def test_empty_world_shows_nothing(scene_of) -> None:
    assert _ahead(scene_of()) == np.inf


def test_equal_meshes_share_one_surface(scene_of, link, cube) -> None:
    big = MeshShape("cube.obj", cube, scale=(2.0, 2.0, 2.0))
    flat = MeshShape("cube.obj", cube, scale=(1.0, 1.0, -0.5))
    scene = scene_of(link("big", big, Pose((5, 0, 0))), link("flat", flat, Pose((0, 0, 5))))
    assert scene.instances[0].surface is scene.instances[1].surface
    assert _ahead(scene) == pytest.approx(4.0, abs=1e-3)
    assert _ahead(scene, DOWN) == pytest.approx(4.75, abs=1e-3)


def test_missing_mesh_leaves_the_rest(scene_of, link) -> None:
    gone = link("gone", MeshShape("package://x/gone.stl", None))
    scene = scene_of(gone, link("wall", Box((1, 1, 1)), Pose((3, 0, 0))))
    assert [item.link for item in scene.instances] == ["thing::wall"]


def test_unknown_submesh_is_reported_with_the_names_there_are(scene_of, link, cube) -> None:
    span = SourceSpan("robot.sdf", 7, 3)
    shape = MeshShape("cube.obj", cube, submesh="cubes", span=span)
    scene = scene_of(link("part", shape))
    (found,) = scene.diagnostics.by_code("sensors.unknown-submesh")
    assert found.span == span
    assert "did you mean 'cube'?" in found.message


def test_unreadable_heightmap_is_reported(scene_of, link, tmp_path) -> None:
    file = tmp_path / "hills.png"
    file.write_text("no picture")
    scene = scene_of(link("hills", Heightmap("hills.png", file)))
    (found,) = scene.diagnostics.by_code("sensors.unusable-shape")
    assert "heightmap cannot be shown" in found.message
    assert not scene.instances


def test_heightmap_rises_with_brightness(scene_of, link, tmp_path) -> None:
    file = tmp_path / "hills.png"
    Image.fromarray(np.tile(np.array([[0, 255]], np.uint8), (2, 1))).save(file)
    scene = scene_of(link("hills", Heightmap("hills.png", file, (4.0, 4.0, 2.0))))
    for x, height in ((-1.0, 0.5), (1.0, 1.5)):
        down = Pose((x, 0.3, 10.0), DOWN.quat_xyzw)
        assert _ahead(scene, down) == pytest.approx(10.0 - height, abs=1e-3)


def test_polyline_is_extruded(scene_of, link) -> None:
    outline = ((-1.0, -1.0), (1.0, -1.0), (0.0, 1.0))
    scene = scene_of(link("wedge", Polyline((outline,), 3.0)))
    assert _ahead(scene, DOWN) == pytest.approx(7.0, abs=1e-3)


def test_lights_on_links_move_with_them(link, world_of, poses) -> None:
    lamp = Light("lamp", LightType.POINT, Pose((0.0, 0.0, 1.0)))
    carrier = replace(link("robot", Sphere(0.1)), lights=(lamp,))
    scene = RayScene(world_of(carrier))
    scene.update(poses(robot=Pose((4.0, 0.0, 0.0))))
    (placed,) = scene.lights()
    assert placed.link == "thing::robot"
    assert placed.T_world_light.position_m == (4.0, 0.0, 1.0)
