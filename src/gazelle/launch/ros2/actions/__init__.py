"""launch.actions."""

from __future__ import annotations

from gazelle.launch.ros2.actions.environment_variables import (
    AppendEnvironmentVariable,
    PopEnvironment,
    PushEnvironment,
    ResetEnvironment,
    SetEnvironmentVariable,
    UnsetEnvironmentVariable,
)
from gazelle.launch.ros2.actions.event_actions import (
    EmitEvent,
    RegisterEventHandler,
    Shutdown,
    UnregisterEventHandler,
)
from gazelle.launch.ros2.actions.execute_local import ExecuteLocal
from gazelle.launch.ros2.actions.execute_process import ExecuteProcess
from gazelle.launch.ros2.actions.for_loop import ForEach, ForLoop
from gazelle.launch.ros2.actions.group_action import GroupAction
from gazelle.launch.ros2.actions.include_launch_description import IncludeLaunchDescription
from gazelle.launch.ros2.actions.launch_configurations import (
    DeclareLaunchArgument,
    PopLaunchConfigurations,
    PushLaunchConfigurations,
    ResetLaunchConfigurations,
    SetLaunchConfiguration,
    UnsetLaunchConfiguration,
)
from gazelle.launch.ros2.actions.log import Log, LogDebug, LogError, LogInfo, LogWarning
from gazelle.launch.ros2.actions.opaque_function import OpaqueCoroutine, OpaqueFunction
from gazelle.launch.ros2.actions.timer_action import TimerAction

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
