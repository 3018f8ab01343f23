"""rospkg: where packages are, answered by Gazelle's workspace."""

from gazelle.compat.rospkg import ResourceNotFound, RosPack, get_ros_package_path

__all__ = ["ResourceNotFound", "RosPack", "get_ros_package_path"]
