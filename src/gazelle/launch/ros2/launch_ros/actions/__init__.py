"""launch_ros.actions."""

from __future__ import annotations

from gazelle.launch.ros2.launch_ros.actions.composable_nodes import (
    ComposableNodeContainer,
    LoadComposableNodes,
)
from gazelle.launch.ros2.launch_ros.actions.lifecycle_node import LifecycleNode
from gazelle.launch.ros2.launch_ros.actions.lifecycle_transition import LifecycleTransition
from gazelle.launch.ros2.launch_ros.actions.node import Node
from gazelle.launch.ros2.launch_ros.actions.ros_timer import ROSTimer
from gazelle.launch.ros2.launch_ros.actions.scoped_settings import (
    PushROSNamespace,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
    SetROSLogDir,
    SetUseSimTime,
)

# The names up to Humble.
PushRosNamespace = PushROSNamespace
RosTimer = ROSTimer

__all__ = [
    "ComposableNodeContainer",
    "LifecycleNode",
    "LifecycleTransition",
    "LoadComposableNodes",
    "Node",
    "PushROSNamespace",
    "PushRosNamespace",
    "ROSTimer",
    "RosTimer",
    "SetParameter",
    "SetParametersFromFile",
    "SetROSLogDir",
    "SetRemap",
    "SetUseSimTime",
]
