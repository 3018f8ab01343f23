"""Drop-in for ros_gz_sim.actions."""

from gazelle.launch.ros2.ros_gz import GzServer, GzSpawnModel

__all__ = ["GzServer", "GzSpawnModel"]
