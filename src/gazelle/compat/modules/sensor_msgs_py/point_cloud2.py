"""sensor_msgs_py.point_cloud2."""

from gazelle.compat.clouds.point_cloud2_ros2 import *  # noqa: F403
