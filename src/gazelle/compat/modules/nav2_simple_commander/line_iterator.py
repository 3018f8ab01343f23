"""nav2_simple_commander.line_iterator, by Gazelle."""

from gazelle.compat.nav2_simple_commander.lines import LineIterator

__all__ = ["LineIterator"]
