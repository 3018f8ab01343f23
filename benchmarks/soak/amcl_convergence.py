"""How often amcl finds a robot that is 0.5 m and 30° from where it is said to be.

    python benchmarks/soak/amcl_convergence.py [runs]

A robot with a TurtleBot3's lidar (360 beams, 3.5 m) wanders through random rooms; the parameters
are those of turtlebot3_navigation's amcl.launch. A run counts when the pose is within 0.1 m and 5°
in the end.
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace

import numpy as np
from scipy.ndimage import distance_transform_edt

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import compose
from gazelle.navigation.localization import Amcl, AmclOptions
from gazelle.navigation.localization.amcl_kernels import cast_ray

TURTLEBOT3 = AmclOptions(
    min_particles=500, max_particles=3000, kld_err=0.02, update_min_d=0.2, update_min_a=0.2,
    resample_interval=1, laser_max_range=3.5, laser_max_beams=180, laser_z_hit=0.5,
    laser_z_short=0.05, laser_z_max=0.05, laser_z_rand=0.5, odom_alpha1=0.1, odom_alpha2=0.1,
    odom_alpha3=0.1, odom_alpha4=0.1,
)  # fmt: skip
_CELL_M, _SIDE, _BEAMS, _MAX_LENGTH_M = 0.05, 120, 360, 3.5


def room(seed: int) -> OccupancyGrid:
    """Return 6 m × 6 m with walls one cell thick and hollow boxes."""
    rng = np.random.default_rng(seed)
    cells = np.zeros((_SIDE, _SIDE), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    for _ in range(7):
        x, y = rng.integers(10, _SIDE - 25, 2)
        w, h = rng.integers(5, 14, 2)
        cells[y : y + h + 1, [x, x + w]] = 100
        cells[[y, y + h], x : x + w + 1] = 100
        cells[y + 1 : y + h, x + 1 : x + w] = -1
    return OccupancyGrid(cells, _CELL_M)


def scan_at(grid: OccupancyGrid, pose: np.ndarray, rng: np.random.Generator) -> Scan:
    """Return what a lidar sees; walls run through the middle of their cells."""
    solid = (grid.cells == 100).astype(np.int8)
    step = math.tau / _BEAMS
    ranges = np.array(
        [
            cast_ray(solid, pose[0] / _CELL_M, pose[1] / _CELL_M, pose[2] + k * step, 1e3)
            for k in range(_BEAMS)
        ]
    )
    ranges = (ranges + 0.5) * _CELL_M + rng.normal(0, 0.01, _BEAMS)
    ranges[ranges > _MAX_LENGTH_M] = np.inf
    return Scan(0, 0.0, step, ranges.astype(np.float32), 0.12, _MAX_LENGTH_M)


def error_of_run(seed: int, updates: int = 40, options: AmclOptions = TURTLEBOT3) -> np.ndarray:
    """Return the errors of place (m) and direction (degrees) in the end."""
    rng, grid = np.random.default_rng(seed), room(seed)
    clearance = distance_transform_edt(grid.cells == 0) * _CELL_M
    row, column = rng.choice(np.argwhere(clearance > 0.3))
    x, y = grid.cell_to_world(column, row)
    true, odometry = np.array([x, y, rng.uniform(-3, 3)]), np.zeros(3)
    side, angle = rng.uniform(-math.pi, math.pi), rng.choice([-1, 1]) * math.radians(30)
    said = true + np.array([0.5 * math.cos(side), 0.5 * math.sin(side), angle])
    filter_ = Amcl(options, seed)
    filter_.set_map(grid)
    filter_.initialise(tuple(said), np.diag([0.25, 0.25, (math.pi / 12) ** 2]))
    for _ in range(updates):
        scan = scan_at(grid, true, rng)
        filter_.update(tuple(odometry), scan)
        ahead = min(scan.ranges_m[:30].min(), scan.ranges_m[-30:].min())
        turn = rng.uniform(-0.3, 0.3)
        step = np.array([0.22, 0.0, turn]) if ahead > 0.5 else np.array([0.0, 0.0, 0.5])
        true = compose(true, step)
        odometry = compose(odometry, step * (1 + rng.normal(0, 0.02, 3)))
    filter_.request_update()
    found = filter_.update(tuple(odometry), scan_at(grid, true, rng))
    assert found is not None
    off = np.array(found.pose) - true
    return np.array(
        [math.hypot(off[0], off[1]), abs(math.degrees(math.remainder(off[2], math.tau)))]
    )


def main() -> None:
    """Print how many runs converge."""
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    kinds = {"likelihood_field": TURTLEBOT3}
    kinds["likelihood_field_prob"] = replace(
        TURTLEBOT3, laser_model_type="likelihood_field_prob", laser_max_beams=60
    )
    for name, options in kinds.items():
        errors = np.array([error_of_run(seed, options=options) for seed in range(runs)])
        good = int(((errors[:, 0] < 0.1) & (errors[:, 1] < 5)).sum())
        print(
            f"{name}: {good} of {runs} within 0.1 m and 5°; "
            f"median {np.median(errors[:, 0]):.3f} m, "
            f"{np.median(errors[:, 1]):.2f}°; worst {errors[:, 0].max():.3f} m"
        )


if __name__ == "__main__":
    main()
