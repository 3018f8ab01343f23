"""tf2_sensor_msgs.tf2_sensor_msgs."""

from gazelle.compat.clouds.moving import *  # noqa: F403
