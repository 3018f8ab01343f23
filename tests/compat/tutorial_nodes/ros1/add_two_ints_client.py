"""Asks for the sum of two numbers of the command line."""

import sys

import rospy
from rospy_tutorials.srv import AddTwoInts

x, y = (int(word) for word in rospy.myargv()[1:3])
rospy.wait_for_service("add_two_ints")
try:
    add_two_ints = rospy.ServiceProxy("add_two_ints", AddTwoInts)
    print(f"{x} + {y} = {add_two_ints(x, y).sum}")
except rospy.ServiceException as error:
    sys.exit(f"Service call failed: {error}")
