"""How long planning, driving, localising and costmaps take.

    python benchmarks/bench_navigation.py

Medians of processor time after one call that compiles. Budgets: A* on 1674 × 1006 cells 100 ms, DWA
and MPPI at 20 Hz within 20 % of a core (10 ms), 2,000 particles × 60 beams 1 ms.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable

import numpy as np
from scipy.ndimage import label

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.controllers import (
    CONTROLLERS,
    ControllerSetting,
    DwaOptions,
    MppiOptions,
    PursuitOptions,
    RobotState,
)
from gazelle.navigation.costmap import (
    CostGrid,
    CostmapOptions,
    Footprint,
    InflationLayer,
    InflationOptions,
    LayeredCostmap,
    Observation,
    ObstacleLayer,
    ObstacleOptions,
    SourceOptions,
    StaticLayer,
    StaticOptions,
    inflated,
)
from gazelle.navigation.localization import AmclOptions
from gazelle.navigation.localization.laser_model import LikelihoodMap, ScanModel, chosen_beams
from gazelle.navigation.planners import (
    GlobalPlannerOptions,
    NavfnOptions,
    Plan,
    PlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
    make_plan,
)

_PURSUIT = "nav2_regulated_pure_pursuit_controller::RegulatedPurePursuitController"
_ROBOT = Footprint.of_radius(0.2)
_INFLATION = InflationOptions(inflation_radius=0.55, cost_scaling_factor=3.0)


def median_ms(call: Callable[[], object], count: int) -> float:
    """Return the median time of a call, ms; the first one is not counted."""
    call()
    times = []
    for _ in range(count):
        begin = time.thread_time()
        call()
        times.append(1e3 * (time.thread_time() - begin))
    return statistics.median(times)


def warehouse() -> OccupancyGrid:
    """Return shelves on 50 m × 30 m, 1674 × 1006 cells of 3 cm."""
    cells = np.zeros((1006, 1674), np.int8)
    for y in range(60, 900, 160):
        for x in range(60, 1600, 135):
            cells[y : y + 30, x : x + 100] = 100
    cells[np.random.default_rng(0).random(cells.shape) < 0.0005] = 100
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    return OccupancyGrid(cells, 0.03)


def planners() -> None:
    """Plan between far places of a large map."""
    costs = np.where(warehouse().cells == 100, 254, 0).astype(np.uint8)
    raw = CostGrid(costs, 0.03)
    taken = median_ms(lambda: inflated(raw, _INFLATION, _ROBOT), 5)
    print(f"inflation of 1674 × 1006: {taken:.1f} ms")
    grid = inflated(raw, _INFLATION, _ROBOT)
    regions, _ = label(grid.costs < 253)
    free = np.argwhere((regions == np.bincount(regions[regions > 0]).argmax()) & (grid.costs < 50))
    rng, pairs = np.random.default_rng(1), []
    while len(pairs) < 7:
        a, b = free[rng.integers(len(free), size=2)]
        if np.hypot(*(a - b)) > 800:
            pairs.append([(*map(float, grid.cell_to_world(p[1], p[0])), 0.0) for p in (a, b)])
    kinds: dict[str, PlannerOptions] = {
        "A* (SmacPlanner2D)": Smac2DOptions(),
        "NavfnROS": NavfnOptions(),
        "GlobalPlanner": GlobalPlannerOptions(),
        "ThetaStarPlanner": ThetaStarOptions(),
    }
    for name, options in kinds.items():
        make_plan(grid, *pairs[0], options)
        times = []
        for start, goal in pairs:
            begin = time.thread_time()
            assert isinstance(make_plan(grid, start, goal, options), Plan)
            times.append(1e3 * (time.thread_time() - begin))
        print(f"{name}: median {statistics.median(times):.0f} ms, worst {max(times):.0f} ms")


def controllers() -> None:
    """Compute one command in a local costmap of 3 m × 3 m."""
    costs = np.zeros((60, 60), np.uint8)
    costs[35:41, 40:46] = 254
    options = InflationOptions(inflation_radius=1.0, cost_scaling_factor=3.0)
    grid = inflated(CostGrid(costs, 0.05, (-1.5, -1.5)), options, _ROBOT)
    path = np.column_stack([np.linspace(0, 3, 60), np.zeros(60), np.zeros(60)])
    dwa = DwaOptions(
        max_vel_x=0.22, min_vel_x=-0.22, max_vel_y=0.0, min_vel_y=0.0, max_vel_trans=0.22,
        max_vel_theta=2.75, sim_time=1.5, vx_samples=20, vy_samples=0, vth_samples=40,
    )  # fmt: skip
    kinds = {
        "dwa_local_planner/DWAPlannerROS": dwa,
        "nav2_mppi_controller::MPPIController": MppiOptions(),
        _PURSUIT: PursuitOptions(),
    }
    for name, given in kinds.items():
        controller = CONTROLLERS[name].make(given, ControllerSetting(0.05, {}))
        controller.set_plan(path)
        state = RobotState((0.0, 0.05, 0.1), (0.1, 0.0, 0.0))
        taken = median_ms(lambda c=controller, s=state: c.compute(s, grid, _ROBOT), 50)
        print(f"{name}: {taken:.2f} ms, {2 * taken:.1f} % of a core at 20 Hz")


def localisation() -> None:
    """Weigh 2,000 particles by 60 beams."""
    options = AmclOptions(laser_max_beams=60)
    grid = warehouse()
    model = ScanModel(LikelihoodMap.of_grid(grid, 2.0), options)
    scan = Scan(0, -3.1, math.tau / 360, np.full(360, 2.0, np.float32), 0.1, 5.0)
    beams = chosen_beams(scan, options)
    particles = np.random.default_rng(0).normal((25, 15, 0), 0.5, (2000, 3))
    taken = median_ms(lambda: model.weights(particles, beams), 200)
    print(f"2000 particles × {len(beams.ends)} beams: {taken:.2f} ms")


def costmaps() -> None:
    """Take one scan into a costmap of the large map; only the window around it is computed."""
    source = {"scan": SourceOptions(clearing=True, obstacle_range=3.0, raytrace_range=3.5)}
    layers = [
        StaticLayer(StaticOptions()),
        ObstacleLayer(ObstacleOptions(), source),
        InflationLayer(_INFLATION),
    ]
    costmap = LayeredCostmap(CostmapOptions(), layers, _ROBOT)
    costmap.set_static_map(warehouse())
    here = (25.0, 14.0, 0.0)
    whole = median_ms(lambda: (costmap.reset(), costmap.update(here, 0)), 3)
    angles = np.linspace(0, math.tau, 360, endpoint=False)
    points = np.column_stack([25 + 2.5 * np.cos(angles), 14 + 2.5 * np.sin(angles)])
    seen = Observation(0, (25.0, 14.0, 0.1), np.column_stack([points, np.full(360, 0.1)]))

    def step() -> None:
        costmap.observe("scan", seen)
        costmap.update(here, 0)

    print(f"costmap of 1674 × 1006: a scan {median_ms(step, 20):.1f} ms, all of it {whole:.0f} ms")


if __name__ == "__main__":
    planners()
    controllers()
    localisation()
    costmaps()
