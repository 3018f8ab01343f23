"""How often amcl finds a TurtleBot3 in turtlebot3_world, near a guess and after a kidnapping.

    python benchmarks/soak/amcl_turtlebot3.py [--workspaces DIR] [--runs N]

Scans are cast in the world's own geometry, cut at the lidar's height. The map is the one that
turtlebot3_navigation brings, whose walls are thick and some centimetres off. A guess is 0.5 m and
30° wrong and counts as mended within 0.1 m and 5° after 40 updates; a kidnapped robot counts as
found when five updates in a row are within 0.2 m and 0.2 rad.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import numpy as np
from scipy.ndimage import distance_transform_edt, label

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from amcl_convergence import TURTLEBOT3  # noqa: E402
from tests.tutorial.rasterised import rasterise  # noqa: E402

from gazelle.diagnostics import Diagnostics  # noqa: E402
from gazelle.mapping.grids import OccupancyGrid, read_map  # noqa: E402
from gazelle.mapping.laser_scan import Scan  # noqa: E402
from gazelle.mapping.se2 import between, compose  # noqa: E402
from gazelle.navigation.localization import Amcl  # noqa: E402
from gazelle.navigation.localization.amcl_kernels import cast_ray  # noqa: E402
from gazelle.workspace import Workspace  # noqa: E402

FINE_M, LIDAR_M, MAX_LENGTH_M, BEAMS = 0.01, 0.172, 3.5, 360
START = (-2.0, -0.5)
T_BASE_LASER = (-0.032, 0.0, 0.0)
NEAREST_M = 0.16


class World:
    """The world's outline in cells of 1 cm."""

    def __init__(self, folder: Path) -> None:
        """Cut the model at the lidar's height."""
        models = folder / "src/turtlebot3_simulations/turtlebot3_gazebo/models"
        environ = {"ROS_PACKAGE_PATH": str(folder / "src"), "GAZEBO_MODEL_PATH": str(models)}
        workspace = Workspace.discover(environ=environ, cwd=folder)
        model = models / "turtlebot3_world/model.sdf"
        self.grid = rasterise(model, workspace, height_m=LIDAR_M, resolution_m=FINE_M)
        self.room_m = distance_transform_edt(self.grid.cells == 0) * FINE_M
        labels, _ = label(self.grid.cells == 0)
        column, row = self.grid.world_to_cell(*START)
        self.inside = labels == labels[row, column]

    def room_at(self, pose: np.ndarray) -> float:
        """Return how far the next wall is, m."""
        column, row = self.grid.world_to_cell(pose[0], pose[1])
        return float(self.room_m[row, column])

    def scan_at(self, pose: np.ndarray, rng: np.random.Generator) -> Scan:
        """Return what the lidar sees."""
        x, y, yaw = compose(pose, np.array(T_BASE_LASER))
        u, v = (x - self.grid.origin[0]) / FINE_M, (y - self.grid.origin[1]) / FINE_M
        step = math.tau / BEAMS
        ranges = FINE_M * np.array(
            [cast_ray(self.grid.cells, u, v, yaw + k * step, MAX_LENGTH_M / FINE_M)
             for k in range(BEAMS)]
        )  # fmt: skip
        ranges += FINE_M / 2 + rng.normal(0, 0.01, BEAMS)
        ranges[ranges > MAX_LENGTH_M - FINE_M] = np.inf
        return Scan(0, 0.0, step, ranges.astype(np.float32), 0.12, MAX_LENGTH_M, T_BASE_LASER)

    def somewhere(self, rng: np.random.Generator) -> np.ndarray:
        """Return a pose with room around it."""
        row, column = rng.choice(np.argwhere(self.inside & (self.room_m > 0.3)))
        return np.array([*self.grid.cell_to_world(column, row), rng.uniform(-3, 3)])

    def next_of(self, pose: np.ndarray, scan: Scan, rng: np.random.Generator) -> np.ndarray:
        """Return where a robot wanders to that keeps off walls."""
        ahead = min(scan.ranges_m[:30].min(), scan.ranges_m[-30:].min())
        there = compose(pose, np.array([0.2, 0.0, rng.uniform(-0.3, 0.3)]))
        if ahead > 0.55 and self.room_at(there) > NEAREST_M:
            return there
        return compose(pose, np.array([0.0, 0.0, 0.5]))


def errors(world: World, grid: OccupancyGrid, seed: int, updates: int, *, lost: bool) -> np.ndarray:
    """Return the errors of place (m) and direction (rad) after each update."""
    rng = np.random.default_rng(seed)
    pose, odometry, out = world.somewhere(rng), np.zeros(3), []
    amcl = Amcl(TURTLEBOT3, seed)
    amcl.set_map(grid)
    if lost:
        amcl.spread_everywhere()
    else:
        side, turn = rng.uniform(-math.pi, math.pi), rng.choice([-1, 1]) * math.radians(30)
        said = pose + np.array([0.5 * math.cos(side), 0.5 * math.sin(side), turn])
        amcl.initialise(tuple(said), np.diag([0.25, 0.25, (math.pi / 12) ** 2]))
    for _ in range(updates):
        scan = world.scan_at(pose, rng)
        amcl.request_update()
        found = amcl.update(tuple(odometry), scan)
        assert found is not None
        off = np.array(found.pose) - pose
        out.append((math.hypot(off[0], off[1]), abs(math.remainder(off[2], math.tau))))
        there = world.next_of(pose, scan, rng)
        step = between(pose, there)
        odometry = compose(odometry, step * (1 + rng.normal(0, 0.02, 3)))
        pose = there
    return np.array(out)


def main() -> None:
    """Print how many runs are good."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workspaces", type=Path, default=ROOT.parent / "shared" / "workspaces")
    parser.add_argument("--runs", type=int, default=100)
    options = parser.parse_args()
    folder = options.workspaces / "turtlebot3_ws"
    world = World(folder)
    published = folder / "src/turtlebot3/turtlebot3_navigation/maps/map.yaml"
    grid = read_map(published, Diagnostics())
    assert grid is not None
    last = np.array([errors(world, grid, k, 40, lost=False)[-1] for k in range(options.runs)])
    good = (last[:, 0] < 0.1) & (last[:, 1] < math.radians(5))
    print(f"guess: {good.sum()} of {options.runs} mended; median {np.median(last[:, 0]):.3f} m, "
          f"worst {last[:, 0].max():.3f} m")  # fmt: skip
    ends = np.array([errors(world, grid, k, 20, lost=True)[-5:] for k in range(options.runs)])
    found = ((ends[..., 0] < 0.2) & (ends[..., 1] < 0.2)).all(axis=1)
    print(f"kidnapped: {found.sum()} of {options.runs} found within 20 updates")


if __name__ == "__main__":
    main()
