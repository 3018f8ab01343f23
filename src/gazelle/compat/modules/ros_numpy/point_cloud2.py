"""ros_numpy.point_cloud2."""

from gazelle.compat.ros_numpy.point_cloud2 import *  # noqa: F403
