"""Counts a Fibonacci sequence as an action, as the actionlib tutorial does."""

import actionlib
import rospy
from actionlib_tutorials.msg import FibonacciAction, FibonacciFeedback, FibonacciResult


class Fibonacci:
    def __init__(self, name):
        self.name = name
        self.server = actionlib.SimpleActionServer(
            name, FibonacciAction, execute_cb=self.execute, auto_start=False
        )
        self.server.start()

    def execute(self, goal):
        rate = rospy.Rate(50)
        feedback = FibonacciFeedback(sequence=[0, 1])
        rospy.loginfo(
            "%s: Executing, creating fibonacci sequence of order %i", self.name, goal.order
        )
        for i in range(1, goal.order):
            if self.server.is_preempt_requested():
                rospy.loginfo("%s: Preempted", self.name)
                self.server.set_preempted()
                return
            feedback.sequence.append(feedback.sequence[i] + feedback.sequence[i - 1])
            self.server.publish_feedback(feedback)
            rate.sleep()
        rospy.loginfo("%s: Succeeded", self.name)
        self.server.set_succeeded(FibonacciResult(sequence=feedback.sequence))


if __name__ == "__main__":
    rospy.init_node("fibonacci")
    Fibonacci(rospy.get_name())
    rospy.spin()
