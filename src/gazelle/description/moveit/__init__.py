"""MoveIt's configuration of a robot: SRDF, kinematics, limits, pipelines and controllers."""

from __future__ import annotations

from gazelle.description.moveit.config import (
    MoveItConfig,
    config_from_parameters,
)
from gazelle.description.moveit.controllers import ControllerEntry, ExecutionSettings
from gazelle.description.moveit.joint_limits import JointLimit
from gazelle.description.moveit.kinematics import KinematicsSettings
from gazelle.description.moveit.package_files import DEFAULT_CONFIGS
from gazelle.description.moveit.pipelines import CartesianLimits, GroupPlanners, Pipeline
from gazelle.description.moveit.reader import read_moveit_config

__all__ = [
    "DEFAULT_CONFIGS",
    "CartesianLimits",
    "ControllerEntry",
    "ExecutionSettings",
    "GroupPlanners",
    "JointLimit",
    "KinematicsSettings",
    "MoveItConfig",
    "Pipeline",
    "config_from_parameters",
    "read_moveit_config",
]
