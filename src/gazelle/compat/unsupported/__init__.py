"""Modules, attributes and keyword arguments of ROS's Python that Gazelle does not have."""
