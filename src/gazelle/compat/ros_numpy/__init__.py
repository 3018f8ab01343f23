"""Messages as numpy arrays and back (ros_numpy); without a class given, those of ROS 1."""

from __future__ import annotations

from gazelle.compat.ros_numpy.registry import msgify, numpify

__all__ = ["msgify", "numpify"]
