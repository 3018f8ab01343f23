"""What the nodes of ROS 1's and ROS 2's navigation share: costmaps that live, settings, poses."""
