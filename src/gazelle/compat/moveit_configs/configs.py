"""``MoveItConfigs``: parameters of MoveIt, sorted by what they are for."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

__all__ = ["MoveItConfigs"]

Parameters = dict[str, Any]


def _capabilities() -> Parameters:
    return {"capabilities": "", "disable_capabilities": ""}


@dataclass(slots=True)
class MoveItConfigs:
    """Parameters of MoveIt, each group ready to be given to a node.

    Attributes:
        package_path: the MoveIt config package.
        robot_description: the URDF.
        robot_description_semantic: the SRDF.
        robot_description_kinematics: settings of inverse kinematics.
        planning_pipelines: names, default and parameters of pipelines.
        trajectory_execution: controllers and execution.
        planning_scene_monitor: what is published of the scene.
        sensors_3d: sensors of the octomap.
        move_group_capabilities: capabilities besides the usual ones.
        joint_limits: limits that take the place of the URDF's.
        moveit_cpp: of MoveItCpp and MoveItPy.
        pilz_cartesian_limits: limits of the tip for Pilz' planner.
    """

    package_path: Path | None = None
    robot_description: Parameters = field(default_factory=dict)
    robot_description_semantic: Parameters = field(default_factory=dict)
    robot_description_kinematics: Parameters = field(default_factory=dict)
    planning_pipelines: Parameters = field(default_factory=dict)
    trajectory_execution: Parameters = field(default_factory=dict)
    planning_scene_monitor: Parameters = field(default_factory=dict)
    sensors_3d: Parameters = field(default_factory=dict)
    move_group_capabilities: Parameters = field(default_factory=_capabilities)
    joint_limits: Parameters = field(default_factory=dict)
    moveit_cpp: Parameters = field(default_factory=dict)
    pilz_cartesian_limits: Parameters = field(default_factory=dict)

    def to_dict(self) -> Parameters:
        """Return all parameters of move_group; limits of joints and of the tip are merged."""
        parameters: Parameters = {}
        parameters |= self.robot_description
        parameters |= self.robot_description_semantic
        parameters |= self.robot_description_kinematics
        parameters |= self.planning_pipelines
        parameters |= self.trajectory_execution
        parameters |= self.planning_scene_monitor
        parameters |= self.sensors_3d
        parameters |= self.joint_limits
        parameters |= self.moveit_cpp
        for key, limits in self.pilz_cartesian_limits.items():
            parameters[key] = {**parameters.get(key, {}), **limits}
        return parameters
