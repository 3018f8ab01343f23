#!/usr/bin/env python3
"""Drive straight into the first domino, then back to where it began."""

import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

AHEAD_M, SPEED_M_S = 0.75, 0.5


class Knock:
    """Drives by how far odometry says it has come."""

    def __init__(self):
        self.place = None
        self.commands = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        rospy.Subscriber("odom", Odometry, self.on_odometry)

    def on_odometry(self, odometry):
        self.place = odometry.pose.pose.position

    def run(self):
        pace = rospy.Rate(20)
        while self.place is None and not rospy.is_shutdown():
            pace.sleep()
        self.drive(AHEAD_M, SPEED_M_S, pace)
        self.drive(AHEAD_M, -SPEED_M_S / 2, pace)

    def drive(self, metres, speed, pace):
        begin = self.place
        twist = Twist()
        twist.linear.x = speed
        while not rospy.is_shutdown():
            away = ((self.place.x - begin.x) ** 2 + (self.place.y - begin.y) ** 2) ** 0.5
            if away >= metres:
                break
            self.commands.publish(twist)
            pace.sleep()
        self.commands.publish(Twist())


if __name__ == "__main__":
    rospy.init_node("knock")
    try:
        Knock().run()
    except rospy.ROSInterruptException:
        pass
