"""sensor_msgs_py.point_cloud2."""

from gazelle.compat.clouds.ros2 import *  # noqa: F403
