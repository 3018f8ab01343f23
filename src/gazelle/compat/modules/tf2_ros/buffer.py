"""tf2_ros.buffer."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
