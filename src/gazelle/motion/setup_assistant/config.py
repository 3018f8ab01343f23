"""Everything a person chooses in the Setup Assistant, as one record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from gazelle.description.moveit import CartesianLimits
from gazelle.description.srdf import Srdf
from gazelle.description.xml import Tag

__all__ = [
    "KDL_SOLVER",
    "Author",
    "ControllerChoice",
    "JointLimitChoice",
    "KinematicsChoice",
    "RobotSource",
    "RosVersion",
    "SetupAssistantConfig",
]

RosVersion = Literal[1, 2]
KDL_SOLVER = "kdl_kinematics_plugin/KDLKinematicsPlugin"


@dataclass(frozen=True, slots=True)
class RobotSource:
    """Where the robot's description is.

    Attributes:
        file: the URDF or xacro.
        package: the package it lies in; empty when it lies in none.
        relative_path: of the file in that package.
        xacro_args: words ``NAME:=VALUE`` for xacro, with spaces between.
        copied_text: the URDF that the config package itself holds, because no other package does.
    """

    file: Path
    package: str = ""
    relative_path: str = ""
    xacro_args: str = ""
    copied_text: str = field(default="", repr=False)

    @property
    def mappings(self) -> dict[str, str]:
        """Values of xacro's arguments by name."""
        words = [word.partition(":=") for word in self.xacro_args.split() if ":=" in word]
        return {name: value for name, _, value in words}

    @property
    def is_xacro(self) -> bool:
        """Whether xacro has to make the URDF."""
        return self.file.suffix == ".xacro" and not self.copied_text


@dataclass(frozen=True, slots=True)
class Author:
    """Who maintains the package."""

    name: str = "you"
    email: str = "you@example.com"


@dataclass(frozen=True, slots=True)
class KinematicsChoice:
    """The solver of a group.

    Attributes:
        solver: the plug-in's name.
        search_resolution: step of a search over a redundant joint, rad.
        timeout_s: how long one request may take.
        position_only: the tip's orientation does not matter; for arms of less than six joints.
        others: keys besides these, kept as they are.
    """

    solver: str = KDL_SOLVER
    search_resolution: float = 0.005
    timeout_s: float = 0.05
    position_only: bool = False
    others: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class JointLimitChoice:
    """A joint's entry in ``joint_limits.yaml``: rad or m, and per s and s².

    Attributes:
        others: keys besides these, such as jerk limits, kept as they are.
    """

    has_velocity_limits: bool = False
    max_velocity: float = 0.0
    has_acceleration_limits: bool = False
    max_acceleration: float = 0.0
    others: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ControllerChoice:
    """A controller that trajectories of a group are sent to.

    Attributes:
        name: of the controller.
        type: what its action is: ``FollowJointTrajectory`` or ``GripperCommand``.
        joints: what it moves.
        plugin: its class for the controller manager, such as
            ``joint_trajectory_controller/JointTrajectoryController``.
        action_ns: its action is ``<name>/<action_ns>``.
        default: it is preferred over others of the same joints.
        parameters: its parameters at the controller manager, joints left out.
        others: keys at MoveIt besides these, kept as they are.
    """

    name: str
    type: str
    joints: tuple[str, ...]
    plugin: str
    action_ns: str = "follow_joint_trajectory"
    default: bool = True
    parameters: Mapping[str, Any] = field(default_factory=dict)
    others: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SetupAssistantConfig:
    """A MoveIt config package as it is chosen, before it is written.

    Attributes:
        package_name: of the package.
        ros_version: which ROS it is for.
        source: the robot.
        srdf: groups, named poses, end effectors, virtual and passive joints, pairs that are not
            checked for collision.
        srdf_path: the SRDF's place in the package.
        srdf_others: elements of an SRDF that nobody knows, kept.
        collision_trials: random configurations that the pairs were looked for in.
        always_fraction: from this share of collisions on a pair counts as always colliding.
        kinematics: solvers by group.
        planners: default planner by group, a name of ``ompl_planning.yaml``; empty for none.
        joint_limits: by joint.
        velocity_scaling: share of the velocity limits that is used unless a request says more.
        acceleration_scaling: the same of acceleration.
        cartesian_limits: of the tip, for Pilz' planner.
        controllers: what trajectories are sent to.
        command_interfaces: by joint, what hardware is told: ``position``, ``velocity``, ``effort``.
        state_interfaces: what hardware tells of each joint.
        added_joints: joints that the package adds to ``<ros2_control>`` or ``<transmission>``, for
            the robot's own URDF does not.
        adds_plugin: the package adds Gazebo's plug-in with the controller manager.
        initial_positions: by joint, rad or m, of simulated hardware.
        sensors: entries of ``sensors_3d.yaml``.
        author: who maintains the package.
        description: one sentence in its ``package.xml``; empty for the usual one.
        others: keys of ``.setup_assistant`` that nobody knows, kept.
        manager_others: keys of ``ros2_controllers.yaml`` besides those of controllers, kept.
    """

    package_name: str
    ros_version: RosVersion
    source: RobotSource
    srdf: Srdf
    srdf_path: str = ""
    srdf_others: tuple[Tag, ...] = ()
    collision_trials: int = 10_000
    always_fraction: float = 0.95
    kinematics: Mapping[str, KinematicsChoice] = field(default_factory=dict)
    planners: Mapping[str, str] = field(default_factory=dict)
    joint_limits: Mapping[str, JointLimitChoice] = field(default_factory=dict)
    velocity_scaling: float = 0.1
    acceleration_scaling: float = 0.1
    cartesian_limits: CartesianLimits = field(default_factory=CartesianLimits)
    controllers: tuple[ControllerChoice, ...] = ()
    command_interfaces: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    state_interfaces: tuple[str, ...] = ("position", "velocity")
    added_joints: tuple[str, ...] = ()
    adds_plugin: bool = True
    initial_positions: Mapping[str, float] = field(default_factory=dict)
    sensors: tuple[Mapping[str, Any], ...] = ()
    author: Author = field(default_factory=Author)
    description: str = ""
    others: Mapping[str, Any] = field(default_factory=dict)
    manager_others: Mapping[str, Any] = field(default_factory=dict)

    @property
    def adds_hardware(self) -> bool:
        """Whether the package has a robot description of its own around the robot's."""
        return bool(self.added_joints) or (self.ros_version == 1 and self.adds_plugin)

    @property
    def robot_package(self) -> str:
        """The package that holds the robot's description."""
        return self.source.package or self.package_name

    @property
    def robot_name(self) -> str:
        """The robot's name, which files of the package bear."""
        return self.srdf.name

    @property
    def srdf_file(self) -> str:
        """The SRDF's place in the package."""
        return self.srdf_path or f"config/{self.robot_name}.srdf"
