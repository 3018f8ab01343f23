"""tf_conversions.transformations."""

from gazelle.compat.tf.matrices import *  # noqa: F403
from gazelle.compat.tf.transformations import *  # noqa: F403
