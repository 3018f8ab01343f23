"""``frontier_exploration``: explores what lies inside of a polygon, by move_base."""
