"""moveit_configs_utils.moveit_configs_builder, by Gazelle."""

from gazelle.compat.moveit_configs import (
    MoveItConfigs,
    MoveItConfigsBuilder,
    ParameterBuilder,
    get_pattern_matches,
    load_xacro,
    load_yaml,
)
from gazelle.description.moveit import DEFAULT_CONFIGS as _DEFAULT_CONFIGS

moveit_configs_utils_path = _DEFAULT_CONFIGS.parent
