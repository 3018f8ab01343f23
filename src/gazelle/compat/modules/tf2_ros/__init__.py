"""tf2_ros, on Gazelle's graph."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
