"""moveit_configs_utils, by Gazelle."""

from moveit_configs_utils.moveit_configs_builder import MoveItConfigs, MoveItConfigsBuilder
