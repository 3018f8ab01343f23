"""Says hello ten times a second, as the rospy tutorial's first node."""

import contextlib

import rospy
from std_msgs.msg import String


def talker():
    publisher = rospy.Publisher("chatter", String, queue_size=10)
    rospy.init_node("talker", anonymous=True)
    rate = rospy.Rate(10)
    while not rospy.is_shutdown():
        text = f"hello world {rospy.get_time()}"
        rospy.loginfo(text)
        publisher.publish(text)
        rate.sleep()


if __name__ == "__main__":
    with contextlib.suppress(rospy.ROSInterruptException):
        talker()
