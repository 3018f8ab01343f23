"""tf.listener."""

from gazelle.compat.tf.tf1 import *  # noqa: F403
