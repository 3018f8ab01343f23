"""rospy.topics: publishers and subscribers, with all that rospy.core has."""

from gazelle.compat.rospy.core import *  # noqa: F403
from gazelle.compat.rospy.topics import *  # noqa: F403
from gazelle.interfaces import AnyMsg
from gazelle.interfaces import Ros1Message as Message
