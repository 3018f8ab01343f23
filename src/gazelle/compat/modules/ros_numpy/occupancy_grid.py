"""ros_numpy.occupancy_grid."""

from gazelle.compat.ros_numpy.occupancy_grid import *  # noqa: F403
