"""tf2_py: the exceptions of tf2."""

from gazelle.compat.tf.tf2_ros import *  # noqa: F403
