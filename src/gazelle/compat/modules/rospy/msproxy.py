"""rospy.msproxy: the master's answers."""

from gazelle.compat.rospy.client import MasterProxy

__all__ = ["MasterProxy"]
