"""Bags in users' programs: the Python interfaces of rosbag and of rosbag2."""
