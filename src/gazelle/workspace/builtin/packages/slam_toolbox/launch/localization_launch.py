"""Localisation in a saved graph of poses."""

from gazelle.launch.ros2.builtin_launch_files import slam_toolbox


def generate_launch_description():
    """Return the arguments and the node."""
    return slam_toolbox("localization_slam_toolbox_node", "mapper_params_localization.yaml")
