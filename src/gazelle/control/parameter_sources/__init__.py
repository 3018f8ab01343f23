"""Where controllers get their parameters: the ROS 1 store or ROS 2 parameter files."""
