"""gazebo_ros.gazebo_interface, by Gazelle; programs take rospy and the messages from it too."""

import rospy  # noqa: F401
from gazebo_msgs.msg import *  # noqa: F403
from gazebo_msgs.srv import *  # noqa: F403
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Wrench  # noqa: F401

from gazelle.compat.gazebo_interface import *  # noqa: F403
