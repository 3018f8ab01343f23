#!/usr/bin/env python3
"""Drive a robot from the keyboard: w forward, x back, a and d turn, s or space stops."""

import select
import sys
import termios
import tty

import rospy
from geometry_msgs.msg import Twist

HELP = """Drive the scout
  w  faster ahead      a  turn left
  x  faster back       d  turn right
  s  stop              Ctrl-C  quit"""
LINEAR_STEP, ANGULAR_STEP = 0.05, 0.2
LINEAR_LIMIT, ANGULAR_LIMIT = 0.5, 2.0


def clamp(value, limit):
    return max(-limit, min(limit, value))


def read_key(settings, timeout_s):
    """Return the key pressed within a time, or an empty string."""
    tty.setraw(sys.stdin.fileno())
    ready, _, _ = select.select([sys.stdin], [], [], timeout_s)
    key = sys.stdin.read(1) if ready else ""
    termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)
    return key


def main():
    settings = termios.tcgetattr(sys.stdin)
    rospy.init_node("scout_teleop")
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
    twist = Twist()
    print(HELP)
    try:
        while not rospy.is_shutdown():
            key = read_key(settings, 0.1)
            if key == "\x03":
                break
            if key in "wx" and key:
                step = LINEAR_STEP if key == "w" else -LINEAR_STEP
                twist.linear.x = clamp(twist.linear.x + step, LINEAR_LIMIT)
            elif key in "ad" and key:
                step = ANGULAR_STEP if key == "a" else -ANGULAR_STEP
                twist.angular.z = clamp(twist.angular.z + step, ANGULAR_LIMIT)
            elif key in "s " and key:
                twist = Twist()
            publisher.publish(twist)
            if key:
                print(f"linear {twist.linear.x:.2f} m/s  angular {twist.angular.z:.2f} rad/s")
    finally:
        publisher.publish(Twist())
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, settings)


if __name__ == "__main__":
    main()
