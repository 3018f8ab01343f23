"""Drop-in for ros_gz_bridge."""
