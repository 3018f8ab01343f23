"""launch_param_builder.launch_param_builder, by Gazelle."""

from gazelle.compat.moveit_configs import ParameterBuilder
