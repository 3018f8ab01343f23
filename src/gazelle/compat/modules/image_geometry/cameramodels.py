"""image_geometry.cameramodels."""

from gazelle.compat.images.image_geometry import PinholeCameraModel, StereoCameraModel

__all__ = ["PinholeCameraModel", "StereoCameraModel"]
