"""launch_ros, by Gazelle: the classes of `gazelle.launch.ros2.launch_ros` where ROS 2 has them."""

import sys as _sys
from types import ModuleType as _ModuleType

from gazelle.compat.launch_ros import parameters as _parameters
from gazelle.compat.launch_ros import ros_adapters
from gazelle.launch.ros2.launch_ros import (
    actions,
    descriptions,
    event_handlers,
    events,
    parameter_descriptions,
    substitutions,
    utilities,
)
from gazelle.launch.ros2.launch_ros.actions import composable_nodes as _composable_nodes
from gazelle.launch.ros2.launch_ros.actions import lifecycle_node as _lifecycle_node
from gazelle.launch.ros2.launch_ros.actions import lifecycle_transition as _lifecycle_transition
from gazelle.launch.ros2.launch_ros.actions import node as _node
from gazelle.launch.ros2.launch_ros.actions import ros_timer as _ros_timer
from gazelle.launch.ros2.launch_ros.actions import scoped_settings as _scope
from gazelle.launch.ros2.launch_ros.events import lifecycle as _lifecycle
from gazelle.launch.ros2.launch_ros.events import matchers as _matchers
from gazelle.launch.ros2.launch_ros.utilities import namespaces as _namespaces
from gazelle.launch.ros2.launch_ros.utilities import node_parameters as _node_parameters

__all__ = [
    "actions",
    "descriptions",
    "event_handlers",
    "events",
    "ros_adapters",
    "substitutions",
]

_scope.PushRosNamespace = _scope.PushROSNamespace
_ros_timer.RosTimer = _ros_timer.ROSTimer
_utilities = _ModuleType("launch_ros.utilities")
_utilities.__dict__.update({name: getattr(utilities, name) for name in utilities.__all__})
_utilities.to_parameters_list = _parameters.to_parameters_list
utilities = _utilities

# The original has a module per class; users import from those too.
for _name, _module in {
    "actions": actions,
    "actions.composable_node_container": _composable_nodes,
    "actions.lifecycle_node": _lifecycle_node,
    "actions.lifecycle_transition": _lifecycle_transition,
    "actions.load_composable_nodes": _composable_nodes,
    "actions.node": _node,
    "actions.push_ros_namespace": _scope,
    "actions.ros_timer": _ros_timer,
    "actions.set_parameter": _scope,
    "actions.set_parameters_from_file": _scope,
    "actions.set_remap": _scope,
    "actions.set_ros_log_dir": _scope,
    "actions.set_use_sim_time": _scope,
    "descriptions": descriptions,
    "descriptions.composable_node": descriptions,
    "event_handlers": event_handlers,
    "event_handlers.on_state_transition": event_handlers,
    "events": events,
    "events.lifecycle": _lifecycle,
    "events.lifecycle.change_state": _lifecycle,
    "events.lifecycle.lifecycle_node_matchers": _matchers,
    "events.lifecycle.state_transition": _lifecycle,
    "events.matchers": _matchers,
    "events.matchers.matches_node_name": _matchers,
    "parameter_descriptions": parameter_descriptions,
    "parameters_type": _parameters,
    "remap_rule_type": _parameters,
    "ros_adapters": ros_adapters,
    "substitutions": substitutions,
    "substitutions.executable_in_package": substitutions,
    "substitutions.find_package": substitutions,
    "substitutions.parameter": substitutions,
    "utilities": _utilities,
    "utilities.evaluate_parameters": _node_parameters,
    "utilities.namespace_utils": _namespaces,
    "utilities.normalize_parameters": _node_parameters,
    "utilities.normalize_remap_rule": _node_parameters,
    "utilities.to_parameters_list": _parameters,
    "utilities.track_node_names": _namespaces,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = _module
    if "." not in _name:
        globals()[_name] = _module
