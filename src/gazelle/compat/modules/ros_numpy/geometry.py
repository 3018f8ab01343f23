"""ros_numpy.geometry."""

from gazelle.compat.arrays.geometry import *  # noqa: F403
