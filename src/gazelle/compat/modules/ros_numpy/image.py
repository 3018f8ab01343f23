"""ros_numpy.image."""

from gazelle.compat.ros_numpy.image import *  # noqa: F403
