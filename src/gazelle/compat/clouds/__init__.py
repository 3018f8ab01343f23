"""Point clouds in users' programs: sensor_msgs.point_cloud2, sensor_msgs_py, laser_geometry."""
