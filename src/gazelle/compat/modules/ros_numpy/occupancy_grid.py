"""ros_numpy.occupancy_grid."""

from gazelle.compat.arrays.grid import *  # noqa: F403
