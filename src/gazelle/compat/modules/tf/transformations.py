"""tf.transformations."""

from gazelle.compat.tf.transformations import *  # noqa: F403
