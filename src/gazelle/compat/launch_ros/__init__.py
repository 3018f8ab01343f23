"""launch_ros: what of it speaks rclpy; the rest is `gazelle.launch.ros2.launch_ros`."""
