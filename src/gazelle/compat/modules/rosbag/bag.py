"""rosbag.bag."""

from gazelle.compat.bags.rosbag import *  # noqa: F403
