"""tf_conversions: transformations. Its posemath is about PyKDL's frames, which are not here."""

from . import transformations

__all__ = ["transformations"]
