"""gazebo_ros, by Gazelle."""
