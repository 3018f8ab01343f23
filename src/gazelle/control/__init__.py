"""Controllers of ros_control and ros2_control, their hardware, and your own."""
