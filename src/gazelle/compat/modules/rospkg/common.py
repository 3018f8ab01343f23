"""rospkg.common, by Gazelle."""

from gazelle.compat.rospkg import *  # noqa: F403

ROS_STACK = "ros"
