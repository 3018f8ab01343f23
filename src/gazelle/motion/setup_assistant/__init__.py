"""MoveIt's Setup Assistant: a config package for a robot that has only a URDF."""

from __future__ import annotations

from gazelle.motion.setup_assistant.chosen_groups import ChosenChain, ChosenHand, chosen_groups
from gazelle.motion.setup_assistant.config import (
    Author,
    ControllerChoice,
    JointLimitChoice,
    KinematicsChoice,
    RobotSource,
    SetupAssistantConfig,
)
from gazelle.motion.setup_assistant.package_files import (
    FileState,
    PlannedFile,
    SetupAssistantError,
    planned_files,
    write_package,
)
from gazelle.motion.setup_assistant.proposal import (
    CollisionSearch,
    propose,
    regrouped,
    with_groups,
)
from gazelle.motion.setup_assistant.read_package import read_config_package
from gazelle.motion.setup_assistant.robot_source import load_robot, read_robot
from gazelle.motion.setup_assistant.self_collisions import (
    CollisionMatrix,
    DisabledReason,
    LinkPair,
    self_collision_matrix,
)

__all__ = [
    "Author",
    "ChosenChain",
    "ChosenHand",
    "CollisionMatrix",
    "CollisionSearch",
    "ControllerChoice",
    "DisabledReason",
    "FileState",
    "JointLimitChoice",
    "KinematicsChoice",
    "LinkPair",
    "PlannedFile",
    "RobotSource",
    "SetupAssistantConfig",
    "SetupAssistantError",
    "chosen_groups",
    "load_robot",
    "planned_files",
    "propose",
    "read_config_package",
    "read_robot",
    "regrouped",
    "self_collision_matrix",
    "with_groups",
    "write_package",
]
