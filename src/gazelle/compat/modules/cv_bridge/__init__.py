"""cv_bridge, on numpy and Pillow; on OpenCV where colours need it."""

from gazelle.compat.images.cv_bridge import CvBridge, CvBridgeError
from gazelle.compat.images.encodings import convert_image as cvtColor2
from gazelle.compat.images.encodings import find_encoding as _find_encoding

__all__ = ["CvBridge", "CvBridgeError", "cvtColor2", "getCvType"]


def getCvType(encoding):
    """Return OpenCV's number of an encoding's type; needs OpenCV."""
    import cv2

    return getattr(cv2, f"CV_{_find_encoding(encoding).cv_type}")
