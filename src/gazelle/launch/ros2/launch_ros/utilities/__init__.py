"""launch_ros.utilities: names, remaps and parameters on their way to a node."""

from __future__ import annotations

from gazelle.launch.ros2.launch_ros.utilities.namespaces import (
    add_node_name,
    get_node_name_count,
    is_namespace_absolute,
    is_root_namespace,
    make_namespace_absolute,
    prefix_namespace,
)
from gazelle.launch.ros2.launch_ros.utilities.node_parameters import (
    evaluate_parameter_dict,
    evaluate_parameters,
    normalize_parameter_dict,
    normalize_parameters,
    normalize_remap_rule,
    normalize_remap_rules,
    parameter_values,
)

__all__ = [
    "add_node_name",
    "evaluate_parameter_dict",
    "evaluate_parameters",
    "get_node_name_count",
    "is_namespace_absolute",
    "is_root_namespace",
    "make_namespace_absolute",
    "normalize_parameter_dict",
    "normalize_parameters",
    "normalize_remap_rule",
    "normalize_remap_rules",
    "parameter_values",
    "prefix_namespace",
]
