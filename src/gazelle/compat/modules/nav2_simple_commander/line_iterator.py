"""nav2_simple_commander.line_iterator, by Gazelle."""

from gazelle.compat.nav2_simple_commander.costmap_2d import LineIterator

__all__ = ["LineIterator"]
