"""sensor_msgs_py, on numpy."""
