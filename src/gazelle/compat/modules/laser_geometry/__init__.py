"""laser_geometry, on numpy."""

from gazelle.compat.clouds.laser import LaserProjection

__all__ = ["LaserProjection"]
