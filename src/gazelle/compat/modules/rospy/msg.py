"""rospy.msg: messages of any type, and messages as bytes."""

from gazelle.compat.rospy.framing import *  # noqa: F403
