"""laser_geometry.laser_geometry."""

from gazelle.compat.clouds.laser import *  # noqa: F403
