"""srdfdom.srdf, by Gazelle."""

from gazelle.compat.moveit_configs.srdfdom import *  # noqa: F403
