"""SLAM beside a running robot."""

from gazelle.launch.ros2.builtin_launch_files import slam_toolbox


def generate_launch_description():
    """Return the arguments and the node."""
    return slam_toolbox("async_slam_toolbox_node", "mapper_params_online_async.yaml")
