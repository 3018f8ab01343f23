"""``amcl`` of ROS 1 and ``nav2_amcl`` of ROS 2 over `gazelle.navigation.localization`."""
