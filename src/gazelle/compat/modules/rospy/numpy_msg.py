"""rospy.numpy_msg: message classes whose arrays are numpy's."""

from gazelle.compat.rospy.numpy_msg import numpy_msg

__all__ = ["numpy_msg"]
