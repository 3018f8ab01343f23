"""rosbag2_py, on Gazelle's bags."""

from gazelle.compat.rosbag2_py import *  # noqa: F403
