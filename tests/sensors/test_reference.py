"""SLAMBOT's museum as recorded from Gazebo Classic 11, pose by pose."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from scipy.optimize import least_squares
from tests.shared_files import skip_module_without_shared

from gazelle.description.model import CameraSpec, LidarSpec, World
from gazelle.description.sdf_reader import read_world_file
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.sensors import RayScene, depth_image, render, scan
from gazelle.workspace import Workspace

skip_module_without_shared()

pytestmark = pytest.mark.reference

CAMERA = CameraSpec(width_px=640, height_px=480, horizontal_fov_rad=1.05, near_m=0.05, far_m=8.0)
LASER = LidarSpec(
    samples=360, min_angle_rad=-3.0, max_angle_rad=3.0, range_min_m=0.1, range_max_m=6.0
)
# The joints of the robot's URDF: base_footprint → base_link → sensor.
T_BASE_CAMERA = Pose((0.0, 0.0, 0.025 + 1.15))
T_BASE_LASER = Pose((0.0, 0.0, 0.025 + 1.09))
SIGMA = 0.0101
PICTURE_OF_POSE = (0.5, 5.0, 4.0, 20.0)
"""Mean difference of colour allowed, of 255; pose 3 stands before a pillar whose wood is a
picture in Gazebo and its mean colour here, pose 0 before a plain wall."""


@dataclass(frozen=True)
class Recording:
    """One pose of sensor_poses.txt."""

    T_world_base: Pose
    ranges_m: NDArray[np.float64]
    depth_m: NDArray[np.float64]


@pytest.fixture(scope="module")
def folder(oracles_dir: Path) -> Path:
    return oracles_dir / "gazebo_slambot"


@pytest.fixture(scope="module")
def museum(workspaces_dir: Path, tmp_path_factory) -> World:
    workspace = Workspace.discover(
        environ={"GAZEBO_MODEL_PATH": str(workspaces_dir / "gazebo_models")},
        cwd=tmp_path_factory.mktemp("empty"),
    )
    file = workspaces_dir / "catkin_ws/src/slam_robot/worlds/slam_robot_world.world"
    world = read_world_file(file, workspace=workspace, diagnostics=Diagnostics())
    assert world is not None
    return world


@pytest.fixture(scope="module")
def recordings(folder: Path) -> list[Recording]:
    found = []
    for text in (folder / "sensor_poses.txt").read_text().split("## pose ")[1:]:
        place = re.search(r"actual x=(\S+) y=(\S+) z=(\S+) yaw=(\S+)", text)
        ranges = re.search(r"inf\): \[(.*?)\]", text)
        assert place is not None
        assert ranges is not None
        x, y, z, yaw = map(float, place.groups())
        lines = [line.split() for line in text.splitlines()]
        grid = [line for line in lines if len(line) == 40 and re.match(r"\d|nan", line[0])]
        found.append(
            Recording(
                Pose.from_xyz_rpy((x, y, z), (0.0, 0.0, yaw)),
                np.array([float(value) for value in ranges[1].split(",")]),
                np.array(grid, float),
            )
        )
    assert len(found) == 4
    return found


def test_depth_is_that_of_gazebo(museum, recordings) -> None:
    scene = RayScene(museum)
    for recording in recordings:
        pose = recording.T_world_base @ T_BASE_CAMERA
        depth = render(scene, CAMERA, pose, want_rgb=False, want_depth=True).depth_m
        ours = depth_image(depth, near_m=0.4, far_m=5.0)[8::32, 8::16]
        theirs = recording.depth_m
        assert np.array_equal(np.isfinite(ours), np.isfinite(theirs))
        both = np.isfinite(theirs)
        assert np.median(np.abs(ours - theirs)[both]) < 0.003
        # Gazebo's cylinders have 32 sides: up to 2.4 mm of a radius of 0.5 m, more at their rims.
        assert np.abs(ours - theirs)[both].max() < 0.012


def test_scans_are_those_of_gazebo(museum, recordings) -> None:
    scene = RayScene(museum, kind="collisions")
    for recording in recordings:
        ranges = scan(scene, LASER, recording.T_world_base @ T_BASE_LASER).ranges_m[0]
        # Means of 8 scans of a robot that creeps: the ends of walls blur by a ray.
        both = np.isfinite(ranges) & np.isfinite(recording.ranges_m)
        assert (np.isfinite(ranges) != np.isfinite(recording.ranges_m)).sum() <= 4
        off = recording.ranges_m[both] - ranges[both]
        assert np.median(np.abs(off)) < SIGMA / 2
        assert abs(np.mean(off)) < SIGMA / 2


def test_pinhole_is_that_of_gazebo(museum, folder) -> None:
    # Every pixel sees one wall; its pose is fitted, so only the camera's shape is compared.
    theirs = np.load(folder / "depth_image.npy")
    scene = RayScene(museum)

    def off(found: NDArray[np.float64]) -> NDArray[np.float64]:
        pose = Pose.from_xyz_rpy(
            (1.1485 + found[0], -0.1508, 1.175), (found[2], found[3], found[1])
        )
        depth = render(scene, CAMERA, pose, want_rgb=False, want_depth=True).depth_m
        return (depth - theirs).astype(float)[::20, ::20].ravel()

    fit = least_squares(off, np.array([0.0, 0.09, 0.0, 0.0]), diff_step=1e-4)
    assert np.abs(off(fit.x)).max() < 2e-4


def test_colours_are_those_of_gazebo(museum, recordings, folder) -> None:
    # The recorded pictures show no shadows: the software renderer drew none.
    scene = RayScene(replace(museum, scene=replace(museum.scene, shadows=False)))
    for number, recording in enumerate(recordings):
        pose = recording.T_world_base @ T_BASE_CAMERA
        ours = render(scene, CAMERA, pose).rgb.astype(int)
        with Image.open(folder / f"rgb_pose{number}.png") as picture:
            theirs = np.asarray(picture.convert("RGB")).astype(int)
        assert np.abs(ours - theirs).mean() < PICTURE_OF_POSE[number]


def test_walls_have_gazebos_very_colour(museum, recordings, folder) -> None:
    scene = RayScene(museum)
    ours = render(scene, CAMERA, recordings[0].T_world_base @ T_BASE_CAMERA).rgb
    with Image.open(folder / "rgb_pose0.png") as picture:
        assert np.array_equal(ours, np.asarray(picture.convert("RGB")))
