#!/usr/bin/env python3
"""Lets the wind go round, so that the balloons come back: each in a circle of its own size."""

import math

import rospy
from geometry_msgs.msg import Vector3

TURN_S = 16.0
WINDS_M_S = {"slow": 1.0, "fast": 2.0}


def main():
    rospy.init_node("gusts")
    winds = {name: rospy.Publisher(f"/{name}/wind", Vector3, queue_size=1) for name in WINDS_M_S}
    pace = rospy.Rate(10)
    begin = rospy.get_time()
    while not rospy.is_shutdown():
        angle = 2 * math.pi * (rospy.get_time() - begin) / TURN_S
        for name, speed in WINDS_M_S.items():
            winds[name].publish(speed * math.cos(angle), speed * math.sin(angle), 0.0)
        pace.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
