"""Messages as the text that the ROS commands print, and as what they read."""
