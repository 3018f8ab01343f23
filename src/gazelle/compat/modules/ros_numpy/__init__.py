"""ros_numpy, on Gazelle's messages."""

from rospy.numpy_msg import numpy_msg

from gazelle.compat.ros_numpy import msgify, numpify

from . import geometry, image, occupancy_grid, point_cloud2

__all__ = [
    "geometry",
    "image",
    "msgify",
    "numpify",
    "numpy_msg",
    "occupancy_grid",
    "point_cloud2",
]
