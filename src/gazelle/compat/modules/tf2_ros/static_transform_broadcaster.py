"""tf2_ros.static_transform_broadcaster."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
