"""What the modules `tf`, `tf2_ros` and `tf2_geometry_msgs` are in Gazelle."""
