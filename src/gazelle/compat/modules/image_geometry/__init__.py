"""image_geometry, on numpy."""

from gazelle.compat.images.camera_models import PinholeCameraModel, StereoCameraModel

__all__ = ["PinholeCameraModel", "StereoCameraModel"]
