"""nav2_simple_commander.footprint_collision_checker, by Gazelle."""

from gazelle.compat.navigation.costmaps import *  # noqa: F403
