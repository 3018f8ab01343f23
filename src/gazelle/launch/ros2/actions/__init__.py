"""launch.actions."""

from __future__ import annotations

from gazelle.launch.ros2.actions.configurations import (
    DeclareLaunchArgument,
    PopLaunchConfigurations,
    PushLaunchConfigurations,
    ResetLaunchConfigurations,
    SetLaunchConfiguration,
    UnsetLaunchConfiguration,
)
from gazelle.launch.ros2.actions.environment import (
    AppendEnvironmentVariable,
    PopEnvironment,
    PushEnvironment,
    ResetEnvironment,
    SetEnvironmentVariable,
    UnsetEnvironmentVariable,
)
from gazelle.launch.ros2.actions.events import (
    EmitEvent,
    RegisterEventHandler,
    Shutdown,
    UnregisterEventHandler,
)
from gazelle.launch.ros2.actions.execute_local import ExecuteLocal
from gazelle.launch.ros2.actions.execute_process import ExecuteProcess
from gazelle.launch.ros2.actions.functions import OpaqueCoroutine, OpaqueFunction
from gazelle.launch.ros2.actions.group import GroupAction
from gazelle.launch.ros2.actions.include import IncludeLaunchDescription
from gazelle.launch.ros2.actions.log import Log, LogDebug, LogError, LogInfo, LogWarning
from gazelle.launch.ros2.actions.loops import ForEach, ForLoop
from gazelle.launch.ros2.actions.timer import TimerAction

__all__ = [
    "AppendEnvironmentVariable",
    "DeclareLaunchArgument",
    "EmitEvent",
    "ExecuteLocal",
    "ExecuteProcess",
    "ForEach",
    "ForLoop",
    "GroupAction",
    "IncludeLaunchDescription",
    "Log",
    "LogDebug",
    "LogError",
    "LogInfo",
    "LogWarning",
    "OpaqueCoroutine",
    "OpaqueFunction",
    "PopEnvironment",
    "PopLaunchConfigurations",
    "PushEnvironment",
    "PushLaunchConfigurations",
    "RegisterEventHandler",
    "ResetEnvironment",
    "ResetLaunchConfigurations",
    "SetEnvironmentVariable",
    "SetLaunchConfiguration",
    "Shutdown",
    "TimerAction",
    "UnregisterEventHandler",
    "UnsetEnvironmentVariable",
    "UnsetLaunchConfiguration",
]
