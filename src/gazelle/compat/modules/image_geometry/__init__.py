"""image_geometry, on numpy."""

from gazelle.compat.images.image_geometry import PinholeCameraModel, StereoCameraModel

__all__ = ["PinholeCameraModel", "StereoCameraModel"]
