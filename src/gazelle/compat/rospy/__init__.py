"""What `rospy` is in Gazelle: the same names, on Gazelle's graph.

The module that users import, ``rospy``, lies in ``compat/modules`` and re-exports this one.
"""

from __future__ import annotations

from gazelle.compat.rospy.client import *  # noqa: F403
from gazelle.compat.rospy.client import DEBUG, ERROR, FATAL, INFO, WARN
from gazelle.compat.rospy.exceptions import *  # noqa: F403
from gazelle.compat.rospy.log import *  # noqa: F403
from gazelle.compat.rospy.rostime import *  # noqa: F403
from gazelle.compat.rospy.services import *  # noqa: F403
from gazelle.compat.rospy.timer import *  # noqa: F403
from gazelle.compat.rospy.topics import *  # noqa: F403
from gazelle.interfaces import AnyMsg
from gazelle.interfaces import Ros1Message as Message

__all__ = ["DEBUG", "ERROR", "FATAL", "INFO", "WARN", "AnyMsg", "Message"]
