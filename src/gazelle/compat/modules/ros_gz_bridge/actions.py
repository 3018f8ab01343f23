"""Drop-in for ros_gz_bridge.actions."""

from gazelle.launch.ros2.ros_gz import RosGzBridge

__all__ = ["RosGzBridge"]
