"""nav2_simple_commander.footprint_collision_checker, by Gazelle."""

from gazelle.compat.nav2_simple_commander.costmap_2d import *  # noqa: F403
