"""srdfdom.srdf, by Gazelle."""

from gazelle.compat.moveit_configs.srdf_objects import *  # noqa: F403
