"""``nav2_collision_monitor``: polygons around a robot and what they do to velocity commands."""
