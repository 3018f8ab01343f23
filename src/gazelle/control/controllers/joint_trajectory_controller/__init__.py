"""The controllers that follow joint trajectories, ROS 1's and ROS 2's."""
