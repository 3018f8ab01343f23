"""moveit_configs_utils.substitutions, by Gazelle."""

from moveit_configs_utils.substitutions.xacro import Xacro
