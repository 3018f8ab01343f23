"""rospy.service: the base of services, with all that rospy.core has."""

from gazelle.compat.rospy.core import *  # noqa: F403
from gazelle.compat.rospy.exceptions import ServiceException
from gazelle.compat.rospy.services import *  # noqa: F403
