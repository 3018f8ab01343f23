"""rospy.msg: messages of any type, and messages as bytes."""

from gazelle.compat.rospy.msg import *  # noqa: F403
