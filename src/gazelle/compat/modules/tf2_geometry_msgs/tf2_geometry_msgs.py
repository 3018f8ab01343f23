"""tf2_geometry_msgs.tf2_geometry_msgs."""

from gazelle.compat.tf.tf2_geometry_msgs import *  # noqa: F403
