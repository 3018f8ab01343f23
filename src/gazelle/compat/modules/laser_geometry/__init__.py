"""laser_geometry, on numpy."""

from gazelle.compat.clouds.laser_geometry import LaserProjection

__all__ = ["LaserProjection"]
