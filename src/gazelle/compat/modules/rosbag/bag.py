"""rosbag.bag."""

from gazelle.compat.rosbag import *  # noqa: F403
