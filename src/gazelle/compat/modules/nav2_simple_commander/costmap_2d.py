"""nav2_simple_commander.costmap_2d, by Gazelle."""

from gazelle.compat.nav2_simple_commander.costmap_2d import PyCostmap2D

__all__ = ["PyCostmap2D"]
