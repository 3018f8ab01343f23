"""ros_numpy.point_cloud2."""

from gazelle.compat.arrays.cloud import *  # noqa: F403
