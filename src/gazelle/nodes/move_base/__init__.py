"""``move_base``: drives to goals, as the node of ROS 1's navigation does."""
