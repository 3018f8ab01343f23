"""ros_numpy.image."""

from gazelle.compat.arrays.image import *  # noqa: F403
