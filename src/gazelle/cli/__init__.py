"""The commands: ``gazelle …`` and the ROS-named ones, thin over the layers below."""
