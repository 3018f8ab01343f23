"""tf2_py: the exceptions of tf2."""

from gazelle.compat.tf.exceptions import *  # noqa: F403
