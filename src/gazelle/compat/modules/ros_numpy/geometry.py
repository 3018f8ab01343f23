"""ros_numpy.geometry."""

from gazelle.compat.ros_numpy.geometry import *  # noqa: F403
