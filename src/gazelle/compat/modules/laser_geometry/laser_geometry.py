"""laser_geometry.laser_geometry."""

from gazelle.compat.clouds.laser_geometry import *  # noqa: F403
