"""rosbag2_py, on Gazelle's bags."""

from gazelle.compat.bags.rosbag2 import *  # noqa: F403
