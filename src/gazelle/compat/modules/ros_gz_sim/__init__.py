"""Drop-in for ros_gz_sim."""
