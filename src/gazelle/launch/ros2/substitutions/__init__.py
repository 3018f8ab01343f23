"""launch.substitutions."""

from __future__ import annotations

from gazelle.launch.ros2.substitution import TextSubstitution
from gazelle.launch.ros2.substitutions.boolean_substitution import (
    AllSubstitution,
    AndSubstitution,
    AnySubstitution,
    EqualsSubstitution,
    IfElseSubstitution,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
)
from gazelle.launch.ros2.substitutions.command_and_expression import Command, PythonExpression
from gazelle.launch.ros2.substitutions.files import (
    FileContent,
    FindExecutable,
    LaunchLogDir,
    PathJoinSubstitution,
    PathSubstitution,
    ThisLaunchFile,
    ThisLaunchFileDir,
)
from gazelle.launch.ros2.substitutions.substitution_failure import SubstitutionFailure
from gazelle.launch.ros2.substitutions.variables import (
    AnonName,
    EnvironmentVariable,
    ForEachVar,
    ForLoopIndex,
    LaunchConfiguration,
    LocalSubstitution,
    StringJoinSubstitution,
)

__all__ = [
    "AllSubstitution",
    "AndSubstitution",
    "AnonName",
    "AnySubstitution",
    "Command",
    "EnvironmentVariable",
    "EqualsSubstitution",
    "FileContent",
    "FindExecutable",
    "ForEachVar",
    "ForLoopIndex",
    "IfElseSubstitution",
    "LaunchConfiguration",
    "LaunchLogDir",
    "LocalSubstitution",
    "NotEqualsSubstitution",
    "NotSubstitution",
    "OrSubstitution",
    "PathJoinSubstitution",
    "PathSubstitution",
    "PythonExpression",
    "StringJoinSubstitution",
    "SubstitutionFailure",
    "TextSubstitution",
    "ThisLaunchFile",
    "ThisLaunchFileDir",
]
