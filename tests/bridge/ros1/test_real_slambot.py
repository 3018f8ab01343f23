"""SLAMBOT in its world, seen and driven by real programs of ROS 1."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.ros1.real import Ros1

pytestmark = [pytest.mark.reference, pytest.mark.slow]

DRIVER = """
import rospy
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
rospy.init_node("driver")
out = rospy.Publisher("/cmd_vel", Twist, queue_size=1)
ahead = Twist()
ahead.linear.x = 0.2
start = rospy.wait_for_message("/odom", Odometry, 20)
while True:
    out.publish(ahead)
    now = rospy.wait_for_message("/odom", Odometry, 20)
    passed = (now.header.stamp - start.header.stamp).to_sec()
    if passed > 3.0:
        break
print("moved", now.pose.pose.position.x - start.pose.pose.position.x, "in", passed)
"""


@pytest.mark.usefixtures("real_ros")
def test_rospy_drives_slambot_and_rostopic_hears_its_laser(
    in_workspace: Callable[..., Any], next_port: Callable[[], int], tmp_path: Path
) -> None:
    uri = f"http://127.0.0.1:{next_port()}"
    robot = in_workspace("roslaunch", "slam_robot", "slam_robot_gazebo.launch")
    robot.wait_for_line("Successfully spawned entity", 60.0)
    bridge = in_workspace("bridge", "ros1", ROS_MASTER_URI=uri)
    bridge.wait_for_line("the bridge is the master")
    ros = Ros1(uri, tmp_path)
    robot.eventually(lambda: "/scan" in ros("rostopic", "list"))
    assert "frame_id: " in ros("rostopic", "echo", "-n", "1", "--noarr", "/scan/header")
    assert ros("rosparam", "get", "/use_sim_time") == "true\n"
    found = re.search(r"moved (\S+) in (\S+)", ros("/usr/bin/python3", "-c", DRIVER))
    assert found
    # The wheels need their time to start: 0.22 m/s is the steady speed.
    assert 0.18 < float(found[1]) / float(found[2]) < 0.225
    assert bridge.stop() == 0
    assert robot.stop() == 0
