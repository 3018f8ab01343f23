"""Maps turtlebot3_world with a robot that drives in the simulator, against the world's geometry.

python benchmarks/soak/slam_turtlebot3.py WORKSPACE [--models burger waffle] [--slip SHARE]

WORKSPACE is turtlebot3_ws. The robot is driven along a tour by its true pose, in lock-step; scans
come from its lidar with the lidar's noise, odometry from its wheels' plug-in. `--slip` makes
odometry worse: each motion errs by that share, with a steady drift of a tenth of it in rad/m. Told:

- walls: the share of the map's occupied cells that lie within 5 cm of a surface which the lidar's
  plane cuts, with the map's frame where the robot really began;
- trajectory: the distance of each scan's pose from the true one, after the best rigid alignment of
  the whole trajectory, and the difference in heading: mean and greatest.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from gazelle.description.model import Cylinder, MeshShape
from gazelle.description.writers.geometry_elements import mesh_of
from gazelle.geometry import Pose
from gazelle.interfaces.poses import twist_message
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.relative_pose_error import alignment
from gazelle.mapping.se2 import between, compose, transform_points
from gazelle.mapping.slam import Slam, SlamResult
from gazelle.nodes.slam.scan_messages import scan_of
from gazelle.simulator import Simulation
from gazelle.workspace import Workspace

START = (-2.0, -0.5, 0.0)
TOUR = np.array([
    (-1.65, -0.55), (-0.55, -0.55), (0.55, -0.55), (1.65, -0.55), (1.65, 0.55), (0.55, 0.55),
    (0.55, 1.7), (-0.55, 1.7), (-0.55, 0.55), (-1.7, 0.55), (-1.7, -0.55), (-0.55, -0.55),
    (-0.55, -1.7), (0.55, -1.7), (0.55, -0.55), (0.55, 0.55), (-0.55, 0.55), (-0.55, -0.55),
    (-2.0, -0.5),
])  # fmt: skip
LIMITS = 0.05, 1.0


class Drive(NamedTuple):
    """What a robot recorded, and where it was.

    Attributes:
        records: scans with odometry.
        truth: poses of the robot, (n, 3).
        walls: segments that the lidar's plane cuts out of the world, (m, 2, 2), metres.
    """

    records: list[tuple[Scan, np.ndarray]]
    truth: np.ndarray
    walls: np.ndarray


class Quality(NamedTuple):
    """How good a map is, see the module."""

    walls: float
    mean_m: float
    most_m: float
    mean_deg: float
    most_deg: float

    def __str__(self) -> str:
        return (
            f"{100 * self.walls:.1f} % of wall cells within 5 cm; trajectory off by "
            f"{self.mean_m:.3f} m, {self.mean_deg:.2f}°, at most {self.most_m:.3f} m, "
            f"{self.most_deg:.2f}°"
        )


def driven(workspace: Path, model: str, tour: np.ndarray = TOUR) -> Drive:
    """Drive a robot along a tour."""
    sources = workspace / "src"
    packages = Workspace.discover(
        environ={
            "ROS_PACKAGE_PATH": str(sources),
            "GAZEBO_MODEL_PATH": str(sources / "turtlebot3_simulations/turtlebot3_gazebo/models"),
        },
        cwd=Path("/"),
    )
    urdf = packages.package("turtlebot3_description").path / f"urdf/turtlebot3_{model}.urdf.xacro"
    world = packages.package("turtlebot3_gazebo").path / "worlds/turtlebot3_world.world"
    pose = Pose((START[0], START[1], 0.0))
    with Simulation.load(urdf, world=world, name="robot", pose=pose, workspace=packages) as sim:
        return _recorded(sim, tour)


def _recorded(sim: Simulation, tour: np.ndarray) -> Drive:
    robot, found = sim.model("robot"), list[Any]()
    sim.subscribe("/scan", found.append)
    odometry: list[Any] = []
    sim.subscribe("/odom", odometry.append)
    mount = robot.link("base_scan").pose
    T_base_laser = robot.link("base_footprint").pose.inverse() @ mount
    records, truth = [], []
    for forward, turn in _commands(robot, tour):
        sim.publish("/cmd_vel", twist_message((forward, 0.0, 0.0), (0.0, 0.0, turn)))
        before, odometry[:] = len(found), odometry[-1:]
        while len(found) == before:
            sim.step(5)
        pose = odometry[-1].pose.pose
        x, y, z, w = (getattr(pose.orientation, name) for name in "xyzw")
        odo = Pose((pose.position.x, pose.position.y, 0.0), (x, y, z, w))
        records.append((scan_of(found[-1], T_base_laser), np.array(odo.xy_yaw)))
        truth.append(robot.link("base_footprint").pose.xy_yaw)
    return Drive(records, np.array(truth), _cut(sim, mount.position_m[2]))


def _commands(robot: Any, tour: np.ndarray) -> Iterator[tuple[float, float]]:
    """Yield speeds, forward and turning, until the last place is reached."""
    for x, y in tour:
        while True:
            pose = robot.link("base_footprint").pose.xy_yaw
            dx, dy = x - pose[0], y - pose[1]
            if math.hypot(dx, dy) < 0.15:
                break
            off = math.remainder(math.atan2(dy, dx) - pose[2], math.tau)
            yield 0.22 * max(0.0, math.cos(off)) ** 4, max(-0.8, min(0.8, 1.5 * off))


def _cut(sim: Simulation, height_m: float) -> np.ndarray:
    """Return what a level plane cuts out of everything that does not move."""
    parts = []
    for model in sim.world.models:
        for link in model.links if model.static else ():
            for collision in link.collisions:
                pose = model.T_world_model @ link.T_model_link @ collision.T_link_collision
                parts.append(_shape_cut(collision.shape, pose, height_m))
    return np.concatenate([part for part in parts if len(part)])


def _shape_cut(shape: Any, pose: Pose, height_m: float) -> np.ndarray:
    if isinstance(shape, Cylinder):
        ring = np.linspace(0, math.tau, 73)
        circle = shape.radius_m * np.stack([np.cos(ring), np.sin(ring)], axis=-1)
        around = np.array(pose.position_m[:2]) + circle
        return np.stack([around[:-1], around[1:]], axis=1)
    mesh = mesh_of(shape) if isinstance(shape, MeshShape) else None
    if mesh is None:
        return np.empty((0, 2, 2))
    corners = pose.transform(mesh.vertices_m)[mesh.faces]
    above = corners[..., 2] > height_m
    crossed = corners[above.any(axis=1) & ~above.all(axis=1)]
    return np.array([_chord(triangle, height_m) for triangle in crossed]).reshape(-1, 2, 2)


def _chord(triangle: np.ndarray, height_m: float) -> np.ndarray:
    ends = []
    for a, b in zip(triangle, np.roll(triangle, -1, axis=0), strict=True):
        if (a[2] > height_m) != (b[2] > height_m):
            ends.append((a + (b - a) * (height_m - a[2]) / (b[2] - a[2]))[:2])
    return np.array(ends)


def slipping(drive: Drive, share: float, seed: int = 0) -> Drive:
    """Return the drive with worse odometry."""
    rng = np.random.default_rng(seed)
    odometry = np.array([pose for _, pose in drive.records])
    steps = between(odometry[:-1], odometry[1:])
    way = np.hypot(steps[:, 0], steps[:, 1])
    steps *= 1 + rng.normal(0, share, steps.shape)
    steps[:, 2] += 0.1 * share * way
    poses = [odometry[0]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    scans = [scan for scan, _ in drive.records]
    return drive._replace(records=list(zip(scans, poses, strict=True)))


def mapped(drive: Drive) -> SlamResult:
    """Return the map of a drive."""
    engine = Slam()
    for scan, odometry in drive.records:
        engine.add(scan, odometry)
    engine.finish()
    return engine.result()


def quality(drive: Drive, result: SlamResult) -> Quality:
    """Return how good a map is."""
    grid = result.grid
    rows, columns = np.nonzero(grid.cells == 100)
    cells = np.stack(grid.cell_to_world(columns, rows), axis=-1)
    points = transform_points(drive.truth[0], cells)
    starts, along = drive.walls[:, 0], drive.walls[:, 1] - drive.walls[:, 0]
    away = points[:, None] - starts
    share = (away * along).sum(-1) / np.maximum((along**2).sum(-1), 1e-12)
    gap = away - np.clip(share, 0, 1)[..., None] * along
    near = np.hypot(gap[..., 0], gap[..., 1]).min(axis=1) < LIMITS[0]
    moved = compose(alignment(result.trajectory, drive.truth), result.trajectory)
    error = between(drive.truth, moved)
    off_m, off_deg = np.hypot(error[:, 0], error[:, 1]), np.degrees(np.abs(error[:, 2]))
    return Quality(
        float(near.mean()), float(off_m.mean()), float(off_m.max()),
        float(off_deg.mean()), float(off_deg.max()),
    )  # fmt: skip


def main(argv: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("workspace", type=Path)
    parser.add_argument("--models", nargs="+", default=["burger", "waffle"])
    parser.add_argument("--slip", type=float, default=0.1)
    told = parser.parse_args(argv)
    bad = 0
    for model in told.models:
        drive = driven(told.workspace, model)
        for name, one in (("as it is", drive), ("slipping", slipping(drive, told.slip))):
            found = quality(one, mapped(one))
            print(f"{model}, odometry {name}, {len(one.records)} scans: {found}", flush=True)
            bad += found.walls < 0.95 or found.most_m > LIMITS[0] or found.most_deg > LIMITS[1]
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
