"""MoveIt's configuration for launch files: what ``moveit_configs_utils`` gives them.

The modules that users import, ``moveit_configs_utils``, ``launch_param_builder`` and ``srdfdom``,
lie in ``compat/modules`` and re-export this one.
"""

from __future__ import annotations

from gazelle.compat.moveit_configs.builder import (
    MoveItConfigs,
    MoveItConfigsBuilder,
    get_pattern_matches,
)
from gazelle.compat.moveit_configs.parameter_builder import ParameterBuilder
from gazelle.compat.moveit_configs.parameter_files import (
    ParameterBuilderFileNotFoundError,
    ParameterValueType,
    get_path,
    load_file,
    load_xacro,
    load_yaml,
    raise_if_file_not_found,
    render_template,
)

__all__ = [
    "MoveItConfigs",
    "MoveItConfigsBuilder",
    "ParameterBuilder",
    "ParameterBuilderFileNotFoundError",
    "ParameterValueType",
    "get_path",
    "get_pattern_matches",
    "load_file",
    "load_xacro",
    "load_yaml",
    "raise_if_file_not_found",
    "render_template",
]
