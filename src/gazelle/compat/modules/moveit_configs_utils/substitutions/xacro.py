"""moveit_configs_utils.substitutions.xacro, by Gazelle."""

from gazelle.compat.moveit_configs.xacro_substitution import Xacro
