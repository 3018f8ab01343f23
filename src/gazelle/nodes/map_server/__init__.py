"""Maps from and to files: ``map_server`` of ROS 1, ``nav2_map_server`` of ROS 2."""
