"""tf2_geometry_msgs.tf2_geometry_msgs."""

from gazelle.compat.tf.geometry_messages import *  # noqa: F403
