"""The Python functions of ROS 1's commands: rostopic, rosnode, rosparam, rosservice."""
