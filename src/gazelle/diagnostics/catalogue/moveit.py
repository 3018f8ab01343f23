"""Codes of MoveIt's configuration: kinematics, limits, pipelines, controllers."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "moveit.bad-limit",
        "warning",
        "A number of MoveIt's configuration cannot be",
        "Limits are above 0, lower ones below upper ones, factors between 0 and 1.",
        "write a number in the range the message names",
    ),
    Entry(
        "moveit.bad-yaml",
        "error",
        "A file of a MoveIt config package cannot be read",
        "It is no YAML, not UTF-8, or holds no mapping.",
        "mend the file at the place given",
        "Failed to parse",
    ),
    Entry(
        "moveit.controller",
        "warning",
        "A controller of MoveIt is not described",
        "It is named and has no parameters, or has parameters and no name.",
        "give its name, action_ns, type and joints",
        "No action namespace specified for controller",
    ),
    Entry(
        "moveit.double-key",
        "warning",
        "A file of a MoveIt config package has a key twice",
        "YAML keeps the last one and says nothing.",
        "remove one of them",
    ),
    Entry(
        "moveit.limit-without-flag",
        "warning",
        "A limit of joint_limits.yaml has no effect",
        "MoveIt reads max_velocity only beside has_velocity_limits: true, and says nothing.",
        "add the flag",
    ),
    Entry(
        "moveit.limit-without-value",
        "warning",
        "A joint has a limit without a value",
        "The flag says that there is one, the number is missing.",
        "add the number",
        "but did not set a max velocity",
    ),
    Entry(
        "moveit.no-argument",
        "warning",
        "A file of MoveIt needs the value of an argument",
        "ROS 1's launch files put arguments into YAML (subst_value); the SRDF's defaults are used"
        " where they have the same name.",
        "give the value with mappings={...}",
    ),
    Entry(
        "moveit.no-description",
        "error",
        "There is no robot to plan for",
        "A MoveIt config package names its URDF in .setup_assistant or has it in config.",
        "write the robot into config, with the ending .urdf.xacro, or run the Setup Assistant",
        "Cannot infer URDF",
    ),
    Entry(
        "moveit.no-pipeline",
        "warning",
        "A planning pipeline has no parameters",
        "Its name is in planning_pipelines and nothing stands below that name.",
        "add its file, whose name ends in _planning.yaml, or take the name out",
        "Failed to initialize planning pipeline",
    ),
    Entry(
        "moveit.no-planner",
        "warning",
        "A planner configuration is named and not described",
        "MoveIt leaves it out.",
        "describe it below planner_configs",
        "Could not find the planner configuration",
    ),
    Entry(
        "moveit.no-solver",
        "info",
        "A group of kinematics.yaml names no solver",
        "MoveIt would give the group no inverse kinematics; Gazelle uses its own solver for all.",
        "add kinematics_solver: kdl_kinematics_plugin/KDLKinematicsPlugin",
        "No kinematics solver instantiated for group",
    ),
    Entry(
        "moveit.no-srdf",
        "error",
        "A robot has no planning groups",
        "Groups stand in an SRDF, and there is none.",
        "write config/….srdf, or run the MoveIt Setup Assistant",
        "Could not find parameter robot_description_semantic",
    ),
    Entry(
        "moveit.several-files",
        "warning",
        "A package has several files for one purpose",
        "One of them is used, the message says which.",
        "name the one that is meant",
        "Unable to guess which parameter file to load",
    ),
    Entry(
        "moveit.unknown-key",
        "warning",
        "MoveIt does not know a parameter",
        "A mistyped key changes nothing and nobody says so.",
        "use MoveIt's name",
    ),
    Entry(
        "moveit.wrong-type",
        "warning",
        "A parameter of MoveIt has the wrong type",
        "The value is not used where it has no meaning as the right type.",
        "write a value of the right type",
        "expected [double] got",
    ),
)
