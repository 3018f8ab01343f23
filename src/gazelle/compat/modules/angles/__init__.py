"""angles."""

from gazelle.compat.tf.angles import *  # noqa: F403
