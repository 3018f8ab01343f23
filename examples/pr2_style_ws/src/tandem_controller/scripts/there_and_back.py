#!/usr/bin/env python3
"""Rolls the robot to and fro: an angle for the wheels, rad, and after some seconds another one."""

import rospy
from std_msgs.msg import Float64

ANGLES_RAD = (4.0, 0.0, -4.0, 0.0)
PAUSE_S = 4.0


def main():
    rospy.init_node("there_and_back")
    command = rospy.Publisher("/tandem_controller/command", Float64, queue_size=1)
    while command.get_num_connections() == 0 and not rospy.is_shutdown():
        rospy.sleep(0.1)
    while not rospy.is_shutdown():
        for angle in ANGLES_RAD:
            command.publish(angle)
            rospy.sleep(PAUSE_S)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
