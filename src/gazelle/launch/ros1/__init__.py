"""roslaunch XML, the format of ROS 1 launch files."""
