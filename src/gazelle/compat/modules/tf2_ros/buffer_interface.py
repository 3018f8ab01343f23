"""tf2_ros.buffer_interface."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
