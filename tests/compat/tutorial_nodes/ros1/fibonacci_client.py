"""Sends a goal and waits for its result, as the actionlib tutorial does."""

import actionlib
import rospy
from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal

if __name__ == "__main__":
    rospy.init_node("fibonacci_client_py")
    client = actionlib.SimpleActionClient("fibonacci", FibonacciAction)
    client.wait_for_server()
    client.send_goal(FibonacciGoal(order=8))
    client.wait_for_result()
    print("Result:", ", ".join(str(n) for n in client.get_result().sequence))
