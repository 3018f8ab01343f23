"""Adds what it is sent; `rospy_tutorials/AddTwoInts` is `roscpp_tutorials`' service too."""

import rospy
from rospy_tutorials.srv import AddTwoInts, AddTwoIntsResponse


def add(request):
    print(f"Returning [{request.a} + {request.b} = {request.a + request.b}]")
    return AddTwoIntsResponse(request.a + request.b)


if __name__ == "__main__":
    rospy.init_node("add_two_ints_server")
    service = rospy.Service("add_two_ints", AddTwoInts, add)
    print("Ready to add two ints.")
    service.spin()
