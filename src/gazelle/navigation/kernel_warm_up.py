"""Compiled kernels of navigation before they are needed."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.navigation.controllers import (
    CONTROLLERS,
    ControllerSetting,
    DwaOptions,
    MppiOptions,
    RobotState,
    TrajectoryPlannerOptions,
)
from gazelle.navigation.controllers.rollout_arguments import Outline
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
    footprint_cost,
)
from gazelle.navigation.localization import Amcl, AmclOptions
from gazelle.navigation.planners import (
    GlobalPlannerOptions,
    NavfnOptions,
    PlannerOptions,
    Smac2DOptions,
    ThetaStarOptions,
    make_plan,
)

__all__ = ["warm_up"]

_CELLS, _CELL_M = 40, 0.1
_START, _GOAL = (1.0, 1.0, 0.0), (3.0, 3.0, 0.0)
_ROBOT = Footprint(((0.2, 0.2), (-0.2, 0.2), (-0.2, -0.2), (0.2, -0.2)))


def warm_up() -> None:
    """Compile or load all kernels of costmaps, planners, controllers and localisation."""
    grid = _costmap()
    _plan(grid)
    _drive(grid)
    _localise()


def _room() -> OccupancyGrid:
    """Return a room of 4 m × 4 m with a pillar."""
    cells = np.zeros((_CELLS, _CELLS), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    cells[18:22, 18:22] = 100
    return OccupancyGrid(cells, _CELL_M)


def _costmap() -> CostGrid:
    source = {"scan": SourceOptions(clearing=True, obstacle_range=3.0, raytrace_range=3.5)}
    layers: list[StaticLayer | ObstacleLayer | InflationLayer] = [
        StaticLayer(StaticOptions(footprint_clearing_enabled=True)),
        ObstacleLayer(ObstacleOptions(), source),
        InflationLayer(InflationOptions(inflation_radius=0.3)),
    ]
    costmap = LayeredCostmap(CostmapOptions(), layers, _ROBOT)
    costmap.set_static_map(_room())
    costmap.observe("scan", Observation(0, (*_START[:2], 0.1), np.array([[1.5, 1.5, 0.1]])))
    costmap.update(_START, 0)
    footprint_cost(costmap.grid, _ROBOT, _START)
    return costmap.grid


def _plan(grid: CostGrid) -> None:
    ways: tuple[PlannerOptions, ...] = (
        NavfnOptions(),
        GlobalPlannerOptions(use_grid_path=True),
        Smac2DOptions(),
        ThetaStarOptions(),
    )
    for options in ways:
        make_plan(grid, _START, _GOAL, options)


def _drive(grid: CostGrid) -> None:
    from gazelle.navigation.controllers.escape_maneuver_kernels import find_maneuver

    path = np.column_stack([np.linspace(1.0, 3.0, 20), np.full(20, 1.0), np.zeros(20)])
    for name, options in (
        ("dwa_local_planner/DWAPlannerROS", DwaOptions(vx_samples=2, vth_samples=2)),
        ("base_local_planner/TrajectoryPlannerROS", TrajectoryPlannerOptions()),
        ("nav2_mppi_controller/MPPIController", MppiOptions(batch_size=4, time_steps=8)),
    ):
        controller = CONTROLLERS[name].make(options, ControllerSetting(0.05, {}))
        controller.set_plan(path)
        controller.compute(RobotState(_START, (0.1, 0.0, 0.0)), grid, _ROBOT)
    outline = Outline(_ROBOT.points, float(_ROBOT.inscribed_m), float(_ROBOT.circumscribed_m), 1.0)
    find_maneuver(grid.cells, outline, np.array(_START), np.array(_START), 0.1)


def _localise() -> None:
    spread = np.diag([0.01, 0.01, 0.01])
    for kind in ("likelihood_field", "likelihood_field_prob", "beam"):
        options = AmclOptions(
            min_particles=4, max_particles=8, laser_max_beams=8, laser_model_type=kind,
            do_beamskip=True, resample_interval=1,
        )  # fmt: skip
        amcl = Amcl(options)
        amcl.set_map(_room())
        amcl.initialise(_START, spread)
        amcl.update(_START, _seen())


def _seen() -> Scan:
    ranges: NDArray[np.float32] = np.full(8, 0.9, np.float32)
    return Scan(0, -math.pi, math.tau / 8, ranges, 0.1, 5.0)
