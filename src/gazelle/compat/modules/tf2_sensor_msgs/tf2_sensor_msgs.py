"""tf2_sensor_msgs.tf2_sensor_msgs."""

from gazelle.compat.clouds.tf2_sensor_msgs import *  # noqa: F403
