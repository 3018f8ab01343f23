"""nav2_simple_commander.line_iterator, by Gazelle."""

from gazelle.compat.navigation.lines import LineIterator

__all__ = ["LineIterator"]
