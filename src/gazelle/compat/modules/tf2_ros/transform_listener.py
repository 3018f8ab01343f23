"""tf2_ros.transform_listener."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
