"""Steers turtle2 to turtle1 by the transform between them, as the tf tutorial does."""

import math

import geometry_msgs.msg
import rospy
import tf

if __name__ == "__main__":
    rospy.init_node("turtle_tf_listener")
    listener = tf.TransformListener()
    steer = rospy.Publisher("turtle2/cmd_vel", geometry_msgs.msg.Twist, queue_size=1)
    rate = rospy.Rate(10.0)
    while not rospy.is_shutdown():
        try:
            (move, _turn) = listener.lookupTransform("/turtle2", "/turtle1", rospy.Time(0))
        except (tf.LookupException, tf.ConnectivityException, tf.ExtrapolationException):
            rate.sleep()
            continue
        command = geometry_msgs.msg.Twist()
        command.linear.x = 0.5 * math.hypot(move[0], move[1])
        command.angular.z = 4 * math.atan2(move[1], move[0])
        steer.publish(command)
        rate.sleep()
