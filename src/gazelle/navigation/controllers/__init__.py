"""Following paths, under the names of ROS's controllers: DWA, DWB, MPPI, pure pursuit, rollout."""

from __future__ import annotations

from gazelle.navigation.controllers.controller import (
    Command,
    Controller,
    NoCommand,
    RobotState,
    Velocity,
)
from gazelle.navigation.controllers.dwa_dwb_controller import SamplingController
from gazelle.navigation.controllers.dwa_dwb_parameters import (
    DwaOptions,
    DwbOptions,
    TrajectoryPlannerOptions,
)
from gazelle.navigation.controllers.mppi import MppiController, MppiOptions
from gazelle.navigation.controllers.registry import (
    CONTROLLERS,
    REFUSED_CONTROLLERS,
    ControllerKind,
    ControllerSetting,
)
from gazelle.navigation.controllers.regulated_pure_pursuit import PursuitController, PursuitOptions
from gazelle.navigation.controllers.trajectory_planner import TrajectoryPlanner

__all__ = [
    "CONTROLLERS",
    "REFUSED_CONTROLLERS",
    "Command",
    "Controller",
    "ControllerKind",
    "ControllerSetting",
    "DwaOptions",
    "DwbOptions",
    "MppiController",
    "MppiOptions",
    "NoCommand",
    "PursuitController",
    "PursuitOptions",
    "RobotState",
    "SamplingController",
    "TrajectoryPlanner",
    "TrajectoryPlannerOptions",
    "Velocity",
]
