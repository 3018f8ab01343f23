"""Bridges between the graph and what is outside of it: real ROS, viewers."""
