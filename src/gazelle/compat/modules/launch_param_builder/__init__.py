"""launch_param_builder, by Gazelle."""

from launch_param_builder.launch_param_builder import ParameterBuilder
from launch_param_builder.utils import *  # noqa: F403
